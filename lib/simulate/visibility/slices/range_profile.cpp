#include "simulate/visibility/slices/range_profile.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sonarsim {

namespace {

// The least depth of surface, in bins, since areas are divided by depths. The step of a float just
// below 8192 bins is half of this.
constexpr float min_depth_bins = 1e-3F;

/// Four points of a plane of the scene in the directions (1, u, w).
struct PlanePoints {
    Eigen::Array4f q;
    Eigen::Array4f range_m;
};

PlanePoints plane_points(const FrontFacet& front, const Interval& range_m, const Eigen::Array4f& u,
                         const Eigen::Array4f& w) {
    const Eigen::Array4f secant = (1.0F + u * u + w * w).sqrt();
    const Eigen::Array4f along = front.normal.x() + front.normal.y() * u + front.normal.z() * w;
    const Eigen::Array4f q = (along * (-1.0F / front.height_m)).max(secant * (1.0F / range_m.to));
    PlanePoints points;
    points.range_m = (secant / q).max(std::min(range_m.from, range_m.to));
    points.q = secant / points.range_m;
    return points;
}

}  // namespace

RangeProfile::RangeProfile(const View& view)
    : min_bins_(static_cast<float>(view.range_min_m / view.bin_m())),
      per_m_(static_cast<float>(1.0 / view.bin_m())),
      bins_(view.range_bins),
      per_range_(view.range_bins, 0.0F),
      weight_(view.range_bins, 0.0F),
      echo_(view.range_bins, 0.0F) {
    for (int i = 0; i < bins_; ++i)
        per_range_[i] = per_m_ / (min_bins_ + static_cast<float>(i) + 0.5F);
}

void RangeProfile::clear() {
    std::fill(weight_.begin() + first_, weight_.begin() + last_, 0.0F);
    std::fill(echo_.begin() + first_, echo_.begin() + last_, 0.0F);
    first_ = last_ = 0;
    sum_ = 0.0F;
}

void RangeProfile::set(const FrameScan& scan, std::span<const Material> materials,
                       std::span<const VisibleSpan> spans, const MovedEnds& ends) {
    clear();
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const VisibleSpan& span = spans[i];
        const float low = ends.ends[2 * i].w;
        const float high = ends.ends[2 * i + 1].w;
        if (!(low < high) || ends.u < span.facet_extent.u.from || ends.u > span.facet_extent.u.to)
            continue;
        const FrontFacet& front = scan.scene().facets[span.facet_index];
        const Eigen::Array4f w(low, high, 0.5F * (low + high), low);
        const Eigen::Array4f u = scan.frame().meridians
                                     ? Eigen::Array4f::Constant(ends.u)
                                     : Eigen::Array4f(ends.u * (1.0F + w * w).sqrt());
        const PlanePoints points = plane_points(front, span.facet_extent.range_m, u, w);
        const Eigen::Array4f& q = points.q;
        // dA = X^3 du dw / h, and 1 / X = q is linear in w.
        const float weight =
            (high - low) * (q[0] + q[1]) / (2.0F * q[0] * q[0] * q[1] * q[1] * front.height_m);
        add(points.range_m.minCoeff(), std::max(points.range_m[0], points.range_m[1]), weight,
            front.height_m, materials[scan.mesh().facets[front.facet].material].reflection);
    }
    finish();
}

void RangeProfile::set(std::span<const UnseenPiece* const> pieces, float beam_u) {
    clear();
    for (const UnseenPiece* piece : pieces)
        add(piece->range_m.from, piece->range_m.to, piece->area_m2 / beam_u, piece->height_m,
            piece->reflection);
    finish();
}

/// Adds surface that is spread evenly over an interval of range.
void RangeProfile::add(float from_m, float to_m, float weight, float height_m, float reflection) {
    const float low = from_m * per_m_ - min_bins_;
    const float high = std::max(to_m * per_m_ - min_bins_, low + min_depth_bins);
    const float density = weight / (high - low);
    if (!(high > 0.0F && low < static_cast<float>(bins_))) return;
    const int first = static_cast<int>(std::max(low, 0.0F));
    const float to = std::min(high, static_cast<float>(bins_));
    const int end = static_cast<int>(std::ceil(to));
    first_ = last_ == 0 ? first : std::min(first_, first);
    last_ = std::max(last_, end);
    for (int i = first; i < end; ++i) {
        const auto bin = static_cast<float>(i);
        const float w = density * (std::min(to, bin + 1.0F) - std::max(low, bin));
        weight_[i] += w;
        echo_[i] += w * reflection * std::min(height_m * per_range_[i], 1.0F);
    }
}

void RangeProfile::finish() {
    float* const __restrict echo = echo_.data();
    const float* const __restrict weight = weight_.data();
    for (int i = first_; i < last_; ++i)
        echo[i] = weight[i] > 0.0F ? echo[i] / weight[i] : 0.0F;
    sum_ = std::accumulate(echo + first_, echo + last_, 0.0F);
}

float RangeProfile::change(const RangeProfile& a, const RangeProfile& b,
                           const RangeProfile& added) {
    float sum = 0.0F;
    for (int i = added.first_; i < added.last_; ++i) {
        const float more = 2.0F * added.weight_[i];
        if (!(more > 0.0F)) continue;
        const float weight = a.weight_[i] + b.weight_[i];
        const float echo = a.weight_[i] * a.echo_[i] + b.weight_[i] * b.echo_[i];
        const float before = weight > 0.0F ? echo / weight : 0.0F;
        sum += std::fabs(added.echo_[i] - before) * more / (weight + more);
    }
    return sum;
}

float RangeProfile::difference(const RangeProfile& a, const RangeProfile& b) {
    float sum = 0.0F;
    const int last = std::max(a.last_, b.last_);
    for (int i = std::min(a.first_, b.first_); i < last; ++i)
        sum += std::fabs(a.echo_[i] - b.echo_[i]);
    return sum;
}

}  // namespace sonarsim
