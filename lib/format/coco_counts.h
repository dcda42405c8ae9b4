#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

/// Encodes the runs of a mask as the text that COCO's tools call compressed RLE. Each number is
/// written in groups of five bits, the lowest first, as characters from '0' on; the sixth bit says
/// that more groups follow. From the fourth number on, the difference from the number two places
/// before is written.
std::string coco_counts(std::span<const std::uint32_t> runs);

}  // namespace sonarsim
