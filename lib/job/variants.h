#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "job/merge.h"
#include "job/run_job.h"
#include "job/verify.h"
#include "mission/dataset_names.h"

// The variants of a mission lie below one folder:
//
//     OUT/variants.json         what was drawn for each of them
//     OUT/SHA256SUMS            of variants.json
//     OUT/variant_0000/         a dataset like any other
//
// A shard renders whole variants: those whose index i has i % shards == shard.

namespace sonarsim {

/// The variants.json of a mission.
nlohmann::ordered_json describe_variants(const Mission& mission, std::span<const Mission> variants);

/// The variants.json of a folder; nothing if there is none. InputError when it is not sonarsim's.
std::optional<nlohmann::ordered_json> read_variants(const std::filesystem::path& folder);

/// " (seed: 1 there, 2 here)": what differs in two variants.json, for messages; "" if only the hash
/// of the mission does.
std::string variants_difference(const nlohmann::ordered_json& there,
                                const nlohmann::ordered_json& here);

/// The folders of the variants that a variants.json names, in order.
std::vector<std::filesystem::path> folders_of_variants(const std::filesystem::path& folder,
                                                       const nlohmann::ordered_json& json);

/// The variants.json of the output folder; nothing if it has none. InputError when the folder holds
/// other files, a link or, unless with `overwrite`, other variants than those of `json`.
std::optional<nlohmann::ordered_json> inspect_variants(const std::filesystem::path& folder,
                                                       const nlohmann::ordered_json& json,
                                                       std::span<const Mission> variants,
                                                       bool overwrite);

/// Makes `folder`, which is locked, ready for variants, or throws InputError as inspect_variants();
/// with `overwrite` removes those that another variants.json names.
void begin_variants(const std::filesystem::path& folder, const nlohmann::ordered_json& json,
                    std::span<const Mission> variants, bool overwrite);

/// Called once all variants are complete. InputError if they were made from different files.
void finish_variants(const std::filesystem::path& folder, const nlohmann::ordered_json& json);

/// True if the folder holds a dataset that is complete.
bool is_complete(const std::filesystem::path& dataset);

/// Called before a variant is rendered, with its assembly.
using VariantCallback = std::function<void(const Mission& variant, const Assembly& assembly)>;

/// Renders the variants of a mission, one after the other, each as run_job does. The summary holds
/// the sums over all of them and the warnings about each, with its folder.
RenderSummary run_variants(const Mission& mission, std::span<const Mission> variants,
                           const RenderOptions& options, const VariantCallback& begin,
                           const ProgressCallback& progress, const std::atomic<bool>& stop);

/// Joins the shards of one mission with variants, each variant as merge_datasets does. InputError
/// when the parts are not of one mission, and for a variant that is in none of them.
MergeSummary merge_variants(const std::vector<std::filesystem::path>& parts,
                            const std::filesystem::path& out, int threads,
                            const ProgressCallback& progress, const std::atomic<bool>& stop);

/// Checks each variant as verify_dataset does, that none is missing, and variants.json.
DatasetCheck verify_variants(const std::filesystem::path& folder, int threads,
                             const ProgressCallback& progress, const std::atomic<bool>& stop);

}  // namespace sonarsim
