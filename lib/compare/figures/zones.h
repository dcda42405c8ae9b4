#pragma once

#include <span>
#include <vector>

namespace sonarsim {

/// Ranges [from, to) of an image.
struct RangeZone {
    int from = 0;
    int to = 0;

    bool holds(int first, int last) const { return first >= from && last <= to; }
};

/// The parts of an image by the level of its ranges. Without a bottom that stands out, `bottom` is
/// all of the image and the other two are empty.
struct Zones {
    RangeZone water;   ///< nearer than the bottom, and weak
    RangeZone bottom;  ///< the strongest ranges
    RangeZone tail;    ///< behind the bottom, and weak
};

/// The zones of the mean powers of ranges. The powers are smoothed over 1/44 of the ranges. The
/// bottom is the run of ranges about the strongest that lie within 10 dB of it; the strongest is
/// sought from 1/28 of the ranges on, beyond the transmitter's ringing. The water begins there and
/// ends where the level has risen by a third (in dB) from its least to the bottom's edge. The tail
/// begins where the level has fallen by half (in dB) from the bottom's edge to the least level
/// behind it. A bottom stands out if the least level lies 15 dB below the strongest. These shares
/// are chosen; on three pings of a real sonar over a rough bottom they find the ranges that a
/// person had marked.
Zones zones_of(std::span<const double> mean_powers);

}  // namespace sonarsim
