#include "job/verify.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

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
#include "dataset/gallery_file.h"
#include "dataset/layout.h"
#include "format/open_file.h"
#include "format/tar.h"
#include "job/checksums.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Shape = std::vector<std::size_t>;

constexpr std::size_t largest_checksums = std::size_t{1} << 32;
/// A description may claim any number of pings; nobody reads more lines than this.
constexpr std::size_t most_faults = 1000;

constexpr const char* render_again =
    "the render command that made the dataset, run again, makes it anew";

void add_fault(DatasetCheck& check, const std::string& fault) {
    check.faults.size() < most_faults ? check.faults.push_back(fault) : void(++check.more_faults);
}

/// A file that is to be looked at.
struct Task {
    DescribedFile file;
    std::string sum;
    std::optional<std::size_t> ids;  ///< that there are, of a file of ids
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

/// What is to be looked at; what is missing is a fault already.
std::vector<Task> list_tasks(const fs::path& folder, const DatasetFile& dataset,
                             const std::map<std::string, std::string>& sums,
                             std::set<std::string>& expected, DatasetCheck& check) {
    std::vector<Task> tasks;
    for_each_described(dataset, [&](const DescribedFile& file) {
        expected.insert(file.name);
        const auto sum = sums.find(file.name);
        if (!fs::is_regular_file(folder / file.name)) {
            add_fault(check, file.name + ": is missing; " + render_again);
        } else if (sum != sums.end()) {
            tasks.push_back({file, sum->second, count_ids(file, dataset)});
        } else if (file.name != checksums_name && !sums.empty()) {
            add_fault(check, file.name +
                                 ": SHA256SUMS does not list it; remove SHA256SUMS, and the render "
                                 "command that made the dataset writes it again");
        }
        return check.more_faults == 0;
    });
    return tasks;
}

/// Of a file that is there and not what it should be. Without dataset.json a folder would not be
/// known as a dataset any more.
std::string cure_of(const std::string& name) {
    if (name != description_name) return std::string("remove it, and ") + render_again;
    return std::string("remove ") + checksums_name + ", and " + render_again;
}

/// What looking at one file gave.
struct Look {
    std::uint64_t bytes = 0;
    std::string fault;
    std::map<std::string, Shape> shapes;  ///< by "sensor/polar": those of one kind have one shape
};

/// Notes the shape of what was opened, and whether it and the ids in it are what they should be.
void note_opened(Look& look, const DescribedFile& file, const std::optional<std::size_t>& ids,
                 const OpenedFile& opened) {
    if (ids && opened.largest && *opened.largest > *ids) {
        look.fault = "has the id " + std::to_string(*opened.largest) + ", and dataset.json names " +
                     std::to_string(*ids);
    }
    if (!file.sensor || file.kind.empty() || file.kind == "records") return;
    const Shape& shape = opened.shape;
    const DescribedArray* const array = array_of(file);
    Shape told = array ? array->shape : Shape{};
    const std::string kind = file.sensor->name + "/" + file.kind;
    const bool is_told = !told.empty();
    if (!is_told) told = look.shapes.try_emplace(kind, shape).first->second;
    if (shape == told || !look.fault.empty()) return;
    look.fault = "is " + shape_text(shape) +
                 (is_told ? ", and dataset.json says " : ", and the others are ") +
                 shape_text(told);
}

/// Opens every file in a pack. They must be those that dataset.json tells, in its order.
void look_into(const fs::path& path, const DescribedFile& pack, const DatasetFile& dataset,
               Look& look) {
    const DescribedSensor& sensor = *pack.sensor;
    const NamedTexts& members = sensor.packs->members;
    const std::uint64_t number = parse_unsigned(path.stem().string()).value_or(0);
    const std::uint64_t first = number * sensor.packs->pings;
    const std::uint64_t end = std::min(first + sensor.packs->pings, sensor.pings);
    std::uint64_t ping = first;
    std::size_t k = 0;  // of the members of a ping
    for_each_in_tar(path, [&](const std::string& name, const std::string& bytes) {
        const bool more = ping < end && k < members.size();
        const std::string expected =
            more ? numbered(members[k].second, ping * sensor.every) : std::string();
        if (name != expected || !more) {
            throw std::runtime_error("holds " + name + " where " +
                                     (more ? expected : std::string("its end")) + " should be");
        }
        const DescribedFile file{name, pack.sensor, members[k].first};
        const bool sound = look.fault.empty();
        note_opened(look, file, count_ids(file, dataset), open_bytes(name, bytes));
        if (sound && !look.fault.empty()) look.fault = name + " in it " + look.fault;
        if (++k < members.size()) return;
        k = 0;
        ++ping;
    });
    if (ping < end) throw std::runtime_error("lacks pings from its end");
}

Look look_at(const fs::path& folder, const Task& task, const DatasetFile& dataset) {
    const fs::path path = folder / task.file.name;
    Look look;
    look.bytes = fs::file_size(path);
    try {
        if (task.file.kind == "packs")
            look_into(path, task.file, dataset, look);
        else
            note_opened(look, task.file, task.ids, open_file(path));
    } catch (const std::system_error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        look.fault = std::string("does not open: ") + error.what();
    }
    if (sha256_of_file(path) != task.sum) {
        look.fault = "its bytes are not those that SHA256SUMS tells" +
                     (look.fault.empty() ? "" : ", and it " + look.fault);
    }
    return look;
}

void look_at_all(const fs::path& folder, const DatasetFile& dataset, const std::vector<Task>& tasks,
                 int threads, const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                 const std::atomic<bool>& stop, DatasetCheck& check) {
    std::map<std::string, Shape> shapes;  // of the first file of each kind
    ordered_pipeline(
        tasks.size(), 4 * static_cast<std::size_t>(threads), stop,
        [&](std::size_t i) { return look_at(folder, tasks[i], dataset); },
        [&](const Look& look) {
            const std::string& name = tasks[check.files++].file.name;
            check.bytes += look.bytes;
            std::string fault = look.fault;
            for (const auto& [kind, shape] : look.shapes) {
                const Shape& first = shapes.try_emplace(kind, shape).first->second;
                if (fault.empty() && shape != first)
                    fault = "is " + shape_text(shape) + ", and the others are " + shape_text(first);
            }
            if (!fault.empty()) add_fault(check, name + ": " + fault + "; " + cure_of(name));
            if (progress) progress(check.files, tasks.size());
        });
    check.stopped = check.files < tasks.size();
}

/// No link is followed: what it leads to is not in the folder.
std::vector<std::string> strangers_in(const fs::path& folder,
                                      const std::set<std::string>& expected) {
    std::vector<std::string> strangers;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        std::string name = entry.path().lexically_relative(folder).string();
        const bool is_folder = entry.symlink_status().type() == fs::file_type::directory;
        if (!is_folder && !expected.contains(name)) strangers.push_back(std::move(name));
    }
    std::ranges::sort(strangers);
    return strangers;
}

}  // namespace

DatasetCheck verify_dataset(const fs::path& folder, int threads,
                            const std::function<void(std::uint64_t, std::uint64_t)>& progress,
                            const std::atomic<bool>& stop) {
    const DatasetFile dataset = require_dataset(folder);
    DatasetCheck check;
    if (!dataset.complete) {
        add_fault(check, std::string(description_name) +
                             ": the dataset is not complete; the render command that made it, run "
                             "again, goes on with it");
    }
    std::map<std::string, std::string> sums;
    const fs::path sums_file = folder / checksums_name;
    if (fs::is_regular_file(sums_file))
        sums = parse_checksums(read_file(sums_file, largest_checksums), sums_file.string());
    std::set<std::string> expected;
    const std::vector<Task> tasks = list_tasks(folder, dataset, sums, expected, check);
    if (check.more_faults == 0) {
        for (const auto& [name, sum] : sums) {
            if (!expected.contains(name)) {
                add_fault(check, name +
                                     ": SHA256SUMS lists it, and dataset.json does not; one of "
                                     "them was changed: render the dataset anew (--overwrite)");
            }
        }
        if (has_gallery(folder)) expected.insert(gallery_name);
        check.strangers = strangers_in(folder, expected);
    }
    if (threads <= 0) threads = tbb::info::default_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(threads);
    arena.execute([&] { look_at_all(folder, dataset, tasks, threads, progress, stop, check); });
    return check;
}

}  // namespace sonarsim
