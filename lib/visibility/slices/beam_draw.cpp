#include "visibility/slices/beam_draw.h"

#include <algorithm>

#include "core/random.h"

namespace sonarsim {

namespace {

constexpr PhiloxKey draw_key{0x64726177U, 0};

}  // namespace

BeamDraw::BeamDraw(std::uint32_t number) : number_(number), next_(next_point()) {}

double BeamDraw::weight(double rate) {
    const double length = std::min(rate, 1.0);
    rates_ += length;
    int draws = 0;
    for (; next_ < rates_; next_ = next_point()) {
        ++units_;
        ++draws;
    }
    return rate < 1.0 ? draws / length : 1.0;
}

/// The random point of the present unit of the line.
double BeamDraw::next_point() const {
    return units_ + static_cast<double>(unit_float(philox({units_, number_, 0, 0}, draw_key).x0));
}

}  // namespace sonarsim
