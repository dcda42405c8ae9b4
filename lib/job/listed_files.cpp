#include <algorithm>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "dataset/file_names.h"
#include "dataset/layout.h"
#include "job/folder.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Files of pings: "fls/polar/%06d.npy" with the numbers 0, `every`, ...
struct Pattern {
    std::string text;
    std::uint64_t count;
    std::uint64_t every;

    bool has(const std::string& name) const {
        const std::size_t at = text.find('%');
        if (at > name.size() || name.compare(0, at, text, 0, at) != 0) return false;
        const std::size_t end = std::min(name.find_first_not_of("0123456789", at), name.size());
        const auto number = parse_unsigned(std::string_view(name).substr(at, end - at));
        return number && *number % every == 0 && *number / every < count &&
               numbered(text, *number) == name;
    }
};

/// The files that a description lists, relative to the folder of the dataset. A description may
/// claim any number of files, so the files of the folder are looked up in it, and not its files in
/// the folder.
struct ListedFiles {
    std::set<std::string> names;
    std::vector<Pattern> patterns;

    bool has(const std::string& name) const {
        return name != description_name &&
               (names.contains(name) ||
                std::ranges::any_of(patterns, [&](const Pattern& p) { return p.has(name); }));
    }
    /// True if a listed file lies in a folder or below.
    bool is_in(const std::string& inner_folder) const {
        const auto is_below = [&](const std::string& name) {
            return name.starts_with(inner_folder + "/");
        };
        return std::ranges::any_of(names, is_below) ||
               std::ranges::any_of(patterns, is_below, &Pattern::text);
    }
};

void list_sensor(const Json& sensor, ListedFiles& files) {
    const auto pings = sensor.value("pings", std::uint64_t{0});
    const auto every = std::max(std::uint64_t{1}, sensor.value("every", std::uint64_t{1}));
    for (const Json& pattern : sensor.value("files", Json::object()))
        files.patterns.push_back({pattern.get<std::string>(), pings, every});
    const Json records = sensor.value("records", Json::object());
    if (records.contains("file")) files.names.insert(records["file"].get<std::string>());
    for (const Json& label : sensor.value("label_records", Json::object()))
        files.names.insert(label.at("file").get<std::string>());
    for (const Json& product : sensor.value("products", Json::array()))
        files.names.insert(product.get<std::string>());
}

ListedFiles list_files(const fs::path& folder, const Json& description) {
    ListedFiles files{{mission_name, trajectory_name, journal_name, checksums_name}, {}};
    for (const fs::path& part : journal_parts(folder))
        files.names.insert(part.lexically_relative(folder).generic_string());
    try {
        for (const Json& sensor : description.value("sensors", Json::array()))
            list_sensor(sensor, files);
        for (const Json& product : description.value("products", Json::array()))
            files.names.insert(product.get<std::string>());
    } catch (const Json::exception&) {  // NOLINT(bugprone-empty-catch)
        // Somebody edited the description: the files that can be read from it are removed.
    }
    return files;
}

}  // namespace

void remove_listed_files(const fs::path& folder, const Json& description,
                         const std::vector<fs::path>& inputs) {
    const ListedFiles listed = list_files(folder, description);
    std::vector<fs::path> files;
    std::set<fs::path, std::greater<>> folders;  // a folder comes after those in it
    // The iterator does not follow links: everything that it finds lies in the folder.
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
        const fs::path name = entry.path().lexically_relative(folder);
        const fs::file_type type = entry.symlink_status().type();
        const fs::path whole = name.parent_path() / final_name(name.filename().string());
        if (type == fs::file_type::regular && listed.has(whole.generic_string()))
            files.push_back(entry.path());
        if (type == fs::file_type::directory &&
            (name == journal_folder_name || listed.is_in(name.generic_string())))
            folders.insert(entry.path());
    }
    for (const fs::path& file : files) {
        for (const fs::path& input : inputs) {
            std::error_code absent;
            if (!fs::equivalent(file, input, absent)) continue;
            throw InputError({(folder / description_name).string()},
                             "lists '" + input.string() +
                                 "', which the mission reads; choose another output.folder");
        }
    }
    for (const fs::path& file : files)
        fs::remove(file);
    for (const fs::path& inner : folders) {
        if (fs::is_empty(inner)) fs::remove(inner);
    }
    remove_gallery(folder);  // it shows files that are gone
    // dataset.json goes last: it marks the dataset, so that an interrupted removal can be repeated.
    fs::remove(folder / description_name);
}

}  // namespace sonarsim
