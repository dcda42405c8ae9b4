#include "calibrate/patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sonarsim {

namespace {

// The share of a patch's values that may lie at each end of the scale. Such values bias the
// moments.
constexpr double most_at_an_end = 0.003;

/// The scaled values of a patch.
struct PatchField {
    int rows, beams;
    std::vector<double> x;

    double at(int row, int beam) const {
        return x[static_cast<std::size_t>(row) * static_cast<std::size_t>(beams) +
                 static_cast<std::size_t>(beam)];
    }
};

/// Half the mean square difference of values that lie `rows` and `beams` apart.
double structure(const PatchField& field, int rows, int beams) {
    if (rows >= field.rows || beams >= field.beams) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0.0;
    for (int i = 0; i + rows < field.rows; ++i) {
        for (int j = 0; j + beams < field.beams; ++j) {
            const double off = field.at(i + rows, j + beams) - field.at(i, j);
            const double other = field.at(i + rows, j) - field.at(i, j + beams);
            sum += off * off + other * other;
        }
    }
    return 0.25 * sum / (1.0 * (field.rows - rows) * (field.beams - beams));
}

/// The third central moment k of independent values: (a + c - 2 b)^3 has the mean -6 k, whatever
/// their mean and its slope.
double third_moment(const PatchField& field) {
    const int rows = (field.rows - 1) / 2 > 8 ? 8 : field.rows / 3;
    const int beams = field.beams / 3;
    double sum = 0.0;
    double count = 0.0;
    for (int i = 0; i + 2 * rows < field.rows; ++i) {
        for (int j = 0; j + 2 * beams < field.beams; ++j) {
            const double y = field.at(i, j) + field.at(i + 2 * rows, j + 2 * beams) -
                             2.0 * field.at(i + rows, j + beams);
            sum += y * y * y;
            count += 1.0;
        }
    }
    return count > 0.0 ? -sum / (6.0 * count) : 0.0;
}

/// Variance of the means of the patch's quarters.
double variance_of_quarters(const PatchField& field) {
    const int half = std::max(field.beams / 2, 1);
    std::array<double, 4> sums{}, counts{};
    for (int i = 0; i < field.rows; ++i) {
        for (int j = 0; j < field.beams; ++j) {
            const std::size_t k = (2 * i >= field.rows ? 2U : 0U) + (j >= half ? 1U : 0U);
            sums[k] += field.at(i, j);
            counts[k] += 1.0;
        }
    }
    double mean = 0.0;
    double square = 0.0;
    double used = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (counts[k] == 0.0) continue;
        const double of_quarter = sums[k] / counts[k];
        mean += of_quarter;
        square += of_quarter * of_quarter;
        used += 1.0;
    }
    return square / used - mean * mean / (used * used);
}

void add_moments(const PatchField& field, PatchMoments& patch) {
    const double part = 1.0 / static_cast<double>(field.x.size());
    for (const double x : field.x) {
        patch.mean += part * x;
        patch.square += part * x * x;
        patch.cube += part * x * x * x;
    }
    patch.variance = structure(field, field.rows / 2, field.beams / 2);
    patch.third = third_moment(field);
    for (int lag = 1; lag <= patch_lags; ++lag) {
        patch.along_range[static_cast<std::size_t>(lag - 1)] = structure(field, lag, 0);
        patch.along_beams[static_cast<std::size_t>(lag - 1)] = structure(field, 0, lag);
    }
    patch.unevenness = variance_of_quarters(field) / std::max(patch.variance, 1e-30);
}

PatchMoments moments_of(const RecordedPing& ping, const PatchGrid& grid, int place,
                        double full_value, const std::function<double(double, int)>& scaled) {
    PatchMoments out;
    out.place = place;
    out.row = grid.first_range(place);
    out.beam = grid.first_beam(place);
    PatchField field{grid.size.ranges, grid.size.beams, {}};
    const double part = 1.0 / grid.size.values();
    const ImageView image{ping.values, ping.ranges, ping.beams};
    grid.for_each_bin(image, place, [&](double v, int row, int) {
        out.mean_value += v * part;
        out.zeros += v <= 0.0 ? part : 0.0;
        out.full += full_value > 0.0 && v >= full_value ? part : 0.0;
        field.x.push_back(scaled(v, row));
    });
    add_moments(field, out);
    return out;
}

}  // namespace

PatchGrid speckle_grid(const RecordedPing& ping) {
    const int beams = std::min(24, ping.beams);
    return {{std::min(beams < 8 ? 96 : 24, ping.ranges), beams}, ping.ranges, ping.beams};
}

std::vector<PatchMoments> patch_moments(const std::vector<RecordedPing>& pings, double full_value,
                                        const std::function<double(double, int)>& scaled) {
    std::vector<PatchMoments> out;
    for (std::size_t number = 0; number < pings.size(); ++number) {
        const PatchGrid grid = speckle_grid(pings[number]);
        for (int place = 0; place < grid.places(); ++place) {
            out.push_back(moments_of(pings[number], grid, place, full_value, scaled));
            out.back().ping = static_cast<int>(number);
        }
    }
    return out;
}

std::vector<PatchMoments> at_places(std::vector<PatchMoments> patches,
                                    const std::vector<bool>& places) {
    if (places.empty()) return patches;
    std::erase_if(patches, [&](const PatchMoments& patch) {
        return !places[static_cast<std::size_t>(patch.place)];
    });
    return patches;
}

std::vector<std::size_t> speckle_patches(const std::vector<PatchMoments>& patches,
                                         double least_mean) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const PatchMoments& p = patches[k];
        if (p.zeros <= most_at_an_end && p.full <= most_at_an_end && p.variance > 0.0 &&
            p.mean_value >= least_mean)
            out.push_back(k);
    }
    std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
        return patches[a].unevenness < patches[b].unevenness;
    });
    out.resize((out.size() + 1) / 2);
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<std::size_t> without_uneven(const std::vector<PatchMoments>& patches,
                                        const std::vector<std::size_t>& chosen) {
    std::vector<std::size_t> out;
    if (chosen.empty()) return out;
    std::vector<double> sizes;
    sizes.reserve(chosen.size());
    for (const std::size_t k : chosen)
        sizes.push_back(patches[k].unevenness);
    std::sort(sizes.begin(), sizes.end());
    const double most = 4.0 * sizes[sizes.size() / 2];
    for (const std::size_t k : chosen) {
        if (patches[k].unevenness <= most) out.push_back(k);
    }
    return out;
}

}  // namespace sonarsim
