#include "visibility/slices/slice_walk.h"

#include <algorithm>
#include <array>

namespace sonarsim {

namespace {

/// By place; equal places by number, so that the order is the same whatever came before.
bool before(const Segment& a, const Segment& b) {
    return a.w_low < b.w_low || (a.w_low == b.w_low && a.trapezoid < b.trapezoid);
}

/// Nearly sorted lists take linear time.
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

}  // namespace

void SliceWalk::start(const SliceScene& scene, const SliceFrame& frame) {
    scene_ = &scene;
    frame_ = &frame;
    active_.clear();
}

void SliceWalk::drop_ended(int s) {
    std::erase_if(active_, [&](const Segment& segment) {
        return scene_->trapezoids[segment.trapezoid].end <= s;
    });
}

void SliceWalk::evaluate(float u, std::vector<Segment>& segments) const {
    for (Segment& segment : segments) {
        const Trapezoid& t = scene_->trapezoids[segment.trapezoid];
        std::array<float, 4> at;
        for (int k = 0; k < 4; ++k)
            at[k] = t.at[k] + t.slope[k] * (u - t.anchor[k]);
        segment.w_low = at[0];
        // Next to a corner the edges may cross by rounding.
        segment.w_high = std::max(at[1], at[0]);
        const float q_low = at[2];
        const float q_high = at[3];
        const float width = segment.w_high - segment.w_low;
        segment.q_slope = width > 0.0F ? (q_high - q_low) / width : 0.0F;
        segment.w_anchor = q_low < q_high ? segment.w_low : segment.w_high;
        segment.q_anchor = std::min(q_low, q_high);
    }
}

const std::vector<Segment>& SliceWalk::step(int s) {
    const float u = frame_->slices[s].u;
    drop_ended(s);
    evaluate(u, active_);
    insertion_sort(active_);
    fresh_.clear();
    for (std::uint32_t k = scene_->begin[s]; k < scene_->begin[s + 1]; ++k)
        fresh_.push_back({0.0F, 0.0F, 0.0F, 0.0F, 0.0F, scene_->order[k]});
    evaluate(u, fresh_);
    std::ranges::sort(fresh_, before);
    merged_.resize(active_.size() + fresh_.size());
    std::ranges::merge(active_, fresh_, merged_.begin(), before);
    std::swap(active_, merged_);
    return active_;
}

}  // namespace sonarsim
