#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mission/source_location.h"

namespace sonarsim {

// A sea bed that is generated from numbers and the mission's seed. Pairs are limits of random
// draws.

/// An isotropic power spectrum of heights, W(K) = strength / (K^2 + (2 pi / corner)^2)^(exponent/2)
/// with K in rad/cm and W in cm^4, so that the integral of W over the plane is the variance.
struct BedRoughnessConfig {
    double spectral_strength_cm4 = 0.003;
    double spectral_exponent = 3.25;
    double corner_m = 2.0;  ///< wavelength above which the spectrum is flat

    bool operator==(const BedRoughnessConfig&) const = default;
};

/// A train of ripples.
struct BedRippleConfig {
    double height_m = 0.0;  ///< from trough to crest
    double length_m = 0.0;  ///< from crest to crest
    double direction_deg = 0.0;

    bool operator==(const BedRippleConfig&) const = default;
};

/// Rocks that lie on the bed, in a Poisson process.
struct BedRockConfig {
    double density_per_m2 = 0.0;
    std::array<double, 2> diameter_m{};
    double exponent = 3.0;                   ///< rocks larger than D are as frequent as D^-exponent
    std::array<double, 2> buried{0.2, 0.6};  ///< share of a rock's height
    std::string material;
    std::string class_name = "rock";

    bool operator==(const BedRockConfig&) const = default;
};

/// A material that covers a share of the bed.
struct BedSedimentConfig {
    std::string material;
    double share = 1.0;

    bool operator==(const BedSedimentConfig&) const = default;
};

struct SeabedConfig {
    std::optional<std::array<double, 2>> size_m;  ///< x, y; none: the bed has no end
    double cell_m = 0.0;                          ///< distance between heights
    double z_m = 0.0;                             ///< mean height
    std::string material;
    std::string class_name;
    std::optional<BedRoughnessConfig> roughness;
    std::optional<BedRippleConfig> ripples;
    std::vector<BedSedimentConfig> sediments;
    double patch_m = 10.0;  ///< size of the patches of sediments
    std::optional<BedRockConfig> rocks;
    std::filesystem::path preset;  ///< empty after reading: its keys are filled in
    SourceLocation place;

    bool operator==(const SeabedConfig&) const = default;
};

/// The instance that a seabed makes, besides its rocks.
inline constexpr const char* seabed_instance = "seabed";

}  // namespace sonarsim
