#include "dataset/object_records.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "core/atomic_file.h"
#include "format/coco_counts.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

RecordFile open(const Layout& layout, std::size_t sensor, std::string_view label) {
    const SensorLayout& own = layout.sensors[sensor];
    const auto found = std::ranges::find_if(own.per_ping, [&](const auto& part) {
        const auto* record = std::get_if<PingRecord>(&part);
        return record && record->label == label;
    });
    const auto& record = std::get<PingRecord>(*found);
    return {layout.sensor_folder(sensor) / record.file, record.format, own.pings,
            RecordAccess::read};
}

const Json& class_of(const Json& labels, const Json& instance) {
    return labels.at("classes").at(instance.at("class").get<std::size_t>() - 1).at("name");
}

Json rounded(const std::optional<double>& value, double per_unit) {
    return value ? Json(std::round(*value * per_unit) / per_unit) : Json();
}

Json box_json(int left, int right, int top, int bottom) {
    return {{"x", {left, right}}, {"y", {top, bottom}}};
}

}  // namespace

RecordValues::RecordValues(int line_count, int bin_count, bool is_full_turn)
    : lines(line_count), bins(bin_count), full_turn(is_full_turn) {
    const std::size_t all = static_cast<std::size_t>(lines) * bins;
    object.resize(all);
    shadow.resize(all);
    visible_share.resize(all);
    level.resize(all);
}

BinBox RecordValues::shadow_box(std::uint16_t id, const BinBox& within) const {
    BinBox box;
    for (int line = within.first_line; line <= within.last_line; ++line) {
        for (int bin = within.first_bin; bin <= within.last_bin; ++bin) {
            if (shadow[static_cast<std::size_t>(line) * bins + bin] == id) box.extend(line, bin);
        }
    }
    return box;
}

ObjectRecords::ObjectRecords(const Layout& layout, std::size_t sensor, const Json& description)
    : labels(description.at("labels")),
      described(description.at("sensors").at(sensor)),
      object(open(layout, sensor, "instance")),
      shadow(open(layout, sensor, object_shadow_record)),
      visible_share(open(layout, sensor, visible_share_record)),
      level(open(layout, sensor, "")) {
    const Json& background = labels.at("annotations").at("background");
    for (const Json& one : labels.at("instances")) {
        const bool found =
            std::ranges::find(background, class_of(labels, one)) != background.end();
        is_background.push_back(found ? 1 : 0);
    }
    is_background.resize(std::size_t{1} << 16, 1);  // any id that a damaged record may hold
    const auto edges = described.at("range_edges_m").get<std::vector<double>>();
    for (std::size_t k = 0; k + 1 < edges.size(); ++k)
        range_m.push_back(0.5 * (edges[k] + edges[k + 1]));
}

void ObjectRecords::read(std::size_t first, std::size_t count, std::size_t line,
                         RecordValues& values) const {
    const auto read_one = [&](const RecordFile& file, auto& all) {
        const auto bins = static_cast<std::size_t>(values.bins);
        file.read(first,
                  std::as_writable_bytes(std::span(all).subspan(line * bins, count * bins)));
    };
    read_one(object, values.object);
    read_one(shadow, values.shadow);
    read_one(visible_share, values.visible_share);
    read_one(level, values.level);
}

void SeenObject::add(int line, int bin, double bin_range_m, std::uint16_t share) {
    box.extend(line, bin);
    range_m += bin_range_m;
    ++bins;
    if (share == 0) return;
    visible_share += share;
    ++bins_with_share;
}

void SeenObject::add_contrasts(const ObjectRecords& records, const RecordValues& values,
                               const BinBox& own, const BinBox& own_shadow) {
    const LevelMap map = values.map();
    contrast_db = sonarsim::contrast_db(map, map.object, id, own, records.is_background);
    if (!own_shadow.is_empty())
        shadow_contrast_db =
            sonarsim::contrast_db(map, map.shadow, id, own_shadow, records.is_background);
}

Json SeenObject::json(const ObjectRecords& records, const ObjectMask& mask) const {
    constexpr double millimetres = 1e3;
    constexpr double hundredths = 1e2;
    constexpr double of_share = 1e4;
    constexpr double whole = 65535.0;
    const auto mean = [&](double sum, int count) -> std::optional<double> {
        if (count == 0 || records.is_background[id] != 0) return std::nullopt;
        return sum / count;
    };
    const Json& instance = records.labels.at("instances").at(id - 1U);
    Json json = {{"id", id},
                 {"name", instance.at("name")},
                 {"class", class_of(records.labels, instance)}};
    if (side) json["side"] = side;
    json["pings"] = {pings.first, pings.second};
    json["box_px"] = box_json(mask.left, mask.right, mask.top, mask.bottom);
    json["area_px"] = mask.area;
    json["mask"] = coco_counts(mask.runs);
    json["range_m"] = rounded(mean(range_m, bins), millimetres);
    json["bearing_deg"] = rounded(bearing_deg, hundredths);
    json["contrast_db"] = rounded(contrast_db, hundredths);
    json["visible_share"] = rounded(mean(visible_share / whole, bins_with_share), of_share);
    if (const auto& s = shadow_px) json["shadow_box_px"] = box_json(s->left, s->right, s->top, s->bottom);
    json["shadow_contrast_db"] = rounded(shadow_contrast_db, hundredths);
    json["clipped"] = clipped;
    return json;
}

void write_objects(const std::filesystem::path& path, const Json& head,
                   const std::vector<Json>& objects) {
    const auto line = [](const Json& json) {
        return json.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    std::string text = line(head);
    text.back() = ',';
    StreamedFile file(path);
    file.append(text + "\"objects\":[");
    for (std::size_t k = 0; k < objects.size(); ++k)
        file.append((k == 0 ? "\n" : ",\n") + line(objects[k]));
    file.append("\n]}\n");
    file.finish();
}

}  // namespace sonarsim
