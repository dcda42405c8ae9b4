#pragma once

#include <optional>
#include <string>

namespace sonarsim {

/// One part of a mission, counted from 0.
struct Shard {
    int index = 0;
    int count = 1;
};

/// Parses "2/4" of the command line, where shards count from 1. Throws CLI::ValidationError.
Shard parse_shard(const std::string& text);

/// The shard of this process in a Slurm array: the k-th of its n tasks is shard k/n. Nothing
/// outside of an array. Throws InputError when the numbers of the tasks are not evenly spaced.
std::optional<Shard> shard_of_slurm();

}  // namespace sonarsim
