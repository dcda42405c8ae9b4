#include "simulate/labels/height.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sonarsim {

namespace {

// Surface that lies below the bottom by at most this share of its range is on it: rounding.
constexpr double on_bottom = 1e-4;
// The same if sound bends or the sonar moves: pieces are not flat at their true places.
constexpr double on_bottom_where_bent = 2e-3;

// Vertical share of the normal below which a face of the bottom has the height above its foot.
constexpr float vertical = 1e-3F;

}  // namespace

HeightFinder::HeightFinder(const RangeBins& bins, int rows, const Bottom& bottom,
                           std::span<const std::uint8_t> is_bottom, const TruePlaces& places)
    : bottom_(bottom),
      is_bottom_instance_(is_bottom),
      places_(places),
      up_((places.T_world_sensor.rotation.conjugate() * Eigen::Vector3d::UnitZ()).cast<float>()),
      sums_(rows, bins.count) {}

bool HeightFinder::lies_on_bottom(const Sample& sample) const {
    return sample.instance < is_bottom_instance_.size() &&
           is_bottom_instance_[sample.instance] != 0 &&
           std::fabs(sample.normal.dot(up_)) > vertical;
}

bool HeightFinder::begin(const EchoPatch& patch, const RangePath& path) {
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
    return true;
}

void HeightFinder::cover(const CoveredBins& covered) {
    if (is_bottom_) return mean_.fill(0.0);
    const auto height_at = [&](int k) {
        return std::max(height_m_ + (rise_m_ + slope_ * covered.way[k]) - rise_m_, 0.0);
    };
    for (int k = 0; k < covered.whole; ++k)
        mean_[k] = 0.5 * (height_at(k) + height_at(k + 1));
}

void HeightFinder::add(std::uint32_t row, double echo, const CoveredBins& covered) {
    const auto [to_echo, to_height] = sums_.at(row, covered);
    double* const __restrict sum = to_echo;
    double* const __restrict height = to_height;
    for (int k = 0; k < covered.whole; ++k) {
        const double part = echo * covered.share[k];
        sum[k] += part;
        height[k] += part * mean_[k];
    }
}

void HeightFinder::find(std::uint32_t row, std::span<float> height_m) {
    const BinSumRows<2>::Row sums = sums_.row(row);
    const auto [echo, height] = sums.of;
    for (int i = sums.first; i < sums.last; ++i) {
        if (echo[i] > 0.0) height_m[i] = static_cast<float>(height[i] / echo[i]);
    }
    sums_.clear(row);
}

}  // namespace sonarsim
