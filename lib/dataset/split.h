#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mission/mission.h"

namespace sonarsim {

/// The use of a pose of the trajectory.
enum class SplitPart : std::uint8_t { train, val, test, none };

/// Names of the parts, by SplitPart; without `none`.
inline constexpr std::array<std::string_view, 3> split_part_names{"train", "val", "test"};

/// "split/train.txt", the list of a part, relative to the folder of the dataset or the variants.
std::string split_file_of(std::string_view part);

/// The share of a part.
double share_of(const SplitConfig& config, SplitPart part);

/// The parts that have a share, of a split that is on.
std::vector<SplitPart> parts_of(const SplitConfig& config);

/// The part of each pose. The trajectory is divided into rounds of equal length, and each round
/// into train, val and test in this order. The poses of the gap about a border belong to no part,
/// so that no two parts have neighbouring poses. InputError when a part would get no pose.
std::vector<SplitPart> split_poses(const SplitConfig& config, std::size_t poses);

/// The part of each variant, as split_poses() but without gaps, since variants have no neighbours.
/// A part whose share is too small for a variant gets none. If there are fewer variants than parts,
/// the first part gets all of them.
std::vector<SplitPart> split_variants(const SplitConfig& config, std::size_t variants);

}  // namespace sonarsim
