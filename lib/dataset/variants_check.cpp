#include <algorithm>

#include "core/error.h"
#include "core/file.h"
#include "dataset/layout.h"
#include "dataset/ping_metadata.h"
#include "dataset/variants.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json require_variants(const fs::path& folder) {
    std::optional<Json> json = read_variants(folder);
    if (json) return *std::move(json);
    throw InputError({folder.string()},
                     "has no variants.json; give output folders of one mission with variants");
}

}  // namespace

MergeSummary merge_variants(const std::vector<fs::path>& parts, const fs::path& out, int threads,
                            const ProgressCallback& progress, const std::atomic<bool>& stop) {
    const Json json = require_variants(parts.at(0));
    for (const fs::path& part : parts) {
        if (require_variants(part) != json) {
            throw InputError({part.string()},
                             "holds variants of another mission, seed or version "
                             "of sonarsim than " +
                                 parts[0].string());
        }
        std::error_code absent;
        if (fs::equivalent(part, out, absent))
            throw InputError({out.string()},
                             "is one of the parts; name another folder to write to");
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
    begin_variants(out, json, {}, false);
    MergeSummary all;
    all.complete = true;
    for (std::size_t i = 0; i < targets.size() && all.complete; ++i) {
        const MergeSummary one = merge_datasets(sources[i], targets[i], threads, nullptr, stop);
        all.pings += one.pings;
        all.skipped += one.skipped;
        all.complete = one.complete;
        if (progress) progress(i + 1, targets.size());
    }
    return all;
}

DatasetCheck verify_variants(const fs::path& folder, int threads, const ProgressCallback& progress,
                             const std::atomic<bool>& stop) {
    const std::vector<fs::path> folders = folders_of_variants(folder, require_variants(folder));
    DatasetCheck all;
    for (std::size_t i = 0; i < folders.size() && !all.stopped; ++i) {
        const std::string name = folders[i].filename().string();
        if (!fs::exists(folders[i] / description_name)) {
            all.faults.push_back(name +
                                 ": is missing; the render command that made the dataset, "
                                 "run again, makes it");
            continue;
        }
        const DatasetCheck one = verify_dataset(folders[i], threads, nullptr, stop);
        all.files += one.files;
        all.bytes += one.bytes;
        all.more_faults += one.more_faults;
        all.stopped = one.stopped;
        for (const std::string& fault : one.faults)
            all.faults.push_back(name + "/" + fault);
        for (const std::string& stranger : one.strangers)
            all.strangers.push_back(name + "/" + stranger);
        if (progress) progress(i + 1, folders.size());
    }
    return all;
}

}  // namespace sonarsim
