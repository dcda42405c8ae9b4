#pragma once

#include <vector>

#include "visibility/slices/envelope.h"
#include "visibility/slices/setup.h"

namespace sonarsim {

/// Walks the slices of a frame in order and keeps the segments that each of them meets sorted.
class SliceWalk {
  public:
    void start(const SliceScene& scene, const SliceFrame& frame);

    /// Steps to the next slice, of index `s`, and returns its segments, sorted by w_low.
    const std::vector<Segment>& step(int s);

  private:
    void drop_ended(int s);
    void evaluate(float u, std::vector<Segment>& segments) const;

    const SliceScene* scene_ = nullptr;
    const SliceFrame* frame_ = nullptr;
    std::vector<Segment> active_;
    std::vector<Segment> fresh_;
    std::vector<Segment> merged_;
};

}  // namespace sonarsim
