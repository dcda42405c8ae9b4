#include <set>

#include "run/job/dataset_folders.h"
#include "run/job/folder.h"
#include "run/job/journal.h"
#include "run/job/variants.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// Adds the progress of one dataset, whose pings lie in `folders`.
void add_dataset(const std::vector<fs::path>& folders, JobStatus& status) {
    const DatasetFile dataset = require_dataset(folders.at(0));
    status.mission = dataset.mission;
    std::set<PingId> done;
    bool complete = false;
    for (const fs::path& folder : folders) {
        complete = require_part(folder, folders[0]).complete || complete;
        status.running = status.running || is_written(folder);
        for (const auto& [ping, fields] : read_journal(folder))
            done.insert(ping);
    }
    status.complete_variants += complete;
    status.pings += complete ? count_pings(dataset) : done.size();
    status.all_pings += count_pings(dataset);
}

}  // namespace

JobStatus read_status(const std::vector<fs::path>& folders) {
    JobStatus status;
    for (const fs::path& folder : folders) {
        if (is_written(folder) && !fs::exists(folder / description_name) && !read_variants(folder))
            throw InputError({folder.string()}, "a job has begun here, and no ping is ready yet");
    }
    const auto json = read_variants(folders.at(0));
    if (!json) {
        add_dataset(folders, status);
        return status;
    }
    status.mission = json->value("mission", "");
    for (const fs::path& folder : folders)
        require_same_variants(folder, *json, folders[0]);
    std::uint64_t found = 0;
    for (const fs::path& name : folders_of_variants("", *json)) {
        ++status.variants;
        std::vector<fs::path> begun;
        for (const fs::path& folder : folders) {
            if (fs::exists(folder / name / description_name)) begun.push_back(folder / name);
        }
        if (!begun.empty()) add_dataset(begun, status);
        found += begun.empty() ? 0 : 1;
    }
    // Variants that have not begun count as the mean of the others.
    if (found > 0) status.all_pings = status.all_pings * status.variants / found;
    status.running = status.running || std::ranges::any_of(folders, is_written);
    return status;
}

}  // namespace sonarsim
