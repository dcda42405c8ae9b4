#include "run/job/folder.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "input/mission/files.h"
#include "input/mission/resolved.h"
#include "input/trajectory/trajectory.h"
#include "output/dataset/metadata.h"
#include "output/dataset/seabed_files.h"
#include "run/job/shard_lock.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
constexpr const char* or_overwrite = ", or replace it with --overwrite";

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& what,
                                const char* cure = "") {
    throw InputError({folder.string()}, what + "; choose another output.folder" + cure);
}

bool is_temporary(const fs::directory_entry& entry) {
    return entry.symlink_status().type() == fs::file_type::regular &&
           is_temporary_name(entry.path().filename().string());
}

/// The names of the files and folders of a dataset in its folder, without dataset.json and the
/// journal's folder. They may come from a dataset.json that somebody has edited.
std::set<std::string> own_names(const Json& description) {
    std::set<std::string> names{mission_name, trajectory_name, journal_name, checksums_name};
    const auto add = [&](const Json& path) {
        const std::string text = path.is_string() ? path.get<std::string>() : "";
        const std::string name = text.substr(0, text.find('/'));
        if (is_plain_name(name)) names.insert(name);
    };
    for (const Json& sensor : description.value("sensors", Json()))
        add(sensor.is_object() ? sensor.value("name", Json()) : Json());
    for (const Json& product : description.value("products", Json()))
        add(product);
    return names;
}

/// InputError when an input of the mission is one of the names in `folder`, or lies below it.
void spare_inputs(const fs::path& folder, const std::set<std::string>& names,
                  const Mission& mission) {
    const fs::path home = fs::weakly_canonical(folder);
    for (const fs::path& input : files_of(mission)) {
        const fs::path relative = fs::weakly_canonical(input).lexically_relative(home);
        if (relative.empty() || !names.contains(relative.begin()->string())) continue;
        refuse_folder(
            folder, "the dataset would replace '" + input.string() + "', which the mission reads");
    }
}

Json own_description(const fs::path& folder) {
    if (auto json = read_description(folder)) return *std::move(json);
    refuse_folder(folder, "holds a dataset.json that is not sonarsim's");
}

/// The temporary files in a folder, with its inner folders where `Iterator` enters them.
template <class Iterator>
std::vector<fs::path> temporary_files(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code absent;
    for (const fs::directory_entry& entry : Iterator(folder, absent)) {
        if (is_temporary(entry)) found.push_back(entry.path());
    }
    return found;
}

/// The temporary files in the folder of a dataset and in the folders that are its own.
std::vector<fs::path> leftovers(const fs::path& folder, const Json& description) {
    std::vector<fs::path> found = temporary_files<fs::directory_iterator>(folder);
    if (description.empty()) return found;
    for (const std::string& name : own_names(description)) {
        if (fs::is_symlink(folder / name)) continue;
        const auto inner = temporary_files<fs::recursive_directory_iterator>(folder / name);
        found.insert(found.end(), inner.begin(), inner.end());
    }
    return found;
}

}  // namespace

void remove_leftovers(const fs::path& folder, const Json& description) {
    for (const fs::path& file : leftovers(folder, description))
        fs::remove(file);
}

void tidy(const fs::path& folder, const Json& description) {
    remove_journal_parts(folder);
    const std::vector<fs::path> found = leftovers(folder, description);
    if (found.empty()) return;
    try {
        const ShardLock lock(folder, 0, 1);
        for (const fs::path& file : found)
            fs::remove(file);
    } catch (const std::runtime_error&) {  // NOLINT(bugprone-empty-catch): they do no harm
    }
}

std::string read_mission_text(const fs::path& dataset) {
    constexpr std::size_t largest = std::size_t{1} << 26;
    return read_file(dataset / mission_name, largest);
}

std::string mission_differences(const fs::path& dataset, const std::string& mission) {
    try {
        return differing_keys(read_mission_text(dataset), mission);
    } catch (const InputError&) {
        return "";  // a run that was killed at its beginning has not written it yet
    }
}

DatasetFile require_part(const fs::path& folder, const fs::path& first) {
    DatasetFile dataset = require_dataset(folder);
    std::string difference = difference_between(dataset.json, require_dataset(first).json);
    if (difference.empty()) return dataset;
    if (difference == another_mission)
        difference += mission_differences(folder, read_mission_text(first));
    throw InputError({folder.string()}, "holds a dataset " + difference + ", seen from " +
                                            first.string() +
                                            "; only parts of one mission become one dataset");
}

CommonFiles make_common_files(const Mission& mission, const Assembly& assembly,
                              const Layout& layout) {
    CommonFiles files{describe_dataset(mission, assembly, layout),
                      resolved_text(mission, assembly)};
    if (assembly.seabed) files.others = seabed_files(*assembly.seabed);
    files.others.emplace_back(trajectory_name, write_tum(assembly.trajectory));
    if (!assembly.reported.empty())
        files.others.emplace_back(navigation_name, write_tum(assembly.reported));
    return files;
}

double bytes_of(const CommonFiles& files) {
    std::size_t bytes = json_text(files.description).size() + files.mission.size();
    for (const auto& [name, content] : files.others)
        bytes += content.size();
    return static_cast<double>(bytes);
}

bool is_unused(const fs::path& folder) {
    return std::all_of(
        fs::directory_iterator(folder), fs::directory_iterator(), [](const auto& entry) {
            return is_temporary(entry) || entry.path().filename() == journal_folder_name;
        });
}

FolderState inspect_folder(const fs::path& folder, const Json& description,
                           const std::string& mission, bool overwrite) {
    if (!fs::exists(folder)) return FolderState::fresh;
    if (!fs::is_directory(folder)) throw InputError({folder.string()}, "is not a folder");
    // Another shard may be starting, which writes dataset.json first: look for it last.
    const bool unused = is_unused(folder);
    if (!fs::exists(folder / description_name)) {
        if (unused) return FolderState::fresh;
        refuse_folder(folder, "holds files that are not a sonarsim dataset");
    }
    const Json found = own_description(folder);
    if (overwrite) return FolderState::fresh;
    std::string difference = difference_between(found, description);
    if (difference == another_mission) difference += mission_differences(folder, mission);
    if (difference.empty() && found.contains("variant") && !description.contains("variant"))
        difference = "that is a variant of a mission; render that mission to resume it";
    if (!difference.empty()) refuse_folder(folder, "holds a dataset " + difference, or_overwrite);
    return found.value("complete", Json()) == true ? FolderState::complete
                                                   : FolderState::unfinished;
}

void protect_inputs(const Layout& layout, const Mission& mission) {
    std::set<std::string> own{description_name, mission_name, trajectory_name, journal_name,
                              checksums_name};
    for (const fs::path& folder : layout.folders()) {
        require_no_link(folder, "a dataset");
        own.insert(folder.lexically_relative(layout.folder).begin()->string());
    }
    own.insert(layout.products.begin(), layout.products.end());
    spare_inputs(layout.folder, own, mission);
}

void remove_dataset(const fs::path& folder, const Mission& mission) {
    remove_leftovers(folder);
    if (!fs::exists(folder / description_name)) return;
    std::set<std::string> own = own_names(own_description(folder));
    spare_inputs(folder, own, mission);
    for (const fs::path& part : journal_parts(folder))
        part.filename() == journal_part(1, 1) ? fs::resize_file(part, 0) : void(fs::remove(part));
    for (const std::string& name : own)
        fs::remove_all(folder / name);
    sync_file_system(folder);
    // dataset.json goes last: it marks the dataset, so that an interrupted removal can be repeated.
    fs::remove(folder / description_name);
    sync_file_system(folder);
}

bool has_files(const fs::path& folder, const DatasetFile& dataset) {
    const auto is_there = [&](const std::string& name) {
        std::error_code absent;
        return fs::symlink_status(folder / name, absent).type() == fs::file_type::regular;
    };
    return is_there(checksums_name) && has_sums(folder, dataset) &&
           std::ranges::all_of(list_files(dataset), is_there);
}

bool create_once(const fs::path& path, const std::string& text) {
    AtomicFile temporary(path);
    write_file_durably(temporary.part(), text);
    if (::link(temporary.part().c_str(), path.c_str()) != 0) {
        const bool no_links = errno == EPERM || errno == ENOTSUP || errno == ENOSYS;
        if (!no_links && errno != EEXIST) throw_errno("cannot write", path);
        if (fs::exists(path)) return false;
        temporary.commit();  // a disk without links cannot tell which of two runs came first
    }
    sync_file_system(path.parent_path());
    return true;
}

FolderState claim_folder(const fs::path& folder, const CommonFiles& files) {
    if (create_once(folder / description_name, json_text(files.description)))
        return FolderState::fresh;
    return inspect_folder(folder, files.description, files.mission);
}

void write_common_files(const Layout& layout, const CommonFiles& files) {
    write_file(layout.folder / mission_name, files.mission);
    for (const fs::path& folder : layout.folders())
        fs::create_directories(folder);
    for (const auto& [name, bytes] : files.others)
        write_file(layout.folder / name, bytes);
}

}  // namespace sonarsim
