#include "dataset/folder.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "dataset/metadata.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* description_name = "dataset.json";
constexpr const char* mission_name = "mission.resolved.yaml";
constexpr const char* trajectory_name = "trajectory.tum";
constexpr std::size_t largest_description = std::size_t{1} << 28;

/// The number at the start of a ping's file name, when the rest of it is `ending`.
std::optional<std::uint64_t> ping_number(std::string_view name, std::string_view ending) {
    if (!name.ends_with(ending)) return std::nullopt;
    name.remove_suffix(ending.size());
    const bool digits = std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
    return digits && name.size() >= 6 ? parse_unsigned(name) : std::nullopt;
}

/// Whether the file bears the name that `write_file` gives to files that are not whole yet.
bool is_temporary(std::string_view name) {
    return name.starts_with('.') && name.ends_with(".part");
}

/// The name that a file gets or was to get: ".000007.npy.123.part" gives "000007.npy".
std::string final_name(const fs::path& file) {
    const std::string name = file.filename().string();
    if (!is_temporary(name)) return name;
    const fs::path without_mark = fs::path(name.substr(1)).stem();  // of ".part"
    return without_mark.stem().string();                            // of the process
}

/// The files in a folder that are not whole yet.
std::vector<fs::path> temporary_files(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (is_temporary(entry.path().filename().string())) found.push_back(entry.path());
    }
    return found;
}

/// Removes the files of a sensor that hold all of its pings, whichever kind of sonar it is.
void remove_series(const fs::path& sensor) {
    for (const fs::directory_entry& file : fs::directory_iterator(sensor)) {
        const std::string name = final_name(file);
        for (const SonarKind kind :
             {SonarKind::profiling, SonarKind::sidescan, SonarKind::echosounder}) {
            const SeriesFiles& series = series_files(kind);
            const bool ours = name == series.record ||
                              std::ranges::find(series.products, name) != series.products.end();
            if (ours && file.is_regular_file()) fs::remove(file);
        }
    }
}

void require_folder(const fs::path& path) {
    if (!fs::is_directory(path)) throw InputError({path.string()}, "is not a folder");
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& what) {
    throw InputError({folder.string()},
                     what + "; choose another output.folder, or replace it with --overwrite");
}

Json read_description(const fs::path& folder) {
    try {
        const Json json = Json::parse(read_file(folder / description_name, largest_description));
        if (json.is_object() && json.value("format", "") == dataset_format) return json;
    } catch (const Json::exception&) {
    }
    refuse(folder, "holds a dataset.json that is not sonarsim's");
}

}  // namespace

FolderState inspect_folder(const Layout& layout, const Json& description) {
    const fs::path& folder = layout.folder;
    if (!fs::exists(folder)) return FolderState::fresh;
    require_folder(folder);
    // Another shard may be starting. It writes dataset.json before anything else, so whoever finds
    // something and only then looks for dataset.json sees it.
    const bool empty = std::all_of(
        fs::directory_iterator(folder), fs::directory_iterator(),
        [](const auto& entry) { return is_temporary(entry.path().filename().string()); });
    if (!fs::exists(folder / description_name)) {
        if (empty) return FolderState::fresh;
        refuse(folder, "holds files that are no sonarsim dataset");
    }
    const Json found = read_description(folder);
    const auto differs = [&](const char* key) {
        return found.value(key, Json()) != description[key];
    };
    if (differs("mission_hash")) refuse(folder, "holds the dataset of another mission");
    if (differs("inputs_hash")) {
        refuse(folder,
               "holds a dataset of this mission made from other scene, material or "
               "trajectory files");
    }
    if (differs("program_version") || differs("format_version")) {
        refuse(folder, "holds a dataset of this mission made by another version of sonarsim");
    }
    return found.value("complete", Json()) == true ? FolderState::complete
                                                   : FolderState::unfinished;
}

void remove_dataset(const fs::path& folder) {
    if (!fs::exists(folder)) return;
    require_folder(folder);
    for (const fs::directory_entry& sensor : fs::directory_iterator(folder)) {
        if (!sensor.is_directory()) continue;
        for (const FileKind kind : file_kinds) {
            const fs::path files = sensor.path() / name_of(kind);
            if (!fs::is_directory(files)) continue;
            for (const fs::directory_entry& file : fs::directory_iterator(files)) {
                if (ping_number(final_name(file), extension_of(kind))) fs::remove(file);
            }
            if (fs::is_empty(files)) fs::remove(files);
        }
        remove_series(sensor.path());
        if (fs::is_empty(sensor)) fs::remove(sensor);
    }
    for (const char* name : {trajectory_name, mission_name, description_name}) {
        fs::remove(folder / name);
    }
}

void begin_dataset(const Layout& layout, const CommonFiles& files) {
    fs::create_directories(layout.folder);
    write_file(layout.folder / description_name, json_text(files.description));
    write_file(layout.folder / mission_name, files.mission);
    write_file(layout.folder / trajectory_name, files.trajectory);
    for (std::size_t sensor = 0; sensor < layout.sensors.size(); ++sensor) {
        for (const FileKind kind : layout.sensors[sensor].kinds) {
            fs::create_directories(layout.kind_folder(sensor, kind));
        }
    }
}

void remove_leftovers(const Layout& layout, const std::vector<PingId>& todo, bool alone) {
    for (const fs::path& file : temporary_files(layout.folder)) {
        if (alone) fs::remove(file);
    }
    for (std::uint32_t sensor = 0; sensor < layout.sensors.size(); ++sensor) {
        for (const fs::path& file : temporary_files(layout.series_file(sensor, ""))) {
            if (alone) fs::remove(file);
        }
        for (const FileKind kind : layout.sensors[sensor].kinds) {
            for (const fs::path& file : temporary_files(layout.kind_folder(sensor, kind))) {
                const auto pose = ping_number(final_name(file), extension_of(kind));
                if (!pose || *pose > UINT32_MAX) continue;
                const PingId ping{static_cast<std::uint32_t>(*pose), sensor};
                if (std::ranges::binary_search(todo, ping)) fs::remove(file);
            }
        }
    }
}

void finish_dataset(const Layout& layout, const Json& description) {
    Json finished = description;
    finished["complete"] = true;
    write_file(layout.folder / description_name, json_text(finished));
}

}  // namespace sonarsim
