#include "output/dataset/dataset_file.h"

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "input/mission/dataset_names.h"
#include "input/trajectory/trajectory.h"
#include "output/dataset/metadata.h"

namespace sonarsim {

namespace {

constexpr const char* cure = "; copy the dataset again, or render it again";

/// InputError with what is wrong with a dataset.json.
[[noreturn]] void refuse_description(const std::string& file, const std::string& what) {
    throw InputError({file}, what + cure);
}

/// True if the text is one or more plain names with '/' between them.
bool is_inner_path(std::string_view text) {
    constexpr std::size_t longest = 1024;  // more than enough for three names
    const std::size_t end = text.find('/');
    return text.size() <= longest && is_plain_name(text.substr(0, end)) &&
           (end == std::string_view::npos || is_inner_path(text.substr(end + 1)));
}

/// True if the text has "%06d", with any digit in place of the 6, once.
bool has_number(const std::string& text) {
    const std::size_t at = text.find('%');
    return at != std::string::npos && text.size() >= at + 4 && text[at + 1] == '0' &&
           text[at + 2] >= '1' && text[at + 2] <= '9' && text[at + 3] == 'd';
}

std::string path_in(const Json& value, const std::string& folder, const std::string& file) {
    auto path = value.get<std::string>();
    if (!path.starts_with(folder + "/") || !is_inner_path(path))
        refuse_description(
            file, "has '" + path + "', which is not the path of a file in '" + folder + "/'");
    return path;
}

std::string pattern_in(const Json& value, const std::string& folder, const std::string& file) {
    auto pattern = value.get<std::string>();
    if (!has_number(pattern))
        refuse_description(file, "has '" + pattern + "' without a number as '%06d'");
    path_in(numbered(pattern, 0), folder, file);
    return pattern;
}

/// A number of things. JSON may hold one that no integer does.
std::uint64_t count_in(const Json& value, const std::string& file) {
    if (!value.is_number_integer() || value < 0)
        refuse_description(file, "has " + value.dump() + " in place of a whole number");
    return value.get<std::uint64_t>();
}

DescribedSensor read_sensor(const Json& json, std::uint64_t poses, const std::string& file) {
    DescribedSensor sensor;
    sensor.name = json.at("name").get<std::string>();
    if (!is_plain_name(sensor.name))
        refuse_description(file,
                           "has a sensor '" + sensor.name + "', which is not the name of a folder");
    sensor.every = static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(count_in(json.at("every"), file), 1, UINT32_MAX));
    sensor.pings = count_in(json.at("pings"), file);
    if (sensor.pings != (poses + sensor.every - 1) / sensor.every)
        refuse_description(file,
                           "has another number of pings of '" + sensor.name + "' than of poses");
    for (const Json& pattern : json.at("files"))
        sensor.files.push_back(pattern_in(pattern, sensor.name, file));
    if (json.contains("records"))
        sensor.records.push_back(path_in(json["records"].at("file"), sensor.name, file));
    for (const Json& label : json.value("label_records", Json::object()))
        sensor.records.push_back(path_in(label.at("file"), sensor.name, file));
    for (const Json& product : json.value("products", Json::array()))
        sensor.products.push_back(path_in(product, sensor.name, file));
    return sensor;
}

/// " (mesh.glb, path.csv)": the input files whose content differs; "" if none is listed.
std::string changed_inputs(const Json& found, const Json& expected) {
    const Json before = found.value("inputs", Json::array());
    std::string names;
    for (const Json& input : expected.value("inputs", Json::array())) {
        if (std::ranges::find(before, input) != before.end()) continue;
        names += (names.empty() ? " (" : ", ") + printable(input.value("file", ""));
    }
    return names.empty() ? "" : names + ")";
}

/// The properties of a dataset's build that its bytes depend on.
std::string bytes_of_build(const Json& description) {
    const Json build = description.value("build", Json());
    std::string text;
    for (const char* key : {"arithmetic", "png_encoder"}) {
        const bool known = build.is_object() && build.contains(key) && build[key].is_string();
        text += (text.empty() ? "" : ", ") + (known ? build[key].get<std::string>() : "unknown");
    }
    return text;
}

}  // namespace

Json read_json(const std::filesystem::path& path) {
    constexpr std::size_t largest = std::size_t{1} << 28;
    constexpr int deepest = 64;
    const std::string text = read_file(path, largest);
    if (is_nested_deeper(text, deepest))
        refuse_description(path.string(), "is nested more than 64 deep");
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) refuse_description(path.string(), "is not JSON");
    return json;
}

std::optional<Json> read_description(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / description_name;
    if (!std::filesystem::is_regular_file(file)) read_file(file, 0);  // says what it is
    try {
        Json json = read_json(file);
        if (json.is_object() && json.value("format", Json()) == dataset_format) return json;
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): not ours
    }
    return std::nullopt;
}

DatasetFile parse_description(Json json, const std::string& file) try {
    const Json version = json.at("format_version");
    if (version != dataset_format_version) {
        throw InputError({file}, "has format_version " + version.dump() +
                                     ", and this program knows " +
                                     std::to_string(dataset_format_version) +
                                     "; use the version that made the dataset");
    }
    DatasetFile dataset;
    dataset.complete = json.at("complete").get<bool>();
    dataset.mission = json.at("mission").get<std::string>();
    dataset.poses = count_in(json.at("poses"), file);
    if (dataset.poses > max_poses) refuse_description(file, "has more than ten million poses");
    for (const Json& sensor : json.at("sensors"))
        dataset.sensors.push_back(read_sensor(sensor, dataset.poses, file));
    for (const Json& product : json.value("products", Json::array())) {
        const bool fits = product == navigation_name;
        dataset.products.push_back(fits ? navigation_name
                                        : path_in(product, seabed_folder_name, file));
    }
    dataset.json = std::move(json);
    return dataset;
} catch (const Json::exception& fault) {
    const std::string what = fault.what();  // "[json.exception.type_error.302] type must be ..."
    refuse_description(file,
                       "is damaged: " + what.substr(std::min(what.size(), what.find("] ") + 2)));
}

DatasetFile require_dataset(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / description_name;
    if (!std::filesystem::is_regular_file(file)) {
        const auto above = std::filesystem::absolute(folder / "..").lexically_normal();
        throw InputError(
            {folder.string()},
            !std::filesystem::exists(folder)
                ? "is not a dataset: there is no such folder; give the output folder of a render"
            : std::filesystem::is_regular_file(above / description_name)
                ? "is not a dataset, but a folder of one; give the folder above"
                : "is not a dataset: it has no dataset.json; give the output folder of a render");
    }
    std::optional<Json> json = read_description(folder);
    if (!json) {
        throw InputError({file.string()},
                         "is not sonarsim's, or damaged; give the output folder of a render");
    }
    return parse_description(*std::move(json), file.string());
}

std::string difference_between(const Json& found, const Json& expected) {
    const auto differs = [&](const char* key) {
        return found.value(key, Json()) != expected.value(key, Json());
    };
    if (differs("mission_hash")) return another_mission;
    if (differs("inputs_hash"))
        return "of this mission made from other scene, material or trajectory files" +
               changed_inputs(found, expected);
    if (differs("program_version") || differs("format_version"))
        return "of this mission made by another version of sonarsim";
    const std::string theirs = bytes_of_build(found);
    const std::string ours = bytes_of_build(expected);
    if (theirs == ours) return {};
    return "of this mission made by a build of sonarsim whose bytes differ (" + theirs +
           "; this one: " + ours + ")";
}

std::string numbered(const std::string& pattern, std::uint64_t number) {
    const std::size_t at = pattern.find('%');
    const int digits = pattern.at(at + 2) - '0';
    return std::string(pattern).replace(at, 4, fmt::format("{:0{}}", number, digits));
}

std::vector<std::string> list_files(const DatasetFile& dataset) {
    std::vector<std::string> names{description_name, mission_name, trajectory_name, journal_name};
    const auto add = [&](const std::vector<std::string>& more) {
        names.insert(names.end(), more.begin(), more.end());
    };
    for (const DescribedSensor& sensor : dataset.sensors) {
        for (const std::string& pattern : sensor.files) {
            for (std::uint64_t ping = 0; ping < sensor.pings; ++ping)
                names.push_back(numbered(pattern, ping * sensor.every));
        }
        add(sensor.records);
        add(sensor.products);
    }
    add(dataset.products);
    return names;
}

bool has_sums(const std::filesystem::path& folder, const DatasetFile& dataset) {
    constexpr std::uint64_t shortest_line = 68;  // a sum, two blanks, a letter and the line's end
    std::uint64_t files = 0;
    for (const DescribedSensor& sensor : dataset.sensors)
        files += sensor.files.size() * sensor.pings;
    const std::filesystem::path sums = folder / checksums_name;
    return std::filesystem::is_regular_file(sums) &&
           files <= std::filesystem::file_size(sums) / shortest_line;
}

std::vector<std::string> list_files(const std::filesystem::path& folder,
                                    const DatasetFile& dataset) {
    if (has_sums(folder, dataset)) return list_files(dataset);
    refuse_description((folder / description_name).string(),
                       "lists more files than SHA256SUMS, which is missing or too short");
}

std::uint64_t count_pings(const DatasetFile& dataset) {
    std::uint64_t pings = 0;
    for (const DescribedSensor& sensor : dataset.sensors)
        pings += sensor.pings;
    return pings;
}

bool is_plain_name(std::string_view text) {
    constexpr std::string_view allowed =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.";
    return !text.empty() && text.front() != '.' &&
           text.find_first_not_of(allowed) == std::string_view::npos;
}

}  // namespace sonarsim
