#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace sonarsim {

/// The dataset.json of a folder; nothing when that is not sonarsim's. InputError when it cannot be
/// read.
std::optional<nlohmann::ordered_json> read_description(const std::filesystem::path& folder);

/// The same of a folder that must hold a dataset of this version of the format: else InputError.
nlohmann::ordered_json require_description(const std::filesystem::path& folder);

/// What sets the dataset that `found` describes apart from that of `expected`, to follow "a
/// dataset": "of another mission". Empty when both are the same dataset, complete or not.
std::string difference_between(const nlohmann::ordered_json& found,
                               const nlohmann::ordered_json& expected);

/// "fls/polar/%06d.npy" with a ping number in it; empty for any other text.
std::string numbered(const std::string& pattern, std::uint64_t number);

/// A file of a dataset.
struct DescribedFile {
    std::string name;                                ///< relative to the folder of the dataset
    const nlohmann::ordered_json* sensor = nullptr;  ///< its block; null for what stands beside
    std::string kind;                                ///< "polar", ..., "packs", "records", or empty
};

/// Visits each file that dataset.json says is there, SHA256SUMS included, until `visit` returns
/// false. InputError when the description is damaged.
void for_each_described(const nlohmann::ordered_json& description,
                        const std::function<bool(const DescribedFile&)>& visit);

}  // namespace sonarsim
