#include "job/verify.h"

#include <map>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "core/ordered_pipeline.h"
#include "core/sha256.h"
#include "dataset/description.h"
#include "dataset/file_names.h"
#include "dataset/layout.h"
#include "job/checksums.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// A description may claim any number of pings, and each missing file is an error.
constexpr std::size_t most_errors = 1000;

constexpr const char* render_again =
    "the render command that made the dataset, run again, makes it anew";

void add_error(DatasetCheck& check, const std::string& error) {
    check.errors.size() < most_errors ? check.errors.push_back(error) : void(++check.more_errors);
}

/// A file to be checked.
struct Task {
    std::string name;
    std::string sum;
};

/// The files to be checked; adds an error for each that is missing.
std::vector<Task> list_tasks(const fs::path& folder, const DatasetFile& dataset,
                             const std::map<std::string, std::string>& sums,
                             std::set<std::string>& expected, DatasetCheck& check) {
    std::vector<Task> tasks;
    for_each_described(dataset, [&](const DescribedFile& file) {
        expected.insert(file.name);
        const auto sum = sums.find(file.name);
        if (!fs::is_regular_file(folder / file.name)) {
            add_error(check, file.name + ": is missing; " + render_again);
        } else if (!is_own_file(folder, file.name)) {
            add_error(check, file.name +
                                 ": lies behind a symbolic link; put the file itself in its place");
        } else if (sum != sums.end()) {
            tasks.push_back({file.name, sum->second});
        } else if (file.name != checksums_name && !sums.empty()) {
            add_error(check, file.name +
                                 ": SHA256SUMS does not list it; remove SHA256SUMS, and the render "
                                 "command that made the dataset writes it again");
        }
        return check.more_errors == 0;
    });
    return tasks;
}

/// The cure for a damaged file. dataset.json stays: without it a folder is no dataset any more.
std::string cure_of(const std::string& name) {
    if (name != description_name) return std::string("remove it, and ") + render_again;
    return std::string("remove ") + checksums_name + ", and " + render_again;
}

void check_files(const fs::path& folder, const std::vector<Task>& tasks, int threads,
                 const ProgressCallback& progress, const std::atomic<bool>& stop,
                 DatasetCheck& check) {
    ordered_pipeline(
        tasks.size(), 4 * static_cast<std::size_t>(threads), stop,
        [&](std::size_t i) { return sha256_of_file(folder / tasks[i].name) == tasks[i].sum; },
        [&](bool is_whole) {
            const std::string& name = tasks[check.files++].name;
            check.bytes += fs::file_size(folder / name);
            if (!is_whole)
                add_error(check, name + ": its bytes differ from SHA256SUMS; " + cure_of(name));
            if (progress) progress(check.files, tasks.size());
        });
    check.stopped = check.files < tasks.size();
}

/// Files that dataset.json does not list, without the page of `sonarsim gallery`. Links are not
/// followed: they lead out of the folder.
std::vector<std::string> unknown_files_in(const fs::path& folder,
                                          const std::set<std::string>& expected) {
    std::vector<std::string> unknown;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        std::string name = entry.path().lexically_relative(folder).string();
        const bool is_folder = entry.symlink_status().type() == fs::file_type::directory;
        const bool is_of_page = name == gallery_name || name.starts_with(gallery_files);
        if (!is_folder && !is_of_page && !expected.contains(name))
            unknown.push_back(std::move(name));
    }
    std::ranges::sort(unknown);
    return unknown;
}

}  // namespace

DatasetCheck verify_dataset(const fs::path& folder, int threads, const ProgressCallback& progress,
                            const std::atomic<bool>& stop) {
    const DatasetFile dataset = require_dataset(folder);
    DatasetCheck check;
    if (!dataset.complete) {
        add_error(check, std::string(description_name) +
                             ": the dataset is not complete; the render command that made it, run "
                             "again, goes on with it");
    }
    std::map<std::string, std::string> sums;
    const fs::path sums_file = folder / checksums_name;
    if (fs::is_regular_file(sums_file)) sums = read_checksums(sums_file);
    std::set<std::string> expected;
    const std::vector<Task> tasks = list_tasks(folder, dataset, sums, expected, check);
    if (check.more_errors == 0) {
        for (const auto& [name, sum] : sums) {
            if (!expected.contains(name)) {
                add_error(check, name +
                                     ": SHA256SUMS lists it, and dataset.json does not; one of "
                                     "them was changed: render the dataset anew (--overwrite)");
            }
        }
        if (has_gallery(folder)) expected.insert(gallery_name);
        check.unknown_files = unknown_files_in(folder, expected);
    }
    on_threads(threads, [&](int n) { check_files(folder, tasks, n, progress, stop, check); });
    return check;
}

}  // namespace sonarsim
