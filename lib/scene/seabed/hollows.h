#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/seabed/bed_grid.h"
#include "scene/seabed/point_process.h"

namespace sonarsim {

// Hollows that are pressed into a bed. Pairs are limits of uniform draws.

struct BedPockmarks {
    double density_per_m2 = 0.0;
    std::array<double, 2> diameter_m{};
    std::array<double, 2> depth_m{};
};

struct BedScars {
    double density_per_m2 = 0.0;
    std::array<double, 2> length_m{};
    std::array<double, 2> width_m{};
    std::array<double, 2> depth_m{};
    std::array<double, 2> direction_rad{};  ///< from x towards y
};

/// A round hollow, depth (1 - (r / radius)^2)^2 at the distance r from its centre.
struct Pockmark {
    double x_m = 0.0;  ///< centre, m of the bed
    double y_m = 0.0;
    double diameter_m = 0.0;
    double depth_m = 0.0;
};

/// A straight furrow with the same section, which rises to its ends within its width.
struct Scar {
    double x_m = 0.0;  ///< centre, m of the bed
    double y_m = 0.0;
    double direction_rad = 0.0;
    double length_m = 0.0;
    double width_m = 0.0;
    double depth_m = 0.0;
};

/// The hollows that reach into an area of the bed. Their centres lie in `bed`.
std::vector<Pockmark> pockmarks_in(const BedArea& area, const BedArea& bed,
                                   const BedPockmarks& pockmarks, std::uint64_t seed);
std::vector<Scar> scars_in(const BedArea& area, const BedArea& bed, const BedScars& scars,
                           std::uint64_t seed);

/// Lowers the heights of a bed, in metres.
void press(const BedGrid& grid, const Pockmark& pockmark, std::vector<double>& heights);
void press(const BedGrid& grid, const Scar& scar, std::vector<double>& heights);

}  // namespace sonarsim
