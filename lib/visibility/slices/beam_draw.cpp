#include "visibility/slices/beam_draw.h"

#include <algorithm>

#include "core/random.h"

namespace sonarsim {

namespace {

constexpr PhiloxKey draw_key{0x64726177U, 0};

/// The random point of a unit of the line.
double point_in(std::uint32_t unit) {
    return unit + static_cast<double>(unit_float(philox({unit, 0, 0, 0}, draw_key).x0));
}

}  // namespace

BeamDraw::BeamDraw() : next_(point_in(0)) {}

double BeamDraw::weight(double rate) {
    const double length = std::min(rate, 1.0);
    rates_ += length;
    int draws = 0;
    for (; next_ < rates_; next_ = point_in(++units_))
        ++draws;
    return rate < 1.0 ? draws / length : 1.0;
}

}  // namespace sonarsim
