#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "simulate/product/annotation.h"
#include "simulate/product/fan.h"

namespace sonarsim {

/// The bin at the centre of each pixel of a fan, for ids, which have no mean. An index into
/// [beams, range bins], beam after beam; -1 outside the sector.
struct FanBins {
    FanFrame frame;
    std::vector<std::int32_t> by_row;     ///< [height, width]
    std::vector<std::int32_t> by_column;  ///< [width, height]
    /// The box around the pixels of each bin; empty (left = right) for a bin between pixels.
    std::vector<PixelBox> boxes;
};

/// Makes the bins for the same fan as make_fan_map(sonar).
FanBins make_fan_bins(const Sonar& sonar);

/// The values of `by_beam` [beams, range bins] at the bins of a fan's pixels; `blank` outside the
/// sector.
template <class T>
std::vector<T> fan_values(std::span<const std::int32_t> bins, const std::vector<T>& by_beam,
                          T blank) {
    std::vector<T> out(bins.size());
    for (std::size_t k = 0; k < bins.size(); ++k)
        out[k] = bins[k] < 0 ? blank : by_beam[static_cast<std::size_t>(bins[k])];
    return out;
}

}  // namespace sonarsim
