#include "shard.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdlib>

#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::int64_t max_shards = 1'000'000;

std::optional<std::int64_t> number_in_environment(const char* name) {
    const char* const text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
    return text != nullptr ? parse_integer(text) : std::nullopt;
}

}  // namespace

Shard parse_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto shard = parse_integer(text.substr(0, slash));
    const auto shards =
        slash == std::string::npos ? std::nullopt : parse_integer(text.substr(slash + 1));
    if (!shard || !shards || *shard < 1 || *shard > *shards || *shards > max_shards) {
        throw CLI::ValidationError("--shard", "'" + text + "' is not of the form 1/4 to 4/4");
    }
    return {static_cast<int>(*shard - 1), static_cast<int>(*shards)};
}

std::optional<Shard> shard_of_slurm() {
    const auto id = number_in_environment("SLURM_ARRAY_TASK_ID");
    const auto count = number_in_environment("SLURM_ARRAY_TASK_COUNT");
    if (!id || !count) return std::nullopt;
    const std::int64_t first = number_in_environment("SLURM_ARRAY_TASK_MIN").value_or(1);
    const std::int64_t last = number_in_environment("SLURM_ARRAY_TASK_MAX").value_or(*count);
    const std::int64_t step = *count > 1 ? (last - first) / (*count - 1) : 1;
    const bool even = *count >= 1 && *count <= max_shards && step >= 1 && *id >= first &&
                      last - first == step * (*count - 1) && (*id - first) % step == 0 &&
                      (*id - first) / step < *count;
    if (!even) {
        throw InputError(
            "task " + std::to_string(*id) + " of a Slurm array of " + std::to_string(*count) +
            " tasks from " + std::to_string(first) + " to " + std::to_string(last) +
            " is not a shard, since these are not evenly spaced; submit --array=1-N, or "
            "say which shard it is with --shard I/N");
    }
    return Shard{static_cast<int>((*id - first) / step), static_cast<int>(*count)};
}

}  // namespace sonarsim
