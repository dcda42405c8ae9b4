#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulate/labels/mask_window.h"

namespace sonarsim {

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

/// The outlines that a person draws around bodies: half a resolution cell around, as beam and pulse
/// show them, gaps up to a cell closed and holes filled, but for bins of other bodies. Pieces below
/// a cell are dropped.
std::vector<std::uint16_t> outlined(const MaskFrame& frame, const std::vector<std::uint16_t>& ids);

/// Drops the pieces without a bin that `visible`, PingLabels::visible_object, gives to their
/// object: mirror images of it or in it.
void drop_mirror_images(const MaskFrame& frame, std::span<const std::uint16_t> visible,
                        std::vector<std::uint16_t>& ids);

/// Ids with the bins of `shadow` of the same id, if `has_shadow`, indexed by id, is 1 for it: the
/// pieces of it, not smaller than a resolution cell, that have a line in common with the id.
std::vector<std::uint16_t> with_shadows(const MaskFrame& frame,
                                        const std::vector<std::uint16_t>& ids,
                                        const std::vector<std::uint16_t>& shadow,
                                        std::span<const std::uint8_t> has_shadow);

}  // namespace sonarsim
