#include "dataset/record_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/atomic_file.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/folded_records.h"
#include "dataset/record_file.h"
#include "format/coco_counts.h"
#include "mission/dataset_names.h"
#include "product/contrast.h"
#include "product/fan_bins.h"
#include "product/object_masks.h"
#include "product/scan.h"
#include "sonar/sonar.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_unseen = 32;     ///< pings; see the header
constexpr std::size_t most_passes = 65536;  // numbers of 16 bits

/// The values of successive pings, [lines, bins].
struct Values {
    Values(int line_count, int bin_count, bool is_full_turn = false)
        : lines(line_count), bins(bin_count), full_turn(is_full_turn) {
        const std::size_t all = static_cast<std::size_t>(lines) * bins;
        object.resize(all);
        shadow.resize(all);
        visible_share.resize(all);
        level.resize(all);
    }
    LevelMap map() const { return {lines, bins, object, shadow, level, full_turn}; }

    int lines, bins;
    bool full_turn;  ///< the last line is next to the first
    std::vector<std::uint16_t> object, shadow, visible_share;
    std::vector<float> level;
};

/// The records of a sensor, and the names of what they show.
struct Source {
    Source(const Layout& layout, std::size_t sensor, const Json& description)
        : labels(description.at("labels")),
          described(description.at("sensors").at(sensor)),
          object(open(layout, sensor, "instance")),
          shadow(open(layout, sensor, object_shadow_record)),
          visible_share(open(layout, sensor, visible_share_record)),
          level(open(layout, sensor, "")) {
        const Json& names = labels.at("annotations").at("background");
        for (const Json& one : labels.at("instances"))
            is_background.push_back(
                std::ranges::find(names, class_name(one)) != names.end() ? 1 : 0);
        is_background.resize(std::size_t{1} << 16, 1);  // any id that a damaged record may hold
        const auto edges = described.at("range_edges_m").get<std::vector<double>>();
        for (std::size_t k = 0; k + 1 < edges.size(); ++k)
            range_m.push_back(0.5 * (edges[k] + edges[k + 1]));
    }

    static RecordFile open(const Layout& layout, std::size_t sensor, std::string_view label) {
        const SensorLayout& own = layout.sensors[sensor];
        const auto found = std::ranges::find_if(own.per_ping, [&](const auto& part) {
            const auto* record = std::get_if<PingRecord>(&part);
            return record && record->label == label;
        });
        const auto& record = std::get<PingRecord>(*found);
        return {layout.sensor_folder(sensor) / record.file, record.format, own.pings,
                RecordAccess::read};
    }
    const Json& class_name(const Json& instance) const {
        return labels.at("classes").at(instance.at("class").get<std::size_t>() - 1).at("name");
    }
    /// Reads `count` pings from `first` on into the lines from `line` on.
    void read(std::size_t first, std::size_t count, std::size_t line, Values& values) const {
        const auto read_one = [&](const RecordFile& file, auto& all) {
            const auto bins = static_cast<std::size_t>(values.bins);
            file.read(first, std::as_writable_bytes(
                                 std::span(all).subspan(line * bins, count * bins)));
        };
        read_one(object, values.object);
        read_one(shadow, values.shadow);
        read_one(visible_share, values.visible_share);
        read_one(level, values.level);
    }
    std::size_t pings() const { return object.records(); }

    const Json& labels;     ///< of dataset.json
    const Json& described;  ///< the sensor in dataset.json
    RecordFile object, shadow, visible_share, level;
    std::vector<std::uint8_t> is_background{1};  ///< indexed by id
    std::vector<double> range_m;                 ///< middle of each range bin
};

/// What is known of an object in a picture.
struct Seen {
    std::uint16_t id = 0;
    BinBox box, shadow;          ///< lines are pings, or steps of a sweep
    double range_m = 0.0;        ///< sum over its bins
    double visible_share = 0.0;  ///< the same; 65535 is all of it
    int bins = 0, bins_with_share = 0;
    const char* side = nullptr;  ///< of a side-scan sonar
    std::optional<double> bearing_deg, contrast_db, shadow_contrast_db;
    std::pair<std::size_t, std::size_t> pings;  ///< the first and the one after the last
    std::optional<PixelBox> shadow_px;
    bool clipped = false;

    void add(int line, int bin, double bin_range_m, std::uint16_t share) {
        box.extend(line, bin);
        range_m += bin_range_m;
        ++bins;
        if (share == 0) return;  // not known
        visible_share += share;
        ++bins_with_share;
    }
};

/// The line of an object in a file.
Json object_json(const Source& source, const Seen& seen, const ObjectMask& mask) {
    constexpr double millimetres = 1e3;
    constexpr double hundredths = 1e2;
    constexpr double of_share = 1e4;
    const auto rounded = [](const std::optional<double>& value, double per_unit) {
        return value ? Json(std::round(*value * per_unit) / per_unit) : Json();
    };
    const auto mean = [&](double sum, int count, double per_unit) {
        const bool known = count > 0 && source.is_background[seen.id] == 0;
        return known ? rounded(sum / count, per_unit) : Json();
    };
    const Json& instance = source.labels.at("instances").at(seen.id - 1U);
    Json json = {{"id", seen.id},
                 {"name", instance.at("name")},
                 {"class", source.class_name(instance)}};
    if (seen.side) json["side"] = seen.side;
    json["pings"] = {seen.pings.first, seen.pings.second};
    json["box_px"] = {{"x", {mask.left, mask.right}}, {"y", {mask.top, mask.bottom}}};
    json["area_px"] = mask.area;
    json["mask"] = coco_counts(mask.runs);
    json["range_m"] = mean(seen.range_m, seen.bins, millimetres);
    json["bearing_deg"] = rounded(seen.bearing_deg, hundredths);
    json["contrast_db"] = rounded(seen.contrast_db, hundredths);
    json["visible_share"] = mean(seen.visible_share / 65535.0, seen.bins_with_share, of_share);
    if (const auto& box = seen.shadow_px)
        json["shadow_box_px"] = {{"x", {box->left, box->right}}, {"y", {box->top, box->bottom}}};
    json["shadow_contrast_db"] = rounded(seen.shadow_contrast_db, hundredths);
    json["clipped"] = seen.clipped;
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

/// The box of the bins in `within` that show the shadow of an object; empty for none.
BinBox shadow_box(const Values& values, std::uint16_t id, const BinBox& within) {
    BinBox box;
    for (int line = within.first_line; line <= within.last_line; ++line) {
        for (int bin = within.first_bin; bin <= within.last_bin; ++bin) {
            if (values.shadow[static_cast<std::size_t>(line) * values.bins + bin] == id)
                box.extend(line, bin);
        }
    }
    return box;
}

void add_contrasts(const Source& source, const Values& values, const BinBox& box,
                   const BinBox& shadow, Seen& seen) {
    const LevelMap map = values.map();
    seen.contrast_db = contrast_db(map, map.object, seen.id, box, source.is_background);
    if (!shadow.is_empty())
        seen.shadow_contrast_db =
            contrast_db(map, map.shadow, seen.id, shadow, source.is_background);
}

/// The picture of all pings of a sonar. A row, or column, may stand for several pings.
class Strip {
  public:
    Strip(const Layout& layout, std::size_t sensor, const Json& description)
        : source_(layout, sensor, description),
          is_upright_(source_.described.at("pictures").at(0).at("pings_along") == "x"),
          two_sides_(source_.described.contains("waterfall")),
          ranges_(static_cast<int>(source_.range_m.size())),
          rows_(static_cast<std::size_t>(picture_rows(source_.pings()))) {
        const std::size_t bytes = source_.object.record_bytes();
        bins_ = static_cast<int>(bytes / sizeof(std::uint16_t));
        range_m_ = source_.range_m;
        if (!two_sides_) return;
        const double column_m = source_.described.at("waterfall").at("column_m");
        const double offset_m = source_.described.at("waterfall").at("offset_m");
        range_m_.clear();
        for (int bin = 0; bin < bins_; ++bin)
            range_m_.push_back(std::fabs(bin + 0.5 - 0.5 * bins_) * column_m + offset_m);
    }

    void write(const std::filesystem::path& path, const std::string& picture) {
        find_passes();
        const auto height = is_upright_ ? static_cast<std::size_t>(bins_) : rows_;
        std::vector<Json> objects;
        for (const ObjectMask& mask : object_masks(of_pixel_, static_cast<int>(height))) {
            complete(passes_[mask.id]);
            objects.push_back(object_json(source_, passes_[mask.id], mask));
        }
        write_objects(path,
                      {{"picture", picture},
                       {"width", is_upright_ ? rows_ : static_cast<std::size_t>(bins_)},
                       {"height", height},
                       {"pings", source_.pings()},
                       {"pings_per_pixel", pings_per_row(source_.pings())}},
                      objects);
    }

  private:
    bool is_port(int bin) const { return two_sides_ && bin < bins_ / 2; }
    /// The bins of the side that a bin lies on, or all.
    BinBox side_of(int bin) const {
        if (!two_sides_) return {0, 0, 0, bins_ - 1};
        return is_port(bin) ? BinBox{0, 0, 0, bins_ / 2 - 1} : BinBox{0, 0, bins_ / 2, bins_ - 1};
    }
    bool is_edge(int bin) const {
        const int from_nadir = is_port(bin) ? bins_ / 2 - 1 - bin : bin - (two_sides_ ? bins_ / 2 : 0);
        const int last = (two_sides_ ? bins_ / 2 : bins_) - 1;
        return from_nadir == last || from_nadir == last + 1 - ranges_;
    }

    /// The present pass of an object on one side.
    struct Present {
        std::uint16_t pass = 0;
        std::size_t last = 0;  ///< last ping that saw the object
        BinBox shadow;         ///< shadow since then, which counts if the pass goes on
    };

    /// Numbers the passes from 1 on. `of_pixel_` has the order of object_masks(). Where a row
    /// stands for several pings, it holds the pass of the first ping that shows an object.
    void find_passes() {
        std::array<std::vector<Present>, 2> present;
        present.fill(std::vector<Present>(most_passes));
        of_pixel_.assign(static_cast<std::size_t>(bins_) * rows_, 0);
        const std::size_t each = pings_per_row(source_.pings());
        Values values(1, bins_);
        for (std::size_t ping = 0; ping < source_.pings(); ++ping) {
            source_.read(ping, 1, 0, values);
            for (int bin = 0; bin < bins_; ++bin) {
                const std::uint16_t id = values.object[bin];
                if (id == 0) continue;
                Present& one = present[is_port(bin) ? 1 : 0][id];
                see(id, ping, bin, values.visible_share[bin], one);
                const std::size_t at = is_upright_ ? ping / each * bins_ + bin
                                                   : static_cast<std::size_t>(bin) * rows_ + ping / each;
                if (of_pixel_[at] == 0) of_pixel_[at] = one.pass;
            }
            for (int bin = 0; bin < bins_; ++bin) {
                const std::uint16_t id = values.shadow[bin];
                if (id == 0) continue;
                Present& one = present[is_port(bin) ? 1 : 0][id];
                if (one.pass == 0) continue;
                BinBox& box = one.last == ping ? passes_[one.pass].shadow : one.shadow;
                box.extend(static_cast<int>(ping), bin);
            }
        }
    }

    void see(std::uint16_t id, std::size_t ping, int bin, std::uint16_t share, Present& one) {
        const bool is_new = one.pass == 0 || ping - one.last > most_unseen;
        if (is_new && passes_.size() < most_passes) {
            one = {static_cast<std::uint16_t>(passes_.size()), ping, {}};
            passes_.emplace_back().id = id;
        }
        Seen& pass = passes_[one.pass];
        if (!one.shadow.is_empty()) {
            pass.shadow.extend(one.shadow.first_line, one.shadow.first_bin);
            pass.shadow.extend(one.shadow.last_line, one.shadow.last_bin);
            one.shadow = {};
        }
        one.last = ping;
        pass.add(static_cast<int>(ping), bin, range_m_[bin], share);
    }

    /// Finds the other facts of a pass.
    void complete(Seen& pass) const {
        const BinBox& box = pass.box;
        const bool port = is_port(box.first_bin);
        pass.pings = {box.first_line, box.last_line + 1};
        pass.clipped = is_edge(box.first_bin) || is_edge(box.last_bin) || box.first_line == 0 ||
                       pass.pings.second == source_.pings();
        if (two_sides_) pass.side = port ? "port" : "starboard";
        if (source_.is_background[pass.id] != 0) return;
        if (two_sides_) pass.bearing_deg = port ? -90.0 : 90.0;
        add_contrasts_of(pass);
        if (pass.shadow.is_empty()) return;
        const auto each = static_cast<int>(pings_per_row(source_.pings()));
        const BinBox& shadow = pass.shadow;
        const int first = shadow.first_line / each;
        const int end = shadow.last_line / each + 1;
        pass.shadow_px = is_upright_ ? PixelBox{first, end, shadow.first_bin, shadow.last_bin + 1}
                                     : PixelBox{shadow.first_bin, shadow.last_bin + 1, first, end};
    }

    /// The beginning of a longer pass represents the whole pass.
    void add_contrasts_of(Seen& pass) const {
        constexpr int most_pings = 1024;
        BinBox box = pass.box;
        const int pings = std::min(box.last_line - box.first_line + 1, most_pings);
        const int margin = std::max(pings, 2);
        const int first = std::max(box.first_line - margin, 0);
        const int end = std::min(box.first_line + pings + margin, static_cast<int>(source_.pings()));
        Values values(end - first, bins_);
        source_.read(first, end - first, 0, values);
        box.first_line -= first;
        box.last_line = box.first_line + pings - 1;
        BinBox within = side_of(box.first_bin);
        within.first_line = box.first_line;
        within.last_line = box.last_line;
        add_contrasts(source_, values, box, shadow_box(values, pass.id, within), pass);
    }

    Source source_;
    bool is_upright_;  ///< pings are columns
    bool two_sides_;   ///< port, then starboard
    int ranges_;       ///< range bins of a side
    int bins_ = 0;     ///< values per ping
    std::size_t rows_;  ///< rows or columns of pings
    std::vector<double> range_m_;  ///< of each value of a ping
    std::vector<Seen> passes_{{}};  ///< indexed by number
    std::vector<std::uint16_t> of_pixel_;
};

/// What the display of a sweep shows of an object.
Seen seen_in_sweep(const Source& source, const Values& display, std::uint16_t id,
                   const Sonar& whole) {
    Seen seen{.id = id};
    double ahead = 0.0;
    double to_port = 0.0;
    for (int step = 0; step < display.lines; ++step) {
        const SinCos at =
            sincos(0.5 * (whole.azimuth_edges_rad[step] + whole.azimuth_edges_rad[step + 1]));
        for (int bin = 0; bin < display.bins; ++bin) {
            const std::size_t k = static_cast<std::size_t>(step) * display.bins + bin;
            if (display.object[k] != id) continue;
            seen.add(step, bin, source.range_m[bin], display.visible_share[k]);
            ahead += at.cos;
            to_port += at.sin;
        }
    }
    const BinBox& box = seen.box;
    const bool at_side = !display.full_turn && (box.first_line == 0 || box.last_line + 1 == display.lines);
    seen.clipped = at_side || box.first_bin == 0 || box.last_bin + 1 == display.bins;
    if (source.is_background[id] != 0) return seen;
    seen.bearing_deg = -degrees(arctan2(to_port, ahead));
    const BinBox all{0, display.lines - 1, 0, display.bins - 1};
    add_contrasts(source, display, box, shadow_box(display, id, all), seen);
    return seen;
}

/// Writes a file for every sweep of a scanning sonar. A step that an unfinished sweep has not
/// reached shows the sweep before.
void write_sweeps(const Layout& layout, const Mission& mission, std::size_t sensor,
                  const Json& description) {
    const Source source(layout, sensor, description);
    const SonarConfig& config = mission.sensors[sensor];
    const Sonar whole = whole_scan(make_sonar(config, mission.accuracy, mission.water));
    const FanBins fan = make_fan_bins(whole, mission.output.fan_width_px);
    const auto masks = [&](const std::vector<std::uint16_t>& ids) {
        return object_masks(fan_values(fan.by_column, ids, std::uint16_t{0}), fan.frame.height);
    };
    const auto steps = static_cast<std::size_t>(scan_steps(config));
    Values display(scan_steps(config), config.range_bins, config.sector_deg >= 360.0);
    for (std::size_t ping = 0; ping < source.pings(); ++ping) {
        source.read(ping, 1, static_cast<std::size_t>(scan_step(config, ping)), display);
        if ((ping + 1) % steps != 0 && ping + 1 != source.pings()) continue;
        const std::size_t sweep = ping / steps;
        const std::vector<ObjectMask> shadows = masks(display.shadow);
        std::vector<Json> objects;
        for (const ObjectMask& mask : masks(display.object)) {
            Seen seen = seen_in_sweep(source, display, static_cast<std::uint16_t>(mask.id), whole);
            seen.pings = {sweep * steps, ping + 1};
            const auto shadow = std::ranges::find(shadows, mask.id, &ObjectMask::id);
            if (shadow != shadows.end() && source.is_background[mask.id] == 0)
                seen.shadow_px = PixelBox{shadow->left, shadow->right, shadow->top, shadow->bottom};
            objects.push_back(object_json(source, seen, mask));
        }
        write_objects(layout.sensor_folder(sensor) / scan_file_name("objects", sweep, ".json"),
                      {{"picture", scan_file_name("scan", sweep, ".png")},
                       {"width", fan.frame.width},
                       {"height", fan.frame.height},
                       {"pings", ping + 1 - sweep * steps},
                       {"pings_per_pixel", 1}},
                      objects);
    }
}

}  // namespace

void write_record_objects(const Layout& layout, const Mission& mission,
                          const Json& description) try {
    for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
        const std::vector<std::string>& products = layout.sensors[i].products;
        const RecordShape& shape = kind_of(mission.sensors[i].kind).record;
        if (std::ranges::find(products, record_objects_name) != products.end()) {
            Strip(layout, i, description)
                .write(layout.sensor_folder(i) / record_objects_name,
                       std::string(shape.name) + ".png");
        } else if (std::ranges::find(products, scan_file_name("objects", 0, ".json")) !=
                   products.end()) {
            write_sweeps(layout, mission, i, description);
        }
    }
} catch (const Json::exception&) {  // of a part that somebody else made
    throw InputError({(layout.folder / description_name).string()},
                     "has labels that do not fit the records; render the dataset anew");
}

}  // namespace sonarsim
