#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/slices/envelope.h"
#include "visibility/slices/setup.h"

namespace sonarsim {

/// A trapezoid that slices between two others may meet.
struct Candidate {
    float u_from;
    float u_to;  ///< exclusive
    std::uint32_t trapezoid;
};

Candidate candidate(const SliceScene& scene, std::uint32_t trapezoid);

/// The segments of the candidates that a slice at u meets, sorted by w_low. The memory of `places`
/// is reused.
void segments_at(const SliceScene& scene, float u, std::span<const Candidate> candidates,
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
