#include "labels/height.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "labels/range_path.h"

namespace sonarsim {

namespace {

// Surface that lies below the bottom by at most this share of its range is on it: rounding.
constexpr double on_bottom = 1e-4;

}  // namespace

void HeightFinder::add(const EchoPatch& patch, const Eigen::Vector3f& up) {
    const RangePath path = range_path(patch, up);
    const double echo = patch.echo;
    if (!(echo > 0.0)) return;
    const Eigen::Vector3d at =
        T_world_sensor_.rotation * patch.position.cast<double>() + T_world_sensor_.translation;
    const double tolerance = on_bottom * path.range_m;
    std::optional<double> below = bottom_->highest_below(at, tolerance);
    if (!below) {
        // A wall on the border of the bottom: the bottom begins before it.
        const Eigen::Vector3d before =
            at + tolerance * (T_world_sensor_.rotation * patch.sample->normal.cast<double>());
        below = bottom_->highest_below(before, tolerance);
    }
    if (!below) return;
    const double height = at.z() - *below;
    const bool is_bottom = height < tolerance;
    const auto height_at = [&](double r) {
        return is_bottom ? 0.0 : std::max(height + rise_at(path, r) - path.rise_m, 0.0);
    };
    for_each_covered(path, bins_, height_at, [&](const CoveredBins& covered) {
        first_bin_ = std::min(first_bin_, covered.first);
        last_bin_ = std::max(last_bin_, covered.first + covered.count);
        for (int k = 0; k < covered.count; ++k) {
            Sums& sums = sums_[covered.first + k];
            sums.echo += echo * covered.share[k];
            sums.height +=
                echo * covered.share[k] * 0.5 * (covered.values[k] + covered.values[k + 1]);
        }
    });
}

void HeightFinder::find(std::span<const EchoPatch> patches, std::span<float> height_m) {
    std::ranges::fill(height_m, std::numeric_limits<float>::quiet_NaN());
    if (bottom_ == nullptr) return;
    sums_.resize(bins_.count);
    first_bin_ = bins_.count;
    last_bin_ = 0;
    const Eigen::Vector3f up =
        (T_world_sensor_.rotation.conjugate() * Eigen::Vector3d::UnitZ()).cast<float>();
    for (const EchoPatch& patch : patches)
        add(patch, up);
    for (int i = first_bin_; i < last_bin_; ++i) {
        const Sums sums = std::exchange(sums_[i], {});
        if (sums.echo > 0.0) height_m[i] = static_cast<float>(sums.height / sums.echo);
    }
}

}  // namespace sonarsim
