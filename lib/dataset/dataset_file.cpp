#include "dataset/dataset_file.h"

#include <limits>
#include <set>

#include "core/error.h"
#include "core/file.h"
#include "dataset/checked_json.h"
#include "dataset/file_names.h"
#include "dataset/layout.h"
#include "dataset/metadata.h"
#include "mission/schema.h"
#include "trajectory/interpolate.h"
#include "mission/dataset_names.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_description = std::size_t{1} << 28;
constexpr auto replace_bytes = Json::error_handler_t::replace;  ///< bytes that are no text
constexpr std::uint64_t any_count = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t largest_side = std::uint64_t{1} << 20;  ///< side of a picture, px

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

DescribedPacks read_packs(const CheckedJson& json, const std::string& folder) {
    DescribedPacks packs{
        path_in(json.at("file"), folder, true), json.at("pings").whole(1, any_count), {}};
    for (const auto& [kind, member] : json.at("members").members()) {
        const std::string pattern = member.text();
        const bool sound =
            is_plain_name(kind) && is_pattern(pattern) && pattern.find('/') == std::string::npos;
        if (!sound) member.refuse("a name with one number as '%06d'");
        packs.members.emplace_back(kind, pattern);
    }
    return packs;
}

/// The list of labels whose ids an array holds.
std::string read_ids(const CheckedJson& json) {
    const std::optional<CheckedJson> ids = json.find("ids");
    if (!ids) return {};
    std::string text = ids->text();
    if (text != "instances" && text != "classes" && text != "materials")
        ids->refuse("instances, classes or materials");
    return text;
}

/// The file of records.
std::string read_record(const CheckedJson& json, const std::string& folder) {
    for (const CheckedJson& axis : json.at("axes").items())
        axis.text();
    if (const auto name = json.find("name")) plain_name(*name);
    return path_in(json.at("file"), folder, false);
}

/// The number of bins between the edges.
std::uint64_t read_bins(const CheckedJson& edges) {
    double last = -std::numeric_limits<double>::infinity();
    const std::vector<CheckedJson> all = edges.items();
    for (const CheckedJson& edge : all) {
        const double value = edge.number();
        if (!(value > last)) edge.refuse("greater than the edge before it");
        last = value;
    }
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

/// The arrays of a sensor; `bins` and `fan` are the shapes [rows, columns] of a ping and of its
/// fan.
std::vector<DescribedArray> read_arrays(const CheckedJson& sensor,
                                        const std::vector<std::size_t>& bins,
                                        const std::vector<std::size_t>& fan) {
    std::vector<DescribedArray> arrays;
    if (const auto described = sensor.find("arrays")) {
        for (const auto& [kind, array] : described->members()) {
            const CheckedJson axes = array.at("axes");
            const bool is_fan = axes.json() == Json{"row", "column"};
            if (!is_fan && axes.json() != Json{"range", "azimuth"})
                axes.refuse("[range, azimuth] or [row, column]");
            arrays.push_back({kind, is_fan ? fan : bins, read_ids(array)});
        }
    }
    if (const auto records = sensor.find("label_records")) {
        for (const auto& [label, record] : records->members())
            arrays.push_back({"label_records/" + label, {}, read_ids(record)});
    }
    return arrays;
}

void check_numbers(const CheckedJson& list, std::size_t count, const char* right) {
    const std::vector<CheckedJson> numbers = list.items();
    if (numbers.size() != count) list.refuse(right);
    for (const CheckedJson& number : numbers)
        number.number();
}

/// Checks a picture that people may look at; a page may load its files.
void check_picture(const CheckedJson& json, const std::string& folder) {
    json.at("title").text();
    const CheckedJson per = json.at("per");
    const std::string series = per.text();
    if (series != "ping" && series != "sweep" && series != "sensor")
        per.refuse("ping, sweep or sensor");
    path_in(json.at("file"), folder, series != "sensor");
    const auto boxes = json.find("boxes_of");
    if (series == "ping") {
        if (boxes && boxes->text() != "bins" && boxes->text() != "fan")
            boxes->refuse("bins or fan");
        if (const auto ahead = json.find("ahead")) ahead->text();
        return;
    }
    if (boxes) path_in(*boxes, folder, series == "sweep");
    if (series == "sweep") {
        json.at("pings").whole(1, any_count);
        json.at("radius_px").number();
        json.at("width_px").whole(1, largest_side);
    } else if (const auto along = json.find("pings_along")) {
        if (along->text() != "x" && along->text() != "y") along->refuse("x or y");
        check_numbers(json.at("origin_px"), 2, "two numbers");
        check_numbers(json.at("pixel_px"), 2, "two numbers");
        json.at("pings_per_pixel").whole(1, any_count);
    }
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
    if (const auto packs = json.find("packs")) sensor.packs = read_packs(*packs, sensor.name);
    if (const auto records = json.find("records"))
        sensor.records = read_record(*records, sensor.name);
    if (const auto labels = json.find("label_records")) {
        for (const auto& [label, record] : labels->members()) {
            if (!is_plain_name(label)) record.refuse("under a name of letters, digits and '_'");
            sensor.label_records.emplace_back(label, read_record(record, sensor.name));
        }
    }
    sensor.products = read_products(json, sensor.name);
    sensor.range_bins = read_bins(json.at("range_edges_m"));
    if (const auto edges = json.find("azimuth_edges_rad")) sensor.azimuth_bins = read_bins(*edges);
    std::vector<std::size_t> fan_shape;
    if (const auto fan = json.find("fan")) {
        fan_shape = {fan->at("height_px").whole(1, largest_side),
                     fan->at("width_px").whole(1, largest_side)};
    }
    sensor.arrays = read_arrays(json, {sensor.range_bins, sensor.azimuth_bins}, fan_shape);
    if (const auto pictures = json.find("pictures")) {
        for (const CheckedJson& picture : pictures->items())
            check_picture(picture, sensor.name);
    }
    if (const auto scan = json.find("scan")) scan->at("pings_per_sweep").whole(1, any_count);
    return sensor;
}

/// The names with the ids 1, 2, ...
std::vector<std::string> read_names(const CheckedJson& list) {
    std::vector<std::string> names;
    for (const CheckedJson& one : list.items()) {
        names.push_back(one.at("name").text());
        one.at("id").whole(names.size(), names.size());
    }
    return names;
}

DescribedLabels read_labels(const CheckedJson& json) {
    DescribedLabels labels{read_names(json.at("instances")), read_names(json.at("classes")),
                           read_names(json.at("materials"))};
    for (const CheckedJson& instance : json.at("instances").items()) {
        instance.at("class").whole(1, labels.classes.size());
        const CheckedJson box = instance.at("box_world_m");
        if (box.json().is_null()) continue;
        check_numbers(box.at("min"), 3, "three numbers");
        check_numbers(box.at("max"), 3, "three numbers");
    }
    return labels;
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
    if (const auto labels = root.find("labels")) dataset.labels = read_labels(*labels);
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
