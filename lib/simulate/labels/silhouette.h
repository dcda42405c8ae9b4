#pragma once

#include <algorithm>
#include <cstddef>

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
    bool full_turn = false;  ///< the last line is next to the first
};

MaskFrame frame_of(const View& view, const ResolutionCell& cell);

/// Bins on either side of the middle of a cell.
struct CellReach {
    int lines, bins;

    explicit CellReach(const ResolutionCell& cell)
        : lines(static_cast<int>(0.5 * cell.beams)),
          bins(static_cast<int>(0.5 * cell.range_bins)) {}
    float count() const { return static_cast<float>((2 * lines + 1) * (2 * bins + 1)); }
};

/// A number for each bin, [lines, bins], of a box around an object, maybe beyond the frame. Over
/// the seam of a full turn lines are counted on.
struct MaskWindow {
    std::uint16_t id = 0;   ///< the object's
    int line = 0, bin = 0;  ///< the first
    int lines = 0, bins = 0;
    std::vector<float> values = {};

    /// Calls use(value, index in the frame) for the bins within the frame.
    template <class Use>
    void for_each(const MaskFrame& frame, Use use) {
        for (int j = line; j < line + lines; ++j) {
            const int at = frame.full_turn ? (j + 2 * frame.lines) % frame.lines : j;
            if (at < 0 || at >= frame.lines) continue;
            for (int i = std::max(bin, 0); i < std::min(bin + bins, frame.bins); ++i) {
                use(values[static_cast<std::size_t>(j - line) * bins + (i - bin)],
                    static_cast<std::size_t>(at) * frame.bins + i);
            }
        }
    }
    /// Replaces each value by the sum of those within reach.
    void sum_within(const CellReach& reach);
    /// Changes the value of all bins that are connected to bin k and have its value. Returns them.
    std::vector<int> flood(int k, float value, bool diagonal);
};

/// A window of ones in the bins of each id but 0; its margin is wider than twice the reach.
std::vector<MaskWindow> windows_of(const MaskFrame& frame, const CellReach& reach,
                                   std::span<const std::uint16_t> ids);

/// The expected content of the bins of a ping, [beams, range bins].
struct ExpectedBins {
    MaskFrame frame;
    std::span<const std::uint16_t> object;  ///< PingLabels::own_object
    std::span<const float> echo;            ///< this echo
    std::span<const float> whole;           ///< all that the bin holds, in the unit of echoes
};

/// The bins that an object of `ping` has and in which its echo within a resolution cell is at least
/// `least_ratio` times that of all other surface there and `noise`, the mean noise of a cell by
/// range bin, which may be empty. Bins without an echo of an object do not matter.
std::vector<std::uint16_t> find_bodies(const ExpectedBins& ping, std::span<const float> noise,
                                       float min_ratio);

/// Adds to bodies the bins of `bright` that they do not have, such as the foot of a wall, but not
/// whiskers: with the body of the same id they fill squares of three bins, or stretches of three in
/// a single line.
void add_bright(const MaskFrame& frame, const std::vector<std::uint16_t>& bright,
                std::vector<std::uint16_t>& bodies);

/// The outlines that a person draws around bodies: half a resolution cell around, gaps up to a cell
/// closed and holes filled, but for bins of other bodies. Pieces below a cell are dropped.
std::vector<std::uint16_t> outlined(const MaskFrame& frame, const std::vector<std::uint16_t>& ids);

/// Drops mirror images: pieces without a bin that PingLabels::visible_object gives to their object.
void drop_mirror_images(const MaskFrame& frame, std::span<const std::uint16_t> visible,
                        std::vector<std::uint16_t>& ids);

/// Ids with the bins of `shadow` of the same id, if `has_shadow`, indexed by id, is 1 for it: the
/// pieces of it, not smaller than a resolution cell, that have a line in common with the id.
std::vector<std::uint16_t> with_shadows(const MaskFrame& frame,
                                        const std::vector<std::uint16_t>& ids,
                                        const std::vector<std::uint16_t>& shadow,
                                        std::span<const std::uint8_t> has_shadow);

}  // namespace sonarsim
