#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulate/visibility/slices/envelope.h"
#include "simulate/visibility/slices/setup.h"

namespace sonarsim {

/// The segments of those of some trapezoids that a slice at u meets, sorted by w_low. The memory of
/// `places` is reused.
void segments_at(const SliceScene& scene, float u, std::span<const std::uint32_t> trapezoids,
                 std::vector<std::uint64_t>& places, std::vector<Segment>& out);

/// Walks the slices of a frame in order and keeps the segments that each of them meets sorted.
class SliceWalk {
  public:
    /// Both must outlive it.
    SliceWalk(const SliceScene& scene, const SliceFrame& frame) : scene_(scene), frame_(frame) {}

    /// Steps to the next slice, of index `s`, and returns its segments, sorted by w_low.
    const std::vector<Segment>& step(int s);

    /// Appends the trapezoids that the last slice or the one before it meets to `out`.
    void around_last_gap(std::vector<std::uint32_t>& out) const;

  private:
    const SliceScene& scene_;
    const SliceFrame& frame_;
    std::vector<Segment> before_;  ///< segments of the slice before
    std::vector<Segment> active_;
    std::vector<Segment> kept_;
    std::vector<Segment> entered_;
};

}  // namespace sonarsim
