#include <optional>

#include "core/elementary.h"
#include "simulate/labels/labels.h"
#include "simulate/labels/range_path.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// The variance of sin(theta) in a patch at one range.
double variance_at_one_range(const EchoPatch& patch) {
    const auto [range, d] = arrival_of(patch.position);
    const float u = d.dot(patch.edge_u);
    const float v = d.dot(patch.edge_v);
    // Over the parallelogram, (s, t) in [-1, 1]^2, sin(theta) = z / r changes by (dz - (z / r) dr)
    // / r along an edge. The part in proportion to the range does not spread at one range.
    const double sine_u = (patch.edge_u.z() - d.z() * u) / range;
    const double sine_v = (patch.edge_v.z() - d.z() * v) / range;
    const double depth_2 = static_cast<double>(u) * u + static_cast<double>(v) * v;
    const double with = sine_u * u + sine_v * v;
    const double explained = depth_2 > 0.0 ? with * with / depth_2 : 0.0;
    return std::max(sine_u * sine_u + sine_v * sine_v - explained, 0.0) / 3.0;
}

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Bins are computed in blocks of this many.
constexpr int block = 16;

/// Elevations and spreads of at most a block of bins, by the echo's moments. Both loops vectorise.
void find_bins(const double* __restrict echo, const double* __restrict first,
               const double* __restrict second, int count, float* __restrict elevation,
               float* __restrict spread) {
    std::array<float, block> sines, cosines;
    for (int i = 0; i < count; ++i) {
        const bool occupied = echo[i] > 0.0;
        const double total = occupied ? echo[i] : 1.0;
        const double sine = std::min(std::max(first[i] / total, -1.0), 1.0);
        const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
        // d(theta) = d(sin theta) / cos(theta), limited to a half circle where cos is 0.
        const double deviation = std::sqrt(std::max(second[i] / total - sine * sine, 0.0));
        const double divisor = std::max(std::max(cosine, deviation / pi), 1e-9);
        sines[i] = static_cast<float>(occupied ? sine : none);
        cosines[i] = static_cast<float>(cosine);
        spread[i] = static_cast<float>(occupied ? deviation / divisor : none);
    }
    for (int i = 0; i < count; ++i) {
        const float angle = arctan2_float(sines[i], cosines[i]);
        elevation[i] = std::isnan(sines[i]) ? none : angle;
    }
}

/// Finds the elevation of the surface in the bins of some beams, by the moments of sin(theta).
class ElevationFinder : public BinMoments<2> {
  public:
    using BinMoments::BinMoments;

    void begin(const EchoPatch& patch, const RangePath& path) {
        const Eigen::Vector3f axis = Eigen::Vector3f::UnitZ();
        rise_m_ = patch.position.dot(axis);
        slope_ = path.per_range.dot(axis);
        variance_at_range_ = variance_at_one_range(patch);
    }

    void cover(const CoveredBins& covered) {
        const auto sine_at = [&](int k) {
            return std::clamp((rise_m_ + slope_ * covered.way[k]) / covered.range_m[k], -1.0, 1.0);
        };
        for (int k = 0; k < covered.whole; ++k) {
            const double enters = sine_at(k);
            const double leaves = sine_at(k + 1);
            const double along = leaves - enters;
            const double mean = 0.5 * (enters + leaves);
            moment_[0][k] = mean;
            moment_[1][k] = mean * mean + along * along / 12.0 + variance_at_range_;
        }
    }

    /// The mean elevation of the echo of each bin and its standard deviation, rad. Means are of
    /// sin(theta), weighted with the echo. Bins without an echo stay, or are NaN.
    void find(std::uint32_t row, std::span<float> elevation_rad, std::span<float> spread_rad) {
        take(row, [&](int begin, int end, const Sums& sums) {
            const auto [echo, first, second] = sums;
            // Most blocks hold water alone and are skipped.
            for (int from = begin; from < end; from += block) {
                const int count = std::min(block, end - from);
                const std::span<const double> echoes(echo + from, count);
                if (std::ranges::all_of(echoes, [](double e) { return e == 0.0; })) continue;
                find_bins(echo + from, first + from, second + from, count, &elevation_rad[from],
                          &spread_rad[from]);
            }
        });
    }

  private:
    double rise_m_ = 0.0, slope_ = 0.0, variance_at_range_ = 0.0;  ///< the patch
};

// Surface that lies below the bottom by at most this share of its range is on it: rounding.
constexpr double on_bottom = 1e-4;
// The same if sound bends or the sonar moves: pieces are not flat at their true places.
constexpr double on_bottom_where_bent = 2e-3;

// Vertical share of the normal below which a face of the bottom has the height above its foot.
constexpr float vertical = 1e-3F;

/// Finds the height above the bottom of the surface in the bins of some beams.
class HeightFinder : public BinMoments<1> {
  public:
    /// `is_bottom`: that of the scene. Both it and the bottom must outlive the finder.
    HeightFinder(int rows, int bins, const Bottom& bottom, std::span<const std::uint8_t> is_bottom,
                 const TruePlaces& places)
        : BinMoments(rows, bins),
          bottom_(bottom),
          is_bottom_instance_(is_bottom),
          places_(places),
          up_((places.T_world_sensor.rotation.conjugate() * Eigen::Vector3d::UnitZ())
                  .cast<float>()) {}

    /// Begins the next patch. False if there is no bottom below it, so that it has no height.
    bool begin(const EchoPatch& patch, const RangePath& path) {
        is_bottom_ = lies_on_bottom(*patch.sample);
        if (is_bottom_) return true;
        const Eigen::Vector3d at = places_.of(patch.position.cast<double>());
        const double tolerance =
            (places_.is_measured() ? on_bottom : on_bottom_where_bent) * path.range_m;
        std::optional<double> below = bottom_.highest_below(at, tolerance);
        if (!below) {
            // A wall may stand on the border of the bottom; then the bottom begins in front of it.
            const Eigen::Vector3d before = at + tolerance * (places_.T_world_sensor.rotation *
                                                             patch.sample->normal.cast<double>());
            below = bottom_.highest_below(before, tolerance);
        }
        if (!below) return false;
        height_m_ = at.z() - *below;
        is_bottom_ = height_m_ < tolerance;
        rise_m_ = patch.position.dot(up_);
        slope_ = path.per_range.dot(up_);
        bottom_slope_ = bottom_slope(patch, path, tolerance);
        return true;
    }

    void cover(const CoveredBins& covered) {
        if (is_bottom_) return moment_[0].fill(0.0);
        const auto height_at = [&](int k) {
            const double above = (rise_m_ + slope_ * covered.way[k]) - rise_m_;
            return std::max(height_m_ + above - bottom_slope_ * covered.way[k], 0.0);
        };
        for (int k = 0; k < covered.whole; ++k)
            moment_[0][k] = 0.5 * (height_at(k) + height_at(k + 1));
    }

    /// The mean height of the echo of each bin above the highest bottom below it. Bins without an
    /// echo or without a bottom are left as they are. Clears the row.
    void find(std::uint32_t row, std::span<float> height_m) {
        take(row, [&](int first, int last, const Sums& sums) {
            const auto [echo, height] = sums;
            for (int i = first; i < last; ++i) {
                if (echo[i] > 0.0) height_m[i] = static_cast<float>(height[i] / echo[i]);
            }
        });
    }

  private:
    /// The mean slope of the bottom below a patch along its way; 0 where an end has none.
    double bottom_slope(const EchoPatch& patch, const RangePath& path, double tolerance) const {
        const auto below = [&](double way) {
            const Eigen::Vector3f end = patch.position + static_cast<float>(way) * path.per_range;
            return bottom_.highest_below(places_.of(end.cast<double>()), tolerance);
        };
        if (!(path.depth_m > 0.0)) return 0.0;
        const auto near = below(-path.depth_m);
        const auto far = below(path.depth_m);
        return near && far ? (*far - *near) / (2.0 * path.depth_m) : 0.0;
    }

    bool lies_on_bottom(const Sample& sample) const {
        return sample.instance < is_bottom_instance_.size() &&
               is_bottom_instance_[sample.instance] != 0 &&
               std::fabs(sample.normal.dot(up_)) > vertical;
    }

    const Bottom& bottom_;
    std::span<const std::uint8_t> is_bottom_instance_;
    TruePlaces places_;
    Eigen::Vector3f up_;  ///< sensor frame
    // This patch:
    bool is_bottom_ = false;
    double height_m_ = 0.0, rise_m_ = 0.0, slope_ = 0.0, bottom_slope_ = 0.0;
};

struct PatchFinders {
    std::optional<ElevationFinder> elevation;
    std::optional<HeightFinder> height;

    /// Adds the echoes of a patch; `one_row`: there is one row of sums, not one for each beam.
    void add(const SurfaceEchoes& echoes, const EchoPatch& patch, const RangeBins& bins,
             bool one_row) {
        const auto own = std::span(echoes.patch_echoes)
                             .subspan(patch.echo_begin, patch.echo_end - patch.echo_begin);
        const RangePath path = range_path(patch);
        if (elevation) elevation->begin(patch, path);
        const bool has_height = height && height->begin(patch, path);
        if (!elevation && !has_height) return;
        for_each_covered(path, bins, [&](const CoveredBins& covered) {
            if (elevation) elevation->cover(covered);
            if (has_height) height->cover(covered);
            for (const PatchEcho& echo : own) {
                if (!(echo.echo > 0.0)) continue;
                const std::uint32_t row = one_row ? 0 : echo.beam;
                if (elevation) elevation->add(row, echo.echo, covered);
                if (has_height) height->add(row, echo.echo, covered);
            }
        });
    }
};

}  // namespace

void label_patches(const SurfaceEchoes& echoes, const View& view, const TruePlaces& places,
                   const Bottom* bottom, std::span<const std::uint8_t> is_bottom,
                   PingLabels& labels) {
    const RangeBins bins = range_bins(view);
    // Patches that are sorted by beam need one row of sums, which stays in the cache.
    const bool sorted = !echoes.patch_begin.empty();
    const int rows = sorted ? 1 : view.beams;
    PatchFinders finders;
    if (!labels.elevation_rad.empty()) finders.elevation.emplace(rows, bins.count);
    if (!labels.height_m.empty() && bottom != nullptr)
        finders.height.emplace(rows, bins.count, *bottom, is_bottom, places);
    if (!sorted) {
        for (const EchoPatch& patch : echoes.patches)
            finders.add(echoes, patch, bins, false);
    }
    for (int j = 0; j < view.beams; ++j) {
        if (sorted) {
            for (std::uint32_t k = echoes.patch_begin[j]; k < echoes.patch_begin[j + 1]; ++k)
                finders.add(echoes, echoes.patches[k], bins, true);
        }
        const auto own = [&](std::vector<float>& all) {
            return std::span(all).subspan(static_cast<std::size_t>(j) * view.range_bins,
                                          view.range_bins);
        };
        const auto row = static_cast<std::uint32_t>(sorted ? 0 : j);
        if (finders.elevation) {
            finders.elevation->find(row, own(labels.elevation_rad),
                                    own(labels.elevation_spread_rad));
        }
        if (finders.height) finders.height->find(row, own(labels.height_m));
    }
}

}  // namespace sonarsim
