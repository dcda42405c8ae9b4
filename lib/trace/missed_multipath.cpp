#include "trace/missed_multipath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/overlapped_bins.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

// A footprint is shifted to the middle of its column if that is at most this many half widths away.
constexpr float farthest_shift = 16.0F;

constexpr float most_pieces = 64.0F;

// More beams than twice this many cost time and hardly improve the estimate.
constexpr int enough_beams = 128;

// Bits: the images that occupy a bin.
constexpr unsigned by_even_columns = 1;
constexpr unsigned by_odd_columns = 2;

/// The bins with multipath of two images, in all beams of the view or in every n-th.
class OccupiedBins {
  public:
    explicit OccupiedBins(const View& view)
        : beams_(static_cast<float>(view.beams)),
          full_turn_(is_full_turn(view)),
          every_(std::max(1, view.beams / enough_beams)),
          bins_(view.range_bins),
          range_min_m_(static_cast<float>(view.range_min_m)),
          per_bin_(static_cast<float>(1.0 / view.bin_m())),
          images_((static_cast<std::size_t>(view.beams / every_) + 1) *
                  static_cast<std::size_t>(bins_)) {}

    /// Marks the bins of a footprint. It is cut into pieces as by multipath_echoes().
    void add(const BouncePath& b, unsigned image) {
        const int n_u = pieces(b.beam_u);
        const int n_v = pieces(b.beam_v);
        const float step_u = 1.0F / static_cast<float>(n_u);
        const float step_v = 1.0F / static_cast<float>(n_v);
        const float half = std::sqrt(b.range_u * b.range_u * step_u * step_u +
                                     b.range_v * b.range_v * step_v * step_v) *
                           per_bin_;
        for (int i = 0; i < n_u; ++i) {
            const float s = (2.0F * static_cast<float>(i) + 1.0F) * step_u - 1.0F;
            for (int j = 0; j < n_v; ++j) {
                const float t = (2.0F * static_cast<float>(j) + 1.0F) * step_v - 1.0F;
                float beam = b.beam + s * b.beam_u + t * b.beam_v;
                if (full_turn_) beam = beam_in_turn(beam, beams_);
                if (!(beam >= 0.0F && beam < beams_)) continue;
                const int row = static_cast<int>(beam);
                if (row % every_ != 0) continue;
                const float range_m = b.range_m + s * b.range_u + t * b.range_v;
                mark(row / every_, (range_m - range_min_m_) * per_bin_, half, image);
            }
        }
    }

    /// The number of bins that exactly these images occupy.
    double count(unsigned images) const {
        return static_cast<double>(std::ranges::count(images_, static_cast<std::uint8_t>(images)));
    }

  private:
    static int pieces(float half_beams) {
        return static_cast<int>(
            std::ceil(std::clamp(2.0F * std::fabs(half_beams), 1.0F, most_pieces)));
    }

    void mark(int row, float centre, float half, unsigned image) {
        // A footprint without depth still lies in a bin.
        constexpr float least_half = 1e-3F;
        const float depth = std::max(half, least_half);
        const OverlappedBins<float> covered(centre - depth, centre + depth, bins_);
        const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(bins_);
        for (int i = covered.begin; i < covered.end; ++i)
            images_[first + static_cast<std::size_t>(i)] |= static_cast<std::uint8_t>(image);
    }

    float beams_;
    bool full_turn_;
    int every_;
    int bins_;
    float range_min_m_;
    float per_bin_;
    std::vector<std::uint8_t> images_;
};

/// Columns of the view, several for a beam, as sources of sound.
struct Columns {
    BeamLocator field;
    float per_beam;

    /// The column of a point and its fraction; 0 outside the view.
    float at(const Eigen::Vector3f& point) const {
        return per_beam * std::max(field.beam(point, arrival_range(point)), 0.0F);
    }
    /// The change of the column along an edge of a footprint.
    float along(const Eigen::Vector3f& edge, const Eigen::Vector3f& at) const {
        return per_beam * field.beams_per_rad() * (at.x() * edge.y() - at.y() * edge.x()) /
               (at.x() * at.x() + at.y() * at.y());
    }
};

/// The path of a footprint that is stretched to twice its width about the middle of its column, so
/// that the footprints of every second column cover those of the others.
BouncePath stretched(const BouncePath& path, const Sample& sample, const Columns& columns) {
    const Eigen::Vector3f& at = sample.position;
    const float along_u = columns.along(sample.edge_u, at);
    const float along_v = columns.along(sample.edge_v, at);
    const bool by_u = std::fabs(along_u) >= std::fabs(along_v);
    const float half_width = by_u ? along_u : along_v;
    BouncePath out = path;
    float& of_range = by_u ? out.range_u : out.range_v;
    float& of_beam = by_u ? out.beam_u : out.beam_v;
    const float column = columns.at(at);
    const float off_middle = column - std::floor(column) - 0.5F;
    if (half_width != 0.0F && std::fabs(off_middle) <= farthest_shift * std::fabs(half_width)) {
        const float shift = off_middle / half_width;
        out.range_m += shift * of_range;
        out.beam += shift * of_beam;
    }
    of_range *= 2.0F;
    of_beam *= 2.0F;
    return out;
}

}  // namespace

double missed_multipath(const View& view, int columns_per_beam, const Samples& samples,
                        std::span<const BouncePath> bounces) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (bounces.empty() || view.shape != ViewShape::fan || view.beams * columns_per_beam < 2)
        return none;
    const Columns columns{BeamLocator(view), static_cast<float>(columns_per_beam)};
    OccupiedBins bins(view);
    for (const BouncePath& b : bounces) {
        const Sample& sample = samples.items[b.sample];
        const bool odd = static_cast<int>(columns.at(sample.position)) % 2 != 0;
        bins.add(stretched(b, sample, columns), odd ? by_odd_columns : by_even_columns);
    }
    const double alone = bins.count(by_even_columns) + bins.count(by_odd_columns);
    const double common = bins.count(by_even_columns | by_odd_columns);
    if (alone + common == 0.0) return none;
    const double in_one_image = 0.5 * alone + common;
    const double found = common / in_one_image;
    // An image of every second column misses 1 - found; the image of all columns misses half as
    // much, so this is twice its standard error.
    const double twice_standard_error = std::sqrt(found * (1.0 - found) / in_one_image);
    return 0.5 * (1.0 - found) + twice_standard_error;
}

}  // namespace sonarsim
