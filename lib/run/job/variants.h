#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "input/mission/variants.h"
#include "output/dataset/json.h"
#include "run/job/run_job.h"

// The variants of a mission lie below one folder:
//
//     OUT/variants.json         what was drawn for each of them
//     OUT/variant_0000/         a dataset like any other
//
// A shard renders whole variants: those whose index i has i % shards == shard.

namespace sonarsim {

/// The variants.json of a mission.
Json describe_variants(const Mission& mission, const Variants& variants);

/// The variants.json of a folder; nothing if there is none. InputError when it is not sonarsim's.
std::optional<Json> read_variants(const std::filesystem::path& folder);

/// The folders of the variants that a variants.json names, in order.
std::vector<std::filesystem::path> folders_of_variants(const std::filesystem::path& folder,
                                                       const Json& json);

/// InputError unless a folder has this variants.json, which is that of `first`.
void require_same_variants(const std::filesystem::path& folder, const Json& json,
                           const std::filesystem::path& first);

/// InputError when the folder holds other files, a link or, without `overwrite`, other variants.
void inspect_variants(const std::filesystem::path& folder, const Json& json,
                      const Variants& variants, bool overwrite);

/// Makes or extends variants.json; InputError for another one. The caller holds a lock.
void claim_variants(const std::filesystem::path& folder, const Json& json);

/// True if the folder holds a dataset that is complete.
bool is_complete(const std::filesystem::path& dataset);

/// Called before a variant is rendered, with its assembly.
using VariantCallback = std::function<void(const Mission& variant, const Assembly& assembly)>;

/// Renders the variants of a mission that are not finished, up to two at a time, as run_job does.
/// The summary holds the sums over all and the warnings about each, with its folder.
RenderSummary run_variants(const Mission& mission, const Variants& variants,
                           const RenderOptions& options, const VariantCallback& begin,
                           const ProgressCallback& progress, const std::atomic<bool>& stop);

}  // namespace sonarsim
