#pragma once

#include <optional>
#include <string>

namespace sonarsim {

/// One of the parts of a mission, counted from 0.
struct Shard {
    int index = 0;
    int count = 1;
};

/// "2/4" of the command line, where shards count from 1. CLI::ValidationError when it is not so.
Shard parse_shard(const std::string& text);

/// The task of the Slurm array that this process runs in: the k-th of its n tasks is shard k/n.
/// Nothing outside of one. InputError when the numbers of the tasks are not evenly spaced.
std::optional<Shard> shard_of_slurm();

}  // namespace sonarsim
