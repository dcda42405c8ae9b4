#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "input/mission/mission.h"
#include "simulate/paper/accumulate.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The azimuth streaks of one sonar, Eq. 14-15.
struct Streaks {
    StreakMode mode = StreakMode::none;
    float threshold = 0.0F;  ///< zeta, a share of area
    float min_cosine =
        1.0F;  ///< cosine of the largest angle between v and n that is normal incidence

    bool exist() const { return mode != StreakMode::none; }
};

/// The area of the echoing surface in each range row, over all beams, and the part of it at normal
/// incidence.
struct RowAreas {
    std::vector<float> all;  ///< m^2
    BinSums normal;          ///< its weights are the areas

    explicit RowAreas(int rows);
    void add(const BinSums& beam);
};

/// The samples that are seen at normal incidence.
std::vector<Sample> at_normal_incidence(std::span<const Sample> samples, float min_cosine);

/// If the share at normal incidence reaches the threshold, the row I of `image` [rows, columns]
/// becomes 1 - (1 - I)^2 (add, Eq. 14) or I^2 (reduce, Eq. 15). I is clamped to [0, 1] first, since
/// Eq. 14 falls above 1. Returns the number of changed rows.
std::uint64_t add_streaks(std::span<float> image, const RowAreas& areas, const Streaks& streaks);

}  // namespace sonarsim
