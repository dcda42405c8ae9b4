#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sonarsim {

struct PingTally {
    std::uint64_t done = 0;
    std::uint64_t all = 0;
};

/// The progress of a shard.
struct ShardStatus {
    int shard = 1;  ///< counted from 1
    int shards = 1;
    PingTally pings;
    bool begun = false;
    bool running = false;      ///< a process has its part of the journal open
    double pings_per_s = 0.0;  ///< rate of the last run that wrote to it; 0: unknown
    double age_s = 0.0;        ///< since its last checkpoint
};

/// The progress of a job.
struct JobStatus {
    std::string mission;
    bool complete = false;
    PingTally pings;
    std::vector<std::pair<std::string, PingTally>> sensors;
    std::vector<ShardStatus> shards;  ///< empty once the dataset is complete

    bool running() const;
    /// The sum over the shards that are running.
    double pings_per_s() const;
};

/// Reads the dataset.json and the journals of a dataset that is being rendered, interrupted or
/// complete, or of several folders with the shards of one. InputError when a folder holds no
/// dataset, or one of another mission than the first.
JobStatus read_status(const std::vector<std::filesystem::path>& folders);

/// The progress of the variants of a mission.
struct VariantsStatus {
    std::size_t variants = 0;
    std::size_t complete = 0;
    std::vector<std::pair<std::string, JobStatus>> under_way;  ///< begun, not complete, by folder
};

/// As read_status(), for folders with a variants.json. InputError when one of them has none, or
/// that of another mission than the first.
VariantsStatus read_variants_status(const std::vector<std::filesystem::path>& folders);

}  // namespace sonarsim
