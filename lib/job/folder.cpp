#include "job/folder.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "dataset/description.h"
#include "dataset/ping_metadata.h"
#include "mission/differences.h"
#include "mission/files.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The number at the start of a ping's file name, if the rest of it is `ending`.
std::optional<std::uint32_t> ping_number(std::string_view name, std::string_view ending) {
    if (!name.ends_with(ending)) return std::nullopt;
    name.remove_suffix(ending.size());
    const auto number = parse_unsigned(name);
    if (!number || *number > UINT32_MAX) return std::nullopt;
    return static_cast<std::uint32_t>(*number);
}

/// The files in a folder that are not whole yet.
std::vector<fs::path> temporary_files(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const bool regular = entry.symlink_status().type() == fs::file_type::regular;
        if (regular && is_temporary_name(entry.path().filename().string()))
            found.push_back(entry.path());
    }
    return found;
}

void require_folder(const fs::path& path) {
    if (!fs::is_directory(path)) throw InputError({path.string()}, "is not a folder");
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& what, const char* cure) {
    throw InputError({folder.string()}, what + "; choose another output.folder" + cure);
}

constexpr const char* or_overwrite = ", or replace it with --overwrite";
constexpr const char* or_nothing = "";

Json own_description(const fs::path& folder) {
    if (auto json = read_description(folder)) return *std::move(json);
    refuse(folder, "holds a dataset.json that is not sonarsim's", or_nothing);
}

/// The path without links; what does not exist keeps its name.
fs::path resolved(const fs::path& path) {
    for (;;) {
        std::error_code error;
        fs::path found = fs::weakly_canonical(path, error);
        if (!error) return found;
        // Another run removed a folder of the path between the check and the resolution.
        if (error != std::errc::no_such_file_or_directory)
            throw fs::filesystem_error("cannot resolve", path, error);
    }
}

/// True if the path is the folder or lies below it, links resolved.
bool is_within(const fs::path& path, const fs::path& folder) {
    const fs::path inner = resolved(path);
    const fs::path outer = resolved(folder);
    return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first ==
           outer.end();
}

}  // namespace

bool is_unused(const fs::path& folder) {
    return std::all_of(
        fs::directory_iterator(folder), fs::directory_iterator(),
        [](const auto& entry) { return is_temporary_name(entry.path().filename().string()); });
}

void require_no_link(const fs::path& path, const std::string& what) {
    if (!fs::is_symlink(path)) return;
    throw InputError({path.string()}, "is a symbolic link, and " + what +
                                          " is written into folders of its own; remove the link "
                                          "or choose another output folder");
}

std::string mission_differences(const fs::path& dataset, const std::string& mission) {
    constexpr std::size_t largest_mission = std::size_t{1} << 26;
    try {
        return differing_keys(read_file(dataset / mission_name, largest_mission), mission);
    } catch (const InputError&) {
        return "";  // a run that was killed at its beginning has not written it yet
    }
}

FolderState inspect_folder(const Layout& layout, const Json& description,
                           const std::string& mission) {
    const fs::path& folder = layout.folder;
    if (!fs::exists(folder)) return FolderState::fresh;
    require_folder(folder);
    // Another shard may be starting. It writes dataset.json before anything else, so look for other
    // files first and for dataset.json second.
    const bool unused = is_unused(folder);
    if (!fs::exists(folder / description_name)) {
        if (unused) return FolderState::fresh;
        refuse(folder, "holds files that are no sonarsim dataset", or_nothing);
    }
    const Json found = own_description(folder);
    std::string difference = difference_between(found, description);
    if (difference == of_another_mission) difference += mission_differences(folder, mission);
    if (!difference.empty()) refuse(folder, "holds a dataset " + difference, or_overwrite);
    const DatasetFile dataset = check_description(found, (folder / description_name).string());
    return dataset.complete ? FolderState::complete : FolderState::unfinished;
}

void protect_inputs(const Layout& layout, const Mission& mission) {
    std::vector<fs::path> own = layout.folders();
    for (const fs::path& folder : own)
        require_no_link(folder, "a dataset");
    for (const char* name :
         {description_name, mission_name, trajectory_name, journal_name, checksums_name})
        own.push_back(layout.folder / name);
    for (const fs::path& input : files_of(mission)) {
        if (input.empty()) continue;
        for (const fs::path& path : own) {
            if (!is_within(input, path)) continue;
            throw InputError({layout.folder.string()}, "the dataset would replace '" +
                                                           input.string() +
                                                           "', which the mission reads; choose "
                                                           "another output.folder");
        }
    }
}

void remove_dataset(const Layout& layout, const Mission& mission) {
    const fs::path& folder = layout.folder;
    if (!fs::exists(folder)) return;
    require_folder(folder);
    if (!fs::exists(folder / description_name)) {
        if (is_unused(folder)) return;
        refuse(folder, "holds files that are no sonarsim dataset", or_nothing);
    }
    remove_listed_files(folder, own_description(folder), files_of(mission));
    sync_file_system(folder);
}

void remove_temporary_files(const fs::path& folder) {
    if (!fs::is_directory(folder)) return;
    for (const fs::path& file : temporary_files(folder))
        fs::remove(file);
}

void begin_dataset(const Layout& layout, const CommonFiles& files) {
    fs::create_directories(layout.folder);
    // dataset.json is written first and durably: a run refuses a folder with other files but
    // without it.
    write_file_durably(layout.folder / description_name, json_text(files.description));
    // The sums are valid again only when the dataset is complete.
    fs::remove(layout.folder / checksums_name);
    write_file(layout.folder / mission_name, files.mission);
    write_file(layout.folder / trajectory_name, files.trajectory);
    for (const fs::path& folder : layout.folders())
        fs::create_directories(folder);
    for (const auto& [name, bytes] : files.initial)
        write_file(layout.folder / name, bytes);
}

bool has_common_files(const Layout& layout) {
    std::error_code absent;
    return std::ranges::all_of(std::array{mission_name, trajectory_name, checksums_name},
                               [&](const char* name) {
                                   return fs::symlink_status(layout.folder / name, absent).type() ==
                                          fs::file_type::regular;
                               });
}

void remove_leftovers(const Layout& layout, const std::vector<PingId>& todo, bool alone) {
    if (alone) {
        remove_temporary_files(layout.folder);
        for (const std::string& product : layout.products)
            remove_temporary_files((layout.folder / product).parent_path());
    }
    for (std::uint32_t sensor = 0; sensor < layout.sensors.size(); ++sensor) {
        if (alone) remove_temporary_files(layout.sensor_folder(sensor));
        for (const auto& part : layout.sensors[sensor].per_ping) {
            const auto* kind = std::get_if<PingFile>(&part);
            if (!kind) continue;
            for (const fs::path& file :
                 temporary_files(layout.sensor_folder(sensor) / kind->name)) {
                const std::string name = final_name(file.filename().string());
                const auto pose = ping_number(name, kind->extension);
                if (pose && std::ranges::binary_search(todo, PingId{*pose, sensor}))
                    fs::remove(file);
            }
        }
    }
}

void remove_journal_parts(const Layout& layout) {
    std::error_code ignored;  // another run may be removing them, too
    for (const fs::path& part : journal_parts(layout.folder))
        fs::remove(part, ignored);
    fs::remove(layout.folder / journal_folder_name, ignored);  // stays if it holds other files
}

}  // namespace sonarsim
