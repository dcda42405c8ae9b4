#include "job/joined_labels.h"

#include <algorithm>

#include "core/file.h"
#include "core/sha256.h"
#include "dataset/coco/join.h"
#include "job/checksums.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

SplitPart part_named(const std::string& name) {
    const auto found = std::ranges::find(split_part_names, name);
    return static_cast<SplitPart>(found - split_part_names.begin());
}

std::vector<CocoMember> members_of(const Json& json, std::span<const fs::path> variants) {
    std::vector<CocoMember> members;
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const std::string part = json.at("variants").at(i).value("split", "none");
        members.push_back(coco_member(require_dataset(variants[i]), variants[i].filename().string(),
                                      part_named(part)));
    }
    return members;
}

/// True if SHA256SUMS lists the files and they have its sums.
bool are_whole(const fs::path& folder, const std::vector<std::string>& files) {
    if (!fs::is_regular_file(folder / checksums_name)) return false;
    const auto sums = read_checksums(folder / checksums_name);
    return std::ranges::all_of(files, [&](const std::string& file) {
        const auto sum = sums.find(file);
        return sum != sums.end() && fs::is_regular_file(folder / file) &&
               sha256_of_file(folder / file) == sum->second;
    });
}

}  // namespace

std::vector<std::string> label_files_of(const Json& json, std::span<const fs::path> variants) {
    return joined_label_files(members_of(json, variants));
}

void write_label_files(const fs::path& folder, const Json& json, std::span<const fs::path> variants,
                       const std::string& sums) {
    const std::vector<CocoMember> members = members_of(json, variants);
    const std::vector<std::string> files = joined_label_files(members);
    if (files.empty() || are_whole(folder, files)) return;
    write_joined_labels(folder, members, classes_of(members), json.at("mission"));
    std::string all = sums;
    for (const std::string& file : files)
        all += checksum_line(sha256_of_file(folder / file), file);
    sync_file_system(folder);
    write_file_durably(folder / checksums_name, all);
}

void remove_label_files(const fs::path& folder) {
    for (const std::string& file : all_joined_label_files())
        fs::remove(folder / file);
    std::error_code not_empty;
    fs::remove(folder / labels_folder_name, not_empty);
}

}  // namespace sonarsim
