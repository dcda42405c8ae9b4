#pragma once

#include <string>
#include <vector>

#include "compare/figures/patches.h"
#include "compare/figures/zones.h"
#include "recording/recording.h"

namespace sonarsim {

/// The powers of a recording as images [range, beam], one for each ping. Sonars with one or two
/// beams have images of up to 64 pings: their columns are pings.
struct RecordedImages {
    std::vector<std::vector<float>> powers;
    int ranges = 0;
    int columns = 0;
    bool columns_are_pings = false;
    bool has_shadows = false;  ///< a side-scan's
    float full_power = 0.0F;   ///< powers from here on are clipped; 0: none are
    float least_power = 0.0F;  ///< powers up to here are at the lower end of the scale
    double first_range_m = 0.0;
    double range_step_m = 0.0;
    std::vector<double> bearing_rad;  ///< the columns'; empty where they are pings

    ImageView image(std::size_t k) const { return {powers[k], ranges, columns}; }
    PatchGrid grid(PatchSize size) const { return {size, ranges, columns}; }
};

RecordedImages images_of(const Recording& recording);

/// Divides all powers by their mean.
void make_relative(RecordedImages& images);

/// The mean power of each range, over all columns and images.
std::vector<double> mean_powers_of(const RecordedImages& images);

/// True if both have the same ranges and columns, so that a place in one is a place in the other.
bool have_one_grid(const RecordedImages& a, const RecordedImages& b);

/// The size of patches that fits both.
PatchSize patch_size_of(const RecordedImages& a, const RecordedImages& b);

}  // namespace sonarsim
