#include "job/verify.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "core/error.h"
#include "core/file.h"
#include "core/ordered_pipeline.h"
#include "core/sha256.h"
#include "core/text.h"
#include "dataset/description.h"
#include "dataset/file_names.h"
#include "dataset/layout.h"
#include "format/open_file.h"
#include "format/tar.h"
#include "job/checksums.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Shape = std::vector<std::size_t>;

/// A description may claim any number of pings, and each missing file is an error.
constexpr std::size_t most_errors = 1000;

constexpr const char* render_again =
    "the render command that made the dataset, run again, makes it anew";

void add_error(DatasetCheck& check, const std::string& error) {
    check.errors.size() < most_errors ? check.errors.push_back(error) : void(++check.more_errors);
}

/// A file to be checked.
struct Task {
    DescribedFile file;
    std::string sum;
    std::optional<std::size_t> ids;  ///< the largest id that a file of ids may hold
};

/// The description of a file's rows, columns and ids in dataset.json; null if it has none.
const DescribedArray* array_of(const DescribedFile& file) {
    if (!file.sensor) return nullptr;
    const auto found = std::ranges::find(file.sensor->arrays, file.kind, &DescribedArray::kind);
    return found == file.sensor->arrays.end() ? nullptr : &*found;
}

/// The number of ids that dataset.json lists for the values of a file; nothing if they are no ids.
std::optional<std::size_t> count_ids(const DescribedFile& file, const DatasetFile& dataset) {
    const DescribedArray* const array = array_of(file);
    const DescribedLabels& labels = dataset.labels;
    if (!array || array->ids.empty()) return std::nullopt;
    if (array->ids == "instances") return labels.instances.size();
    return array->ids == "classes" ? labels.classes.size() : labels.materials.size();
}

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
            tasks.push_back({file, sum->second, count_ids(file, dataset)});
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

/// The result of checking one file.
struct FileCheck {
    std::uint64_t bytes = 0;
    std::string error;
    std::map<std::string, Shape> shapes;  ///< key "sensor/polar": files of a kind have one shape
};

/// Stores the shape of a file, and an error if its shape or its ids differ from dataset.json.
void note_opened(FileCheck& result, const DescribedFile& file,
                 const std::optional<std::size_t>& ids, const OpenedFile& opened) {
    if (ids && opened.largest && *opened.largest > *ids) {
        result.error = "has the id " + std::to_string(*opened.largest) +
                       ", and dataset.json names " + std::to_string(*ids);
    }
    if (!file.sensor || file.kind.empty() || file.kind == "records") return;
    const Shape& shape = opened.shape;
    if (shape.empty()) return;  // a JPEG, a WebP or a text
    const DescribedArray* const array = array_of(file);
    Shape expected = array ? array->shape : Shape{};
    const std::string kind = file.sensor->name + "/" + file.kind;
    const bool declared = !expected.empty();
    if (!declared) expected = result.shapes.try_emplace(kind, shape).first->second;
    if (shape == expected || !result.error.empty()) return;
    result.error = "is " + shape_text(shape) +
                   (declared ? ", and dataset.json says " : ", and the others are ") +
                   shape_text(expected);
}

/// Opens every file in a pack. They must be those of dataset.json, in its order.
void check_pack(const fs::path& path, const DescribedFile& pack, const DatasetFile& dataset,
                FileCheck& result) {
    const DescribedSensor& sensor = *pack.sensor;
    const NamedTexts& members = sensor.packs->members;
    const std::uint64_t number = parse_unsigned(path.stem().string()).value_or(0);
    const std::uint64_t first = number * sensor.packs->pings;
    const std::uint64_t end = std::min(first + sensor.packs->pings, sensor.pings);
    std::uint64_t ping = first;
    std::size_t k = 0;  // index of a member of the ping
    for_each_in_tar(path, [&](const std::string& name, const std::string& bytes) {
        const bool more = ping < end && k < members.size();
        const std::string expected =
            more ? numbered(members[k].second, ping * sensor.every) : std::string();
        if (name != expected || !more) {
            throw std::runtime_error("holds " + name + " where " +
                                     (more ? expected : std::string("its end")) + " should be");
        }
        const DescribedFile file{name, pack.sensor, members[k].first};
        const bool had_no_error = result.error.empty();
        note_opened(result, file, count_ids(file, dataset), open_bytes(name, bytes));
        if (had_no_error && !result.error.empty()) result.error = name + " in it " + result.error;
        if (++k < members.size()) return;
        k = 0;
        ++ping;
    });
    if (ping < end) throw std::runtime_error("lacks pings from its end");
}

FileCheck check_file(const fs::path& folder, const Task& task, const DatasetFile& dataset) {
    const fs::path path = folder / task.file.name;
    FileCheck result;
    result.bytes = fs::file_size(path);
    try {
        if (task.file.kind == "packs")
            check_pack(path, task.file, dataset, result);
        else
            note_opened(result, task.file, task.ids, open_file(path));
    } catch (const std::system_error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        result.error = std::string("does not open: ") + error.what();
    }
    if (sha256_of_file(path) != task.sum) {
        result.error = "its bytes differ from SHA256SUMS" +
                       (result.error.empty() ? "" : ", and it " + result.error);
    }
    return result;
}

void check_files(const fs::path& folder, const DatasetFile& dataset, const std::vector<Task>& tasks,
                 int threads, const ProgressCallback& progress, const std::atomic<bool>& stop,
                 DatasetCheck& check) {
    std::map<std::string, Shape> shapes;  // the first file of each kind
    ordered_pipeline(
        tasks.size(), 4 * static_cast<std::size_t>(threads), stop,
        [&](std::size_t i) { return check_file(folder, tasks[i], dataset); },
        [&](const FileCheck& result) {
            const std::string& name = tasks[check.files++].file.name;
            check.bytes += result.bytes;
            std::string error = result.error;
            for (const auto& [kind, shape] : result.shapes) {
                const Shape& first = shapes.try_emplace(kind, shape).first->second;
                if (error.empty() && shape != first)
                    error = "is " + shape_text(shape) + ", and the others are " + shape_text(first);
            }
            if (!error.empty()) add_error(check, name + ": " + error + "; " + cure_of(name));
            if (progress) progress(check.files, tasks.size());
        });
    check.stopped = check.files < tasks.size();
}

/// Files that dataset.json does not list. Links are not followed: they lead out of the folder.
std::vector<std::string> unknown_files_in(const fs::path& folder,
                                          const std::set<std::string>& expected) {
    std::vector<std::string> unknown;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        std::string name = entry.path().lexically_relative(folder).string();
        const bool is_folder = entry.symlink_status().type() == fs::file_type::directory;
        if (!is_folder && !expected.contains(name)) unknown.push_back(std::move(name));
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
    on_threads(threads,
               [&](int n) { check_files(folder, dataset, tasks, n, progress, stop, check); });
    return check;
}

}  // namespace sonarsim
