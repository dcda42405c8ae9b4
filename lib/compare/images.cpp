#include "compare/images.h"

#include <algorithm>
#include <cmath>

#include "recording/law.h"

namespace sonarsim {

namespace {

constexpr int most_strip_pings = 64;
/// Values above this share of the largest count as clipped.
constexpr double clipped_share = 0.995;

/// Images of one beam whose columns are consecutive pings.
void add_strips(const Recording& recording, int beam, RecordedImages& images) {
    const std::size_t width = static_cast<std::size_t>(images.columns);
    for (std::size_t first = 0; first + width <= recording.pings.size(); first += width) {
        std::vector<float>& powers =
            images.powers.emplace_back(width * static_cast<std::size_t>(images.ranges));
        for (std::size_t j = 0; j < width; ++j) {
            const RecordedPing& ping = recording.pings[first + j];
            const std::vector<float> own = powers_of(recording.law, ping.values);
            for (std::size_t i = 0; i < static_cast<std::size_t>(images.ranges); ++i)
                powers[i * width + j] =
                    own[i * static_cast<std::size_t>(ping.beams) + static_cast<std::size_t>(beam)];
        }
    }
}

}  // namespace

RecordedImages images_of(const Recording& recording) {
    RecordedImages images;
    images.first_range_m = recording.first_range_m;
    images.range_step_m = recording.range_step_m;
    if (recording.pings.empty()) return images;
    const RecordedPing& first = recording.pings.front();
    images.ranges = first.ranges;
    images.columns = first.beams;
    if (recording.law.full_value > 0.0)
        images.full_power = static_cast<float>(
            power_of(recording.law, clipped_share * largest_value(recording.law)));
    images.least_power = static_cast<float>(power_of(recording.law, 0.0));
    if (recording.kind == RecordedKind::imaging) {
        images.bearing_rad = recording.bearing_rad;
        for (const RecordedPing& ping : recording.pings)
            images.powers.push_back(powers_of(recording.law, ping.values));
        return images;
    }
    images.columns_are_pings = true;
    images.has_shadows = recording.kind == RecordedKind::sidescan;
    images.columns = std::min(most_strip_pings, static_cast<int>(recording.pings.size()));
    for (int beam = 0; beam < first.beams; ++beam)
        add_strips(recording, beam, images);
    return images;
}

std::vector<double> mean_powers_of(const RecordedImages& images) {
    std::vector<double> sums(static_cast<std::size_t>(images.ranges));
    const auto columns = static_cast<std::size_t>(images.columns);
    for (const std::vector<float>& powers : images.powers) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            double sum = 0.0;
            for (std::size_t j = 0; j < columns; ++j)
                sum += powers[i * columns + j];
            sums[i] += sum / static_cast<double>(columns * images.powers.size());
        }
    }
    return sums;
}

void make_relative(RecordedImages& images) {
    double mean = 0.0;
    for (const double power : mean_powers_of(images))
        mean += power / images.ranges;
    if (!(mean > 0.0)) return;
    const auto factor = static_cast<float>(1.0 / mean);
    for (std::vector<float>& powers : images.powers) {
        for (float& power : powers)
            power *= factor;
    }
    images.full_power *= factor;
    images.least_power *= factor;
}

bool have_one_grid(const RecordedImages& a, const RecordedImages& b) {
    // Ranges that differ by less than half a sample at the far end are the same.
    const double off = std::fabs(a.first_range_m - b.first_range_m) +
                       a.ranges * std::fabs(a.range_step_m - b.range_step_m);
    return a.ranges == b.ranges && a.columns == b.columns &&
           a.columns_are_pings == b.columns_are_pings && off < 0.5 * a.range_step_m;
}

PatchSize patch_size_of(const RecordedImages& a, const RecordedImages& b) {
    const int ranges = std::min(a.ranges, b.ranges);
    const int columns = std::min(a.columns, b.columns);
    // The trend takes six degrees of freedom; eight bins to a side are the fewest.
    return {std::min(ranges, std::clamp(ranges / 8, 8, 32)),
            std::min(columns, std::clamp(columns / 4, 8, 16))};
}

}  // namespace sonarsim
