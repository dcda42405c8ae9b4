#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "simulate/trace/echo_model.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The bins of a picture, [lines, bins]; a line is a beam, a ping or a step of a sweep.
struct MaskFrame {
    int lines = 0;
    int bins = 0;
    ResolutionCell cell;
    double beam_rad = 0.0;   ///< angle between lines; 0: they are parallel
    double first_bin = 0.0;  ///< bins from where the lines of a fan meet to the first
};

/// The frame of a ping's image.
MaskFrame frame_of(const View& view, const ResolutionCell& cell);

/// Bins on either side of the middle of a cell.
struct CellReach {
    int lines, bins;

    explicit CellReach(const ResolutionCell& cell)
        : lines(static_cast<int>(0.5 * cell.beams)),
          bins(static_cast<int>(0.5 * cell.range_bins)) {}
    float count() const { return static_cast<float>((2 * lines + 1) * (2 * bins + 1)); }
};

/// A box of bins around an object, with a margin that may lie outside the frame, and a number for
/// each of its bins, [lines, bins].
struct MaskWindow {
    int line = 0, bin = 0;  ///< the first
    int lines = 0, bins = 0;
    std::vector<float> values = {};

    /// Calls use(value, index in the frame) for the bins within the frame.
    template <class Use>
    void for_each(const MaskFrame& frame, Use use) {
        for (int j = std::max(line, 0); j < std::min(line + lines, frame.lines); ++j) {
            for (int i = std::max(bin, 0); i < std::min(bin + bins, frame.bins); ++i) {
                use(values[static_cast<std::size_t>(j - line) * bins + (i - bin)],
                    static_cast<std::size_t>(j) * frame.bins + i);
            }
        }
    }
    /// Replaces each value by the sum of those within reach.
    void sum_within(const CellReach& reach);
    /// Changes the value of all bins that are connected to bin k and have its value. Returns them.
    std::vector<int> flood(int k, float value, bool diagonal);
};

/// A window around the bins of each id but 0, with ones in these bins and zeros elsewhere. Its
/// margin is wider than twice the reach.
std::map<std::uint16_t, MaskWindow> windows_of(const MaskFrame& frame, const CellReach& reach,
                                               std::span<const std::uint16_t> ids);

}  // namespace sonarsim
