#include "job/listed_files.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "dataset/file_names.h"
#include "dataset/gallery_file.h"
#include "dataset/layout.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Relative to the folder of the dataset.
using Files = std::set<fs::path>;

/// Whether every folder between `folder` and a file below it is one, and no link.
bool is_reached_directly(const fs::path& folder, const fs::path& relative) {
    fs::path path = folder;
    for (const fs::path& step : relative.parent_path()) {
        path /= step;
        if (step == ".." || fs::symlink_status(path).type() != fs::file_type::directory)
            return false;
    }
    return relative.is_relative() && !relative.empty();
}

/// The pings of a sensor as its description tells them.
struct Pings {
    std::uint64_t count = 0;
    std::uint64_t every = 1;
};

/// Lists the files of a pattern that are there, whole or not: however many pings a description
/// claims, a folder holds only so many.
void list_pattern(const fs::path& folder, const std::string& pattern, const Pings& pings,
                  Files& files) {
    const fs::path first = numbered(pattern, 0);
    if (pings.count == 0 || !is_reached_directly(folder, first)) return;
    files.insert(first);  // there or not, so that its folder is tidied
    const std::size_t prefix = fs::path(pattern).filename().string().find('%');
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / first.parent_path())) {
        const std::string name = final_name(entry.path().filename().string());
        if (prefix > name.size()) continue;
        const std::size_t end = std::min(name.find_first_not_of("0123456789", prefix), name.size());
        const auto pose = parse_unsigned(std::string_view(name).substr(prefix, end - prefix));
        if (!pose || *pose % pings.every != 0 || *pose / pings.every >= pings.count) continue;
        const fs::path file = first.parent_path() / name;
        if (file == numbered(pattern, *pose)) files.insert(file);
    }
}

void list_sensor(const fs::path& folder, const Json& sensor, Files& files) {
    const Pings pings{sensor.value("pings", std::uint64_t{0}),
                      std::max(std::uint64_t{1}, sensor.value("every", std::uint64_t{1}))};
    const Json patterns = sensor.value("files", Json::object());
    for (const auto& [name, pattern] : patterns.items())
        list_pattern(folder, pattern.get<std::string>(), pings, files);
    if (sensor.contains("packs")) {
        const Json& packs = sensor["packs"];
        const std::uint64_t each =
            std::max(std::uint64_t{1}, packs.value("pings", std::uint64_t{1}));
        list_pattern(folder, packs.at("file").get<std::string>(),
                     {pings.count / each + (pings.count % each != 0 ? 1 : 0), 1}, files);
    }
    const Json records = sensor.value("records", Json::object());
    if (records.contains("file")) files.insert(records["file"].get<std::string>());
    for (const Json& label : sensor.value("label_records", Json::object()))
        files.insert(label.at("file").get<std::string>());
    for (const Json& product : sensor.value("products", Json::array()))
        files.insert(product.get<std::string>());
}

void remove_file(const fs::path& folder, const fs::path& relative) {
    if (!is_reached_directly(folder, relative)) return;
    if (fs::symlink_status(folder / relative).type() == fs::file_type::regular)
        fs::remove(folder / relative);
}

void require_none_of(const std::vector<fs::path>& inputs, const fs::path& folder,
                     const Files& files) {
    for (const fs::path& file : files) {
        if (!is_reached_directly(folder, file)) continue;
        for (const fs::path& input : inputs) {
            std::error_code absent;
            if (!fs::equivalent(folder / file, input, absent)) continue;
            throw InputError({(folder / description_name).string()},
                             "lists '" + input.string() +
                                 "', which the mission reads; choose another output.folder");
        }
    }
}

/// Removes the temporary files of listed ones in a folder of the dataset, and it, if that empties
/// it.
void tidy(const fs::path& folder, const fs::path& relative, const Files& files) {
    const fs::path here = folder / relative;
    if (!is_reached_directly(folder, relative / "x") || !fs::is_directory(here)) return;
    for (const fs::directory_entry& entry : fs::directory_iterator(here)) {
        const std::string name = entry.path().filename().string();
        if (is_temporary_name(name) && files.contains(relative / final_name(name)))
            remove_file(folder, relative / name);
    }
    if (!relative.empty() && fs::is_empty(here)) fs::remove(here);
}

}  // namespace

void remove_listed_files(const fs::path& folder, const Json& description,
                         const std::vector<fs::path>& inputs) {
    Files files{mission_name, trajectory_name, journal_name, checksums_name};
    try {
        for (const Json& sensor : description.value("sensors", Json::array()))
            list_sensor(folder, sensor, files);
        for (const Json& product : description.value("products", Json::array()))
            files.insert(product.get<std::string>());
    } catch (const Json::exception&) {  // NOLINT(bugprone-empty-catch)
        // A description that somebody edited: what can be read of it is removed.
    }
    const fs::path parts = fs::path(journal_folder_name);
    if (is_reached_directly(folder, parts / "x") && fs::is_directory(folder / parts)) {
        for (const fs::directory_entry& part : fs::directory_iterator(folder / parts)) {
            if (is_journal_part(part.path().filename().string()))
                files.insert(parts / part.path().filename());
        }
    }
    require_none_of(inputs, folder, files);
    std::set<fs::path, std::greater<>> folders;  // a folder comes after those in it
    for (const fs::path& file : files) {
        if (!is_reached_directly(folder, file)) continue;
        remove_file(folder, file);
        for (fs::path above = file.parent_path(); !above.empty(); above = above.parent_path())
            folders.insert(above);
    }
    for (const fs::path& inner : folders)
        tidy(folder, inner, files);
    if (has_gallery(folder)) fs::remove(folder / gallery_name);  // it shows what is gone
    tidy(folder, "", files);
    // Last: while it is there, the folder is known as ours and the removal can be run again.
    remove_file(folder, description_name);
}

}  // namespace sonarsim
