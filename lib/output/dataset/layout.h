#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "output/dataset/writer.h"

// The files of a dataset:
//
//     OUT/dataset.json                what this is, axes of the sensors, whether it is complete
//     OUT/mission.resolved.yaml       the mission with every default written out
//     OUT/SHA256SUMS                  of every other file, once all of them are there
//     OUT/trajectory.tum              the pose of every ping number
//     OUT/journal.txt                 the size and hash of every file of a ping; during a run
//                                     parts of it lie in OUT/journal.d/ (run/job/journal.h)
//     OUT/<sensor>/<format>/NNNNNN.*  a file per ping
//     OUT/<sensor>/*                  files of records, one per ping, and products of them
//     OUT/seabed/*                    the true heights and objects of a generated sea bed
//
// The files in dataset/writers are the formats. A record that is not written yet is zero. NNNNNN is
// the index of the pose on the trajectory, in six digits or as many as the last one needs.

namespace sonarsim {

/// "3-of-8.txt": the part of the journal that a shard, counted from 1, writes.
std::string journal_part(int shard, int shards);
/// The parts of the journal: regular files, no links. Other runs may remove them meanwhile.
std::vector<std::filesystem::path> journal_parts(const std::filesystem::path& folder);

struct SensorLayout {
    std::string name;
    std::uint32_t every = 1;  ///< pings at every n-th pose
    std::size_t pings = 0;
    Writers writers;
};

struct Layout {
    std::filesystem::path folder;
    std::vector<SensorLayout> sensors;
    /// Files of no single sensor: those of a generated sea bed, and the reported poses.
    std::vector<std::string> products;
    std::size_t poses = 0;
    int digits = 6;  ///< digits of a ping number

    std::string number(std::uint32_t pose) const;
    std::filesystem::path sensor_folder(std::size_t sensor) const;
    std::filesystem::path file(const PingId& ping, const PingFile& kind) const;
    /// The index of a ping among those of its sensor.
    std::size_t record_of(const PingId& ping) const;
    /// Every folder of the dataset but `folder` itself, parents first.
    std::vector<std::filesystem::path> folders() const;
};

/// `writers` by sensor.
Layout make_layout(const Mission& mission, std::vector<Writers> writers, std::size_t poses);

/// Every ping of a mission, in order.
std::vector<PingId> list_pings(const Mission& mission, std::size_t poses);

}  // namespace sonarsim
