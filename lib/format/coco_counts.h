#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sonarsim {

/// Encodes the runs of a mask as the text that COCO's tools call compressed RLE. Each number is
/// written in groups of five bits, the lowest first, as characters from '0' on; the sixth bit says
/// that more groups follow. From the fourth number on, the difference from the number two places
/// before is written.
std::string coco_counts(std::span<const std::uint32_t> runs);

/// The runs of such a text. Nullopt unless they sum to `pixels` (at most 2^31) and all but the
/// first are above 0.
std::optional<std::vector<std::uint32_t>> coco_runs(std::string_view counts, std::uint64_t pixels);

}  // namespace sonarsim
