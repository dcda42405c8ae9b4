#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/sha256.h"
#include "dataset/layout.h"
#include "dataset/ping_metadata.h"
#include "job/checksums.h"
#include "job/folder_lock.h"
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

/// Compares variants.json with its sum.
void check_common_files(const fs::path& folder, DatasetCheck& check) {
    const auto add = [&](const std::string& fault) {
        check.errors.push_back(fault + "; " + render_variants_again);
    };
    if (!fs::is_regular_file(folder / checksums_name))
        return add(std::string(checksums_name) + ": is missing");
    ++check.files;
    check.bytes += fs::file_size(folder / variants_name);
    const auto sums = read_checksums(folder / checksums_name);
    const auto sum = sums.find(variants_name);
    if (sum == sums.end() || sha256_of_file(folder / variants_name) != sum->second)
        add(std::string(variants_name) + ": differs from SHA256SUMS");
    for (const auto& [name, value] : sums) {
        if (name != variants_name) add(name + ": SHA256SUMS lists it, and variants.json does not");
    }
}

/// Lists the files in the folder of the variants that do not belong to them.
void list_unknown_files(const fs::path& folder, const Json& json, DatasetCheck& check) {
    std::set<std::string> expected{variants_name, checksums_name};
    if (has_gallery(folder)) expected.insert(gallery_name);
    for (const fs::path& variant : folders_of_variants(folder, json))
        expected.insert(variant.filename().string());
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!expected.contains(name)) check.unknown_files.push_back(name);
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
    check_common_files(folder, all);
    list_unknown_files(folder, json, all);
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
