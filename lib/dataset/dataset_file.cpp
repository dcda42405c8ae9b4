#include "dataset/dataset_file.h"

#include <limits>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "dataset/checked_json.h"
#include "dataset/file_names.h"
#include "dataset/layout.h"
#include "dataset/metadata.h"
#include "mission/dataset_names.h"
#include "mission/schema.h"
#include "trajectory/interpolate.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_description = std::size_t{1} << 28;
constexpr auto replace_bytes = Json::error_handler_t::replace;  ///< bytes that are no text
constexpr std::uint64_t any_count = std::numeric_limits<std::uint32_t>::max();

std::string plain_name(const CheckedJson& value) {
    std::string name = value.text();
    if (!is_plain_name(name)) value.refuse("a name of letters, digits, '_', '-' and '.'");
    return name;
}

/// The path of a file, or with `pattern` of a file for each ping, in the folder of a sensor.
std::string path_in(const CheckedJson& value, const std::string& folder, bool pattern) {
    std::string path = value.text();
    const bool sound = pattern ? is_pattern(path) : is_inner_path(path);
    if (!sound || !path.starts_with(folder + "/")) {
        value.refuse("the path of a file in '" + folder + "/'" +
                     (pattern ? " with one number as '%06d'" : ""));
    }
    return path;
}

NamedTexts read_patterns(const CheckedJson& files, const std::string& folder) {
    NamedTexts patterns;
    for (const auto& [kind, pattern] : files.members()) {
        if (!is_plain_name(kind)) pattern.refuse("under a name of letters, digits, '_' and '-'");
        patterns.emplace_back(kind, path_in(pattern, folder, true));
    }
    return patterns;
}

/// The number of bins between the edges.
std::uint64_t read_bins(const CheckedJson& edges) {
    const std::vector<CheckedJson> all = edges.items();
    for (const CheckedJson& edge : all)
        edge.number();
    if (all.size() < 2) edges.refuse("an array of two edges or more");
    return all.size() - 1;
}

std::vector<std::string> read_products(const CheckedJson& json, const std::string& folder) {
    std::vector<std::string> products;
    const std::optional<CheckedJson> list = json.find("products");
    if (!list) return products;
    for (const CheckedJson& product : list->items()) {
        if (!folder.empty()) {
            products.push_back(path_in(product, folder, false));
            continue;
        }
        products.push_back(product.text());
        const std::string& path = products.back();
        if (path != navigation_name && (!path.starts_with("seabed/") || !is_inner_path(path)))
            product.refuse("navigation.tum or the path of a file in 'seabed/'");
    }
    return products;
}

DescribedSensor read_sensor(const CheckedJson& json, std::uint64_t poses) {
    DescribedSensor sensor;
    sensor.name = plain_name(json.at("name"));
    json.at("kind").text();
    sensor.every = json.at("every").whole(1, any_count);
    const std::uint64_t pings = (poses + sensor.every - 1) / sensor.every;
    sensor.pings = json.at("pings").whole(pings, pings);
    const CheckedJson full_scale = json.at("full_scale");
    sensor.full_scale = full_scale.number();
    if (sensor.full_scale < 0.0) full_scale.refuse("a number not below 0");
    sensor.files = read_patterns(json.at("files"), sensor.name);
    if (const auto records = json.find("records"))
        sensor.records = path_in(records->at("file"), sensor.name, false);
    if (const auto labels = json.find("label_records")) {
        for (const auto& [label, record] : labels->members()) {
            if (!is_plain_name(label)) record.refuse("under a name of letters, digits and '_'");
            sensor.label_records.emplace_back(label,
                                              path_in(record.at("file"), sensor.name, false));
        }
    }
    sensor.products = read_products(json, sensor.name);
    sensor.range_bins = read_bins(json.at("range_edges_m"));
    if (const auto edges = json.find("azimuth_edges_rad")) sensor.azimuth_bins = read_bins(*edges);
    return sensor;
}

void check_version(const CheckedJson& json, const std::string& file) {
    const CheckedJson format = json.at("format");
    if (format.text() != dataset_format) format.refuse(dataset_format);
    const Json version = json.at("format_version").json();
    if (version == dataset_format_version) return;
    throw InputError({file}, "has format_version " + version.dump(-1, ' ', true, replace_bytes) +
                                 ", and this program knows " +
                                 std::to_string(dataset_format_version) +
                                 "; use the version that made the dataset");
}

}  // namespace

std::optional<Json> read_description(const std::filesystem::path& folder) {
    const std::string text = read_file(folder / description_name, largest_description);
    try {
        Json json = parse_json(text, description_name);
        const bool ours = json.is_object() && json.value("format", Json()) == dataset_format;
        if (ours) return json;
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): not ours
    }
    return std::nullopt;
}

DatasetFile check_description(Json json, const std::string& file) {
    const CheckedJson root(json, file);
    check_version(root, file);
    DatasetFile dataset;
    root.at("program_version").text();
    dataset.complete = root.at("complete").flag();
    dataset.mission = root.at("mission").text();
    const bool fit =
        is_folder_name(dataset.mission) && dataset.mission.find('\0') == std::string::npos;
    if (!fit) root.at("mission").refuse("fit for the name of one folder");
    dataset.mission_hash = root.at("mission_hash").text();
    dataset.inputs_hash = root.at("inputs_hash").text();
    dataset.seed = root.at("seed").whole(0, std::numeric_limits<std::uint64_t>::max());
    dataset.poses = root.at("poses").whole(1, most_poses);
    std::set<std::string> names;
    for (const CheckedJson& sensor : root.at("sensors").items()) {
        dataset.sensors.push_back(read_sensor(sensor, dataset.poses));
        if (!names.insert(dataset.sensors.back().name).second)
            sensor.at("name").refuse("another name than those of the other sensors");
    }
    dataset.products = read_products(root, {});
    dataset.json = std::move(json);
    return dataset;
}

DatasetFile require_dataset(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / description_name;
    if (!std::filesystem::is_regular_file(file)) {
        const auto above = std::filesystem::absolute(folder / "..").lexically_normal();
        throw InputError(
            {folder.string()},
            !std::filesystem::exists(folder)
                ? "is no dataset: there is no such folder; give the output folder of a render"
            : std::filesystem::is_regular_file(above / description_name)
                ? "is no dataset, but a folder of one; give the folder above"
                : "is no dataset: it has no dataset.json; give the output folder of a render");
    }
    std::optional<Json> json = read_description(folder);
    if (!json) {
        throw InputError({file.string()},
                         "is not sonarsim's, or damaged; give the output folder of a render");
    }
    return check_description(*std::move(json), file.string());
}

}  // namespace sonarsim
