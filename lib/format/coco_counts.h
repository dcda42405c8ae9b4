#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

/// The runs of a mask as the text that COCO's tools call compressed RLE: each number (from the
/// fourth on its difference from the one before the last) in groups of five bits, the lowest first,
/// as characters from '0' on; the sixth bit tells that more follow.
std::string coco_counts(std::span<const std::uint32_t> runs);

}  // namespace sonarsim
