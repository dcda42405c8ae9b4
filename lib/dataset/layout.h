#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mission/mission.h"

// Where the files of a dataset lie:
//
//     OUT/dataset.json            what this is, the axes of every sensor, whether it is complete
//     OUT/mission.resolved.yaml   the mission with every default written out
//     OUT/trajectory.tum          the pose of every ping number
//     OUT/<sensor>/polar/NNNNNN.npy   float32 [range, azimuth]: intensity as simulated
//     OUT/<sensor>/image/NNNNNN.png   the same in 16 bits: 65535 intensity / full_scale
//     OUT/<sensor>/fan/NNNNNN.png     8 bits, as an operator sees it
//     OUT/<sensor>/stages/NNNNNN.png  8 bits, five fans: direct, and term after term of the model
//     OUT/<sensor>/meta/NNNNNN.json   time, poses, seed, counts
//
// NNNNNN is the index of the pose on the trajectory, in six digits or as many as the last one
// needs.

namespace sonarsim {

enum class FileKind { polar, image, fan, stages, meta };
inline constexpr FileKind file_kinds[] = {FileKind::polar, FileKind::image, FileKind::fan,
                                          FileKind::stages, FileKind::meta};

/// The name of the kind's folder, and what its files end in (with the dot).
std::string_view name_of(FileKind kind);
std::string_view extension_of(FileKind kind);

/// One ping of a dataset: sensor by its index in Mission::sensors, pose by its index on the
/// trajectory. Ordered by pose, then sensor.
struct PingId {
    std::uint32_t pose = 0;
    std::uint32_t sensor = 0;

    auto operator<=>(const PingId&) const = default;
};

/// Which files a dataset consists of.
struct Layout {
    std::filesystem::path folder;
    std::vector<std::string> sensors;
    std::vector<FileKind> kinds;  ///< those that are written, in the order of writing
    int digits = 6;               ///< of a ping number

    std::string number(std::uint32_t pose) const;
    std::filesystem::path kind_folder(std::size_t sensor, FileKind kind) const;
    std::filesystem::path file(const PingId& ping, FileKind kind) const;
    /// Whether every file of the ping is there. Files appear whole or not at all.
    bool has(const PingId& ping) const;
};

/// InputError when the mission asks for no kind of file at all.
Layout make_layout(const Mission& mission, std::size_t poses);

/// Every ping of a mission, in order. The index in this list decides to which shard a ping belongs.
std::vector<PingId> list_pings(const Mission& mission, std::size_t poses);

}  // namespace sonarsim
