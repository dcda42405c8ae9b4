#include "visibility/slices/beam_cutter.h"

#include <cstdint>
#include <iterator>

namespace sonarsim {

BeamCutter::BeamCutter(const SliceFrame& frame, StripQuads& quads, Samples& samples)
    : frame_(frame), quads_(quads), samples_(samples) {}

void BeamCutter::add(const SliceResult& result) {
    if (beam_ + 1 == static_cast<int>(frame_.beam_u.size())) return;  // no width is left
    const MovedEnds* low = &result.low;
    while (frame_.beam_u[beam_ + 1] < result.high.u) {
        move_ends(result.slice, result.spans, frame_.beam_u[beam_ + 1], at_border_[beam_ % 2]);
        quads_.add(result, *low, at_border_[beam_ % 2]);
        low = &at_border_[beam_ % 2];
        end_beam();
    }
    quads_.add(result, *low, result.high);
    if (frame_.beam_u[beam_ + 1] == result.high.u) end_beam();
}

void BeamCutter::end_beam() {
    quads_.end_beam();
    samples_.beam_begin[frame_.first_beam + ++beam_] =
        static_cast<std::uint32_t>(samples_.items.size());
}

}  // namespace sonarsim
