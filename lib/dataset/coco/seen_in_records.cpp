#include "dataset/coco/seen_in_records.h"

#include <span>

namespace sonarsim {

namespace {

void open_record(const Layout& layout, std::size_t sensor, std::string_view label,
                 std::optional<RecordFile>& file) {
    const SensorLayout& own = layout.sensors[sensor];
    if (const PingRecord* const record = record_of_label(own, label))
        file.emplace(layout.sensor_folder(sensor) / record->file, record->format, own.pings,
                     RecordAccess::read);
}

template <class T>
void read_lines(const std::optional<RecordFile>& file, std::size_t first, std::size_t count,
                std::size_t offset, std::size_t bins, std::vector<T>& values) {
    if (!file) return values.clear();
    const std::span<T> lines = std::span(values).subspan(offset, count * bins);
    file->read(first, std::as_writable_bytes(lines));
}

}  // namespace

void RecordValues::resize(int new_lines, int new_bins) {
    lines = new_lines;
    bins = new_bins;
    const std::size_t all = static_cast<std::size_t>(lines) * static_cast<std::size_t>(bins);
    object.assign(all, 0);
    shadow.assign(all, 0);
    visible_share.assign(all, 0);
    level.assign(all, 0.0F);
}

AnnotationRecords::AnnotationRecords(const Layout& layout, std::size_t sensor) {
    open_record(layout, sensor, "instance", object_);
    open_record(layout, sensor, object_shadow_record, shadow_);
    open_record(layout, sensor, visible_share_record, visible_share_);
    open_record(layout, sensor, "", level_);
}

void AnnotationRecords::read(std::size_t first, std::size_t count, std::size_t line,
                             RecordValues& values) const {
    const auto bins = static_cast<std::size_t>(values.bins);
    read_lines(object_, first, count, line * bins, bins, values.object);
    read_lines(shadow_, first, count, line * bins, bins, values.shadow);
    read_lines(visible_share_, first, count, line * bins, bins, values.visible_share);
    read_lines(level_, first, count, line * bins, bins, values.level);
}

std::vector<std::uint8_t> background_ids(const nlohmann::ordered_json& labels,
                                         const AnnotationRules& rules) {
    std::vector<std::uint8_t> ids{1};
    for (const auto& instance : labels.at("instances"))
        ids.push_back(rules.is_background(instance.at("class").get<std::size_t>() - 1) ? 1 : 0);
    return ids;
}

void ObjectMeans::add(const RecordValues& values, std::uint16_t id, const BinBox& box,
                      std::span<const double> range_m) {
    for (int line = box.first_line; line <= box.last_line; ++line) {
        for (int bin = box.first_bin; bin <= box.last_bin; ++bin) {
            const std::size_t at = static_cast<std::size_t>(line) * values.bins + bin;
            if (values.object[at] != id) continue;
            range_m_ += range_m[static_cast<std::size_t>(bin)];
            ++bins_;
            if (values.visible_share.empty() || values.visible_share[at] == 0) continue;
            share_ += values.visible_share[at];
            ++bins_with_share_;
        }
    }
}

void ObjectMeans::give_to(SeenFacts& seen) const {
    constexpr double whole = 65535.0;
    if (bins_ > 0) seen.range_m = range_m_ / bins_;
    if (bins_with_share_ > 0) seen.visible_share = share_ / bins_with_share_ / whole;
}

SeenFacts seen_in_records(const RecordValues& values, std::uint16_t id, const BinBox& box,
                          const BinBox& shadow, std::span<const double> range_m,
                          std::span<const std::uint8_t> is_background) {
    SeenFacts seen;
    ObjectMeans means;
    means.add(values, id, box, range_m);
    if (means.is_empty()) return seen;
    means.give_to(seen);
    if (values.level.empty()) return seen;
    const LevelMap map{values.lines,  values.bins,  values.object,
                       values.shadow, values.level, values.full_turn};
    seen.contrast_db = contrast_db(map, map.object, id, box, is_background);
    if (!shadow.is_empty())
        seen.shadow_contrast_db = contrast_db(map, map.shadow, id, shadow, is_background);
    return seen;
}

BinBox shadow_box(const RecordValues& values, std::uint16_t id, const BinBox& within) {
    BinBox box;
    for (int line = within.first_line; line <= within.last_line && !values.shadow.empty(); ++line) {
        for (int bin = within.first_bin; bin <= within.last_bin; ++bin) {
            if (values.shadow[static_cast<std::size_t>(line) * values.bins + bin] == id)
                box.extend(line, bin);
        }
    }
    return box;
}

}  // namespace sonarsim
