#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/ordered_pipeline.h"
#include "output/dataset/dataset_file.h"
#include "output/dataset/layout.h"
#include "run/job/dataset_folders.h"
#include "run/job/variants.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr const char* render_again = "run the render command of the dataset again";

struct Task {
    std::string name;  ///< relative to the folder that is checked
    std::string sum;
};

/// The sums in a SHA256SUMS by file, relative to its folder. InputError for a line that is not 64
/// hexadecimal digits, two blanks and the name of a file below that folder.
std::map<std::string, std::string> read_checksums(const fs::path& file) {
    constexpr std::size_t largest = std::size_t{1} << 32;
    constexpr std::size_t digits = 64;
    std::map<std::string, std::string> sums;
    std::istringstream lines(read_file(file, largest));
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        const bool split = line.size() > digits + 2 && line.compare(digits, 2, "  ") == 0 &&
                           line.find_first_not_of("0123456789abcdef") == digits;
        const fs::path name = split ? line.substr(digits + 2) : "";
        // The last line of a file that was cut off has no line feed.
        if (lines.eof() || name.empty() || name.is_absolute() ||
            std::ranges::find(name, fs::path("..")) != name.end()) {
            refuse({file.string(), number},
                   "is not a SHA-256 sum, two blanks and the name of a file of the dataset; remove "
                   "SHA256SUMS, and the render command that made the dataset writes it again");
        }
        sums[name.string()] = line.substr(0, digits);
    }
    return sums;
}

/// Adds the files in the folder `prefix` of `top` that are not, nor lie in, an expected one.
void list_strangers(const fs::path& top, const fs::path& prefix,
                    const std::set<std::string>& expected, DatasetCheck& check) {
    for (fs::recursive_directory_iterator entry(top / prefix), end; entry != end; ++entry) {
        const std::string name = entry->path().lexically_relative(top / prefix).string();
        const bool is_folder = entry->symlink_status().type() == fs::file_type::directory;
        // The page of sonarsim gallery is not part of the dataset.
        const bool is_of_page =
            name == gallery_name || name.starts_with(gallery_folder_name + std::string("/"));
        if (expected.contains(name))
            entry.disable_recursion_pending();
        else if (!is_folder && !is_of_page)
            check.unknown_files.push_back((prefix / name).string());
    }
}

/// Adds the files of a dataset to `tasks`, and to `check` what can be said without reading them.
/// `prefix` is the folder of the dataset in the folder that is checked.
void list_tasks(const fs::path& top, const std::string& prefix, std::vector<Task>& tasks,
                DatasetCheck& check) {
    const fs::path folder = top / prefix;
    const auto add_error = [&](const std::string& name, const std::string& what) {
        check.errors.push_back((fs::path(prefix) / name).string() + ": " + what);
    };
    const DatasetFile dataset = require_dataset(folder);
    if (!dataset.complete)
        add_error(description_name, std::string("the dataset is not complete; ") + render_again);
    if (!fs::is_regular_file(folder / checksums_name))
        return add_error(checksums_name, std::string("is missing; ") + render_again);
    const std::map<std::string, std::string> sums = read_checksums(folder / checksums_name);
    std::set<std::string> expected{checksums_name};
    for (const std::string& name : list_files(folder, dataset)) {
        expected.insert(name);
        const auto sum = sums.find(name);
        if (!fs::is_regular_file(folder / name))
            add_error(name, std::string("is missing; ") + render_again);
        else if (sum != sums.end())
            tasks.push_back({(fs::path(prefix) / name).string(), sum->second});
        else
            add_error(name,
                      "SHA256SUMS does not list it; remove SHA256SUMS, and the render command "
                      "that made the dataset writes it again");
    }
    for (const auto& [name, sum] : sums) {
        if (!expected.contains(name))
            add_error(name,
                      "SHA256SUMS lists it, and dataset.json does not; one of them was "
                      "changed: render the dataset again (--overwrite)");
    }
    list_strangers(top, prefix, expected, check);
}

/// The cure for a damaged file. dataset.json stays: without it a folder is not a dataset any more.
std::string cure_of(const fs::path& name) {
    if (name.filename() != description_name) return std::string("remove it, and ") + render_again;
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
                check.errors.push_back(name + ": its bytes differ from SHA256SUMS; " +
                                       cure_of(name));
            if (progress) progress(check.files, tasks.size());
        });
    check.stopped = check.files < tasks.size();
}

}  // namespace

DatasetCheck verify_folder(const fs::path& folder, int threads, const ProgressCallback& progress,
                           const std::atomic<bool>& stop) {
    DatasetCheck check;
    std::vector<Task> tasks;
    if (const auto json = read_variants(folder)) {
        std::set<std::string> expected{variants_name};
        for (const fs::path& variant : folders_of_variants("", *json)) {
            expected.insert(variant.string());
            if (fs::exists(folder / variant / description_name))
                list_tasks(folder, variant.string(), tasks, check);
            else
                check.errors.push_back(variant.string() + ": is missing; " + render_again);
        }
        list_strangers(folder, "", expected, check);
    } else {
        list_tasks(folder, "", tasks, check);
    }
    std::ranges::sort(check.unknown_files);
    on_threads(threads, [&](int n) { check_files(folder, tasks, n, progress, stop, check); });
    return check;
}

}  // namespace sonarsim
