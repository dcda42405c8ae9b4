#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/sha256.h"
#include "dataset/coco/join.h"
#include "dataset/layout.h"
#include "dataset/ping_metadata.h"
#include "dataset/split.h"
#include "job/checksums.h"
#include "job/folder_lock.h"
#include "job/joined_labels.h"
#include "job/variant_inputs.h"
#include "job/variants.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* render_variants_again =
    "the render command that made the variants, run again, writes it anew";

Json require_variants(const fs::path& folder) {
    std::optional<Json> json = read_variants(folder);
    if (json) return *std::move(json);
    throw InputError({folder.string()},
                     "has no variants.json; give output folders of one mission with variants");
}

/// The files that all variants share, without SHA256SUMS. The joined labels are there once all
/// variants are.
std::set<std::string> common_names(const fs::path& folder, const Json& json) {
    std::set<std::string> names{variants_name};
    for (const auto& [name, lines] : split_lists(json))
        names.insert(name);
    const std::vector<fs::path> folders = folders_of_variants(folder, json);
    if (std::ranges::all_of(folders, is_complete)) {
        for (const std::string& name : label_files_of(json, folders))
            names.insert(name);
    }
    return names;
}

bool is_label_file(const std::string& name) {
    return name.starts_with(std::string(labels_folder_name) + "/");
}

/// Compares the files that all variants share with their sums.
void check_common_files(const fs::path& folder, const std::set<std::string>& expected,
                        DatasetCheck& check) {
    const fs::path sums_file = folder / checksums_name;
    if (!fs::is_regular_file(sums_file)) {
        check.errors.push_back(std::string(checksums_name) + ": is missing; " +
                               render_variants_again);
        return;
    }
    const auto sums = read_checksums(sums_file);
    for (const std::string& name : expected) {
        const auto sum = sums.find(name);
        if (!is_own_file(folder, name)) {
            check.errors.push_back(name + ": is missing, or lies behind a link; " +
                                   render_variants_again);
            continue;
        }
        ++check.files;
        check.bytes += fs::file_size(folder / name);
        if (sum == sums.end() || sha256_of_file(folder / name) != sum->second)
            check.errors.push_back(name + ": differs from SHA256SUMS; " + render_variants_again);
    }
    const bool has_labels = std::ranges::any_of(expected, is_label_file);
    for (const auto& [name, sum] : sums) {
        const bool waits = is_label_file(name) && !has_labels;  // for a variant that is missing
        if (!expected.contains(name) && !waits)
            check.errors.push_back(name + ": SHA256SUMS lists it, and variants.json does not; " +
                                   render_variants_again);
    }
}

/// Lists the files in the folder of the variants that do not belong to them.
void list_unknown_files(const fs::path& folder, const Json& json, std::set<std::string> expected,
                        DatasetCheck& check) {
    expected.insert({checksums_name, split_folder_name, labels_folder_name});
    for (const std::string& name : all_joined_label_files())
        expected.insert(name);
    if (has_gallery(folder)) expected.insert(gallery_name);
    for (const fs::path& variant : folders_of_variants(folder, json))
        expected.insert(variant.filename().string());
    for (const fs::path& here : {folder, folder / split_folder_name, folder / labels_folder_name}) {
        if (!fs::is_directory(here)) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(here)) {
            const std::string name = entry.path().lexically_relative(folder).string();
            if (!expected.contains(name)) check.unknown_files.push_back(name);
        }
    }
    std::ranges::sort(check.unknown_files);
}

}  // namespace

std::string variants_difference(const Json& there, const Json& here) {
    std::string text;
    const auto add = [&](const std::string& name, const Json& before, const Json& now) {
        if (before == now) return;
        text += (text.empty() ? " (" : "; ") + name + ": " + before.dump() + " there, " +
                now.dump() + " here";
    };
    for (const char* key : {"mission", "seed", "program_version"})
        add(key, there.value(key, Json()), here.value(key, Json()));
    add("variants", there.at("variants").size(), here.at("variants").size());
    return text.empty() ? "" : text + ")";
}

std::map<std::string, std::string> split_lists(const Json& json) {
    std::map<std::string, std::string> lists;
    for (const Json& variant : json.at("variants")) {
        const std::string part = variant.value("split", "");
        if (std::ranges::find(split_part_names, part) != split_part_names.end())
            lists[split_file_of(part)] += variant.at("folder").get<std::string>() + '\n';
    }
    return lists;
}

MergeSummary merge_variants(const std::vector<fs::path>& parts, const fs::path& out, int threads,
                            const ProgressCallback& progress, const std::atomic<bool>& stop) {
    require_apart(parts, out);
    const Json json = require_variants(parts.at(0));
    for (const fs::path& part : parts) {
        const Json own = require_variants(part);
        if (own != json) {
            throw InputError({part.string()},
                             "holds variants of another mission, seed or version "
                             "of sonarsim than " +
                                 parts[0].string() + variants_difference(own, json));
        }
    }
    const std::vector<fs::path> targets = folders_of_variants(out, json);
    std::vector<std::vector<fs::path>> sources(targets.size());
    for (const fs::path& part : parts) {
        const std::vector<fs::path> own = folders_of_variants(part, json);
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (fs::exists(own[i] / description_name)) sources[i].push_back(own[i]);
        }
    }
    const auto missing = std::ranges::find_if(sources, [](const auto& s) { return s.empty(); });
    if (missing != sources.end()) {
        const std::string name = targets[missing - sources.begin()].filename().string();
        throw InputError(name +
                         " is in none of the parts; render what is missing, or name its "
                         "folder, too");
    }
    std::vector<fs::path> all_sources;
    for (const std::vector<fs::path>& own : sources)
        all_sources.insert(all_sources.end(), own.begin(), own.end());
    require_same_inputs(all_sources);
    const FolderLock lock = lock_alone(out);
    begin_variants(out, json, {}, false);
    MergeSummary all{.unlocked = !lock.works()};
    all.complete = true;
    for (std::size_t i = 0; i < targets.size() && all.complete; ++i) {
        const MergeSummary one = merge_datasets(sources[i], targets[i], threads, nullptr, stop);
        all.pings += one.pings;
        all.skipped += one.skipped;
        all.complete = one.complete;
        all.unlocked = all.unlocked || one.unlocked;
        if (progress) progress(i + 1, targets.size());
    }
    if (all.complete) finish_variants(out, json);
    return all;
}

DatasetCheck verify_variants(const fs::path& folder, int threads, const ProgressCallback& progress,
                             const std::atomic<bool>& stop) {
    const Json json = require_variants(folder);
    const std::vector<fs::path> folders = folders_of_variants(folder, json);
    DatasetCheck all;
    const std::set<std::string> names = common_names(folder, json);
    check_common_files(folder, names, all);
    list_unknown_files(folder, json, names, all);
    for (std::size_t i = 0; i < folders.size() && !all.stopped; ++i) {
        const std::string name = folders[i].filename().string();
        if (!fs::exists(folders[i] / description_name)) {
            all.errors.push_back(name +
                                 ": is missing; the render command that made the dataset, "
                                 "run again, makes it");
            continue;
        }
        const DatasetCheck one = verify_dataset(folders[i], threads, nullptr, stop);
        all.files += one.files;
        all.bytes += one.bytes;
        all.more_errors += one.more_errors;
        all.stopped = one.stopped;
        for (const std::string& error : one.errors)
            all.errors.push_back(name + "/" + error);
        for (const std::string& file : one.unknown_files)
            all.unknown_files.push_back(name + "/" + file);
        if (progress) progress(i + 1, folders.size());
    }
    return all;
}

}  // namespace sonarsim
