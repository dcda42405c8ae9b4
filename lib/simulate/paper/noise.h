#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.h"
#include "core/random.h"
#include "input/mission/mission.h"
#include "input/scene/scene.h"
#include "simulate/paper/echoes.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The pixel noise of one sonar, Eq. 10-13.
struct PixelNoise {
    float gain = 0.5F;               ///< m of Eq. 12: 0.5, as printed, for imaging and profiling
    float add_sigma = 0.0F;          ///< sigma_a, scale of the Rayleigh distribution, Eq. 11
    float mult_sigma = 0.0F;         ///< sigma_m, standard deviation of the Gaussian, Eq. 13
    std::vector<float> range_scale;  ///< per row: (r / range_max)^2 of Eq. 10, or 1
    std::vector<float> lobe_scale;   ///< per column: 1 + 0.5 exp(-phi^2 / (2 sigma^2)), or 1
};

/// I'' = I (m + w_m) + s w_a, Eq. 12, for every pixel of `image` [rows, columns], where s is the
/// product of its two scales. Negative results become 0; returns their number. The draws of a pixel
/// depend on the key, its row and its column alone.
std::uint64_t add_pixel_noise(std::span<float> image, const PixelNoise& noise, PhiloxKey key);

/// The azimuth streaks of one sonar, Eq. 14-15.
struct Streaks {
    StreakMode mode = StreakMode::none;
    float threshold = 0.0F;   ///< zeta, a share of area
    float min_cosine = 1.0F;  ///< cosine of the largest angle that counts as normal

    bool exist() const { return mode != StreakMode::none; }
};

/// The area of the echoing surface in each range row, and the part of it at normal incidence.
struct RowAreas {
    std::vector<float> all;  ///< m^2
    BinSums normal;          ///< its weights are the areas

    explicit RowAreas(int rows);
    void add(const BinSums& beam);
};

/// The samples that may have a part at normal incidence.
std::vector<Sample> near_normal_incidence(std::span<const Sample> samples, float min_cosine);

/// Cuts the echoes of these samples, which end at `ends`, to the parts at normal incidence: a plane
/// at the distance h is met at the range r with the cosine h / r.
void cut_to_normal_incidence(std::span<const Sample> samples, std::span<const std::uint32_t> ends,
                             float min_cosine, RangeBoxes& echoes);

/// If the share at normal incidence reaches the threshold, the row I of `image` [rows, columns]
/// becomes 1 - (1 - I)^2 (add, Eq. 14) or I^2 (reduce, Eq. 15). I is clamped to [0, 1] first, since
/// Eq. 14 falls above 1. Returns the number of changed rows.
std::uint64_t add_streaks(std::span<float> image, const RowAreas& areas, const Streaks& streaks);

/// The range noise of one sonar, Eq. 7-8.
struct RangeNoise {
    float lambda_m = 0.0F;     ///< mean of the exponential distribution; 0: no range noise
    float scatterer_m = 0.0F;  ///< edge of the cells that share a draw
    bool fades = true;         ///< late echoes are weaker by exp(-w / lambda), Eq. 8
};

/// The cells in which a sonar at `T_world_sensor` draws its range noise; none where there is none.
ScattererLattice scatterer_lattice(const RangeNoise& noise, const Scene& scene,
                                   const Pose& T_world_sensor);

/// Every scatterer cell draws w from the exponential distribution of mean lambda. Its echoes arrive
/// w later (Eq. 7) and, if the noise fades, weaker by exp(-w / lambda) (Eq. 8).
void add_range_noise(Echoes& echoes, const RangeNoise& noise, PhiloxKey key);

}  // namespace sonarsim
