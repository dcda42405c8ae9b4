#include "simulate/visibility/slices/slice_walk.h"

#include <algorithm>
#include <bit>

namespace sonarsim {

namespace {

/// Orders by position, then by number, so that the order does not depend on the input's.
struct Before {
    bool operator()(const Segment& a, const Segment& b) const {
        return a.w_low < b.w_low || (a.w_low == b.w_low && a.trapezoid < b.trapezoid);
    }
};
constexpr Before before;

float w_low_at(const Trapezoid& trapezoid, float u) {
    return trapezoid.low.w + trapezoid.low.w_slope * (u - trapezoid.low.anchor);
}

/// A number whose order is that of Before: the bits of w_low, made ascending, and the trapezoid.
std::uint64_t place_of(float w_low, std::uint32_t trapezoid) {
    constexpr std::uint32_t sign = 0x80000000U;
    const auto bits = std::bit_cast<std::uint32_t>(w_low + 0.0F);  // -0 becomes 0
    const std::uint32_t ascending = (bits & sign) != 0 ? ~bits : bits | sign;
    return std::uint64_t{ascending} << 32 | trapezoid;
}

/// Takes linear time for nearly sorted lists.
void insertion_sort(std::vector<Segment>& segments) {
    for (std::size_t i = 1; i < segments.size(); ++i) {
        if (!before(segments[i], segments[i - 1])) continue;
        const Segment moved = segments[i];
        std::size_t k = i;
        for (; k > 0 && before(moved, segments[k - 1]); --k)
            segments[k] = segments[k - 1];
        segments[k] = moved;
    }
}

void evaluate(const SliceScene& scene, float u, std::vector<Segment>& segments) {
    for (Segment& segment : segments) {
        const Trapezoid& t = scene.trapezoids[segment.trapezoid];
        const float low_aside = u - t.low.anchor;
        const float high_aside = u - t.high.anchor;
        segment.w_low = w_low_at(t, u);
        // Near a corner the edges may cross by rounding.
        segment.w_high = std::max(t.high.w + t.high.w_slope * high_aside, segment.w_low);
        const float q_low = t.low.q + t.low.q_slope * low_aside;
        const float q_high = t.high.q + t.high.q_slope * high_aside;
        const float width = segment.w_high - segment.w_low;
        segment.q_slope = width > 0.0F ? (q_high - q_low) / width : 0.0F;
        segment.w_anchor = q_low < q_high ? segment.w_low : segment.w_high;
        segment.q_anchor = std::min(q_low, q_high);
    }
}

Segment not_evaluated(std::uint32_t trapezoid) {
    Segment segment{};
    segment.trapezoid = trapezoid;
    return segment;
}

}  // namespace

void segments_at(const SliceScene& scene, float u, std::span<const std::uint32_t> trapezoids,
                 std::vector<std::uint64_t>& places, std::vector<Segment>& out) {
    // Numbers are sorted in a third of the time of segments.
    places.clear();
    for (const std::uint32_t trapezoid : trapezoids) {
        const Trapezoid& t = scene.trapezoids[trapezoid];
        if (t.u_from <= u && u < t.u_to) places.push_back(place_of(w_low_at(t, u), trapezoid));
    }
    std::ranges::sort(places);
    out.clear();
    for (const std::uint64_t place : places)
        out.push_back(not_evaluated(static_cast<std::uint32_t>(place)));
    evaluate(scene, u, out);
}

const std::vector<Segment>& SliceWalk::step(int s) {
    const float u = frame_.slices[s].u;
    std::swap(before_, active_);
    kept_.clear();
    for (const Segment& segment : before_) {
        if (scene_.trapezoids[segment.trapezoid].u_to > u) kept_.push_back(segment);
    }
    evaluate(scene_, u, kept_);
    insertion_sort(kept_);
    entered_.clear();
    const Groups& by_slice = scene_.by_slice;
    for (std::uint32_t k = by_slice.begin[s]; k < by_slice.begin[s + 1]; ++k)
        entered_.push_back(not_evaluated(by_slice.items[k]));
    evaluate(scene_, u, entered_);
    std::ranges::sort(entered_, before);
    active_.resize(kept_.size() + entered_.size());
    std::ranges::merge(kept_, entered_, active_.begin(), before);
    return active_;
}

void SliceWalk::around_last_gap(std::vector<std::uint32_t>& out) const {
    for (const Segment& segment : before_)
        out.push_back(segment.trapezoid);
    for (const Segment& segment : entered_)
        out.push_back(segment.trapezoid);
}

}  // namespace sonarsim
