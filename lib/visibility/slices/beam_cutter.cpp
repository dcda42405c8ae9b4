#include "visibility/slices/beam_cutter.h"

#include <cstdint>
#include <iterator>

namespace sonarsim {

BeamCutter::BeamCutter(const SliceFrame& frame, StripQuads& quads, BeamErrors& errors,
                       Samples& samples, bool keeps_compared)
    : frame_(frame),
      quads_(quads),
      errors_(errors),
      samples_(samples),
      keeps_compared_(keeps_compared) {
    errors_.begin_beam(frame_.first_beam);
    begin_ = samples_.items.size();
}

void BeamCutter::replace(const std::vector<Sample>& by) {
    if (beam_ + 1 == std::ssize(frame_.beam_u)) {
        if (keeps_compared_) keep_compared(beam_ - 1, last_begin_, by);
        std::vector<Sample>& items = samples_.items;
        items.resize(last_begin_);
        items.insert(items.end(), by.begin(), by.end());
        begin_ = items.size();
        samples_.beam_begin[frame_.first_beam + beam_] = static_cast<std::uint32_t>(items.size());
        return;
    }
    replaced_ = true;
    by_ = by;
}

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
    std::vector<Sample>& items = samples_.items;
    if (replaced_) {
        if (keeps_compared_) keep_compared(beam_, begin_, by_);
        items.resize(begin_);
        items.insert(items.end(), by_.begin(), by_.end());
    }
    replaced_ = false;
    last_begin_ = begin_;
    begin_ = items.size();
    samples_.beam_begin[frame_.first_beam + ++beam_] =
        static_cast<std::uint32_t>(samples_.items.size());
    if (beam_ + 1 < std::ssize(frame_.beam_u)) errors_.begin_beam(frame_.first_beam + beam_);
}

/// Keeps a beam of the frame, whose samples begin there, and its check. Several frames may share a
/// beam.
void BeamCutter::keep_compared(int beam_of_frame, std::size_t begin,
                               const std::vector<Sample>& check) {
    const int beam = frame_.first_beam + beam_of_frame;
    std::vector<ComparedBeam>& all = samples_.compared;
    if (all.empty() || all.back().beam != beam) all.push_back({beam, {}, {}});
    ComparedBeam& compared = all.back();
    const auto first = samples_.items.begin() + static_cast<std::ptrdiff_t>(begin);
    compared.one.insert(compared.one.end(), first, samples_.items.end());
    compared.other.insert(compared.other.end(), check.begin(), check.end());
}

}  // namespace sonarsim
