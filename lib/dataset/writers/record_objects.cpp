#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/atomic_file.h"
#include "core/elementary.h"
#include "core/units.h"
#include "dataset/averaged_rows.h"
#include "dataset/json.h"
#include "dataset/writers/label_writers.h"
#include "format/coco_counts.h"
#include "product/contrast.h"
#include "product/fan_bins.h"
#include "product/object_table.h"
#include "product/scan.h"
#include "product/sidescan_row.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;
using Ids = std::vector<std::uint16_t>;

constexpr std::size_t most_unseen = 32;     // pings between two of one pass
constexpr std::size_t most_passes = 65536;  // numbers of 16 bits

/// The values of successive pings, [lines, bins].
struct RecordValues {
    RecordValues(int line_count, int bin_count, bool is_full_turn = false)
        : lines(line_count), bins(bin_count), full_turn(is_full_turn) {
        const std::size_t all = static_cast<std::size_t>(lines) * bins;
        for (Ids* ids : {&object, &shadow, &visible_share})
            ids->resize(all);
        level.resize(all);
    }

    int lines, bins;
    bool full_turn;  ///< the last line is next to the first
    Ids object, shadow;
    Ids visible_share;  ///< 65535 is all of the object, 0: not known
    std::vector<float> level;
};

/// The facts of an object in a picture. Those that are not known are empty.
struct SeenObject {
    std::uint16_t id = 0;
    BinBox box, shadow;          ///< lines are pings, or steps of a sweep
    double range_m = 0.0;        ///< sum over its bins
    double visible_share = 0.0;  ///< the same; 65535 is all of it
    int bins = 0, bins_with_share = 0;
    const char* side = nullptr;  ///< port or starboard, in a side-scan sonar
    std::optional<double> bearing_deg, contrast_db, shadow_contrast_db;
    std::pair<std::size_t, std::size_t> pings;  ///< the first and the one after the last
    PixelBox shadow_px;
    bool clipped = false;

    void add(int line, int bin, double bin_range_m, std::uint16_t share) {
        box.extend(line, bin);
        range_m += bin_range_m;
        ++bins;
        if (share == 0) return;
        visible_share += share;
        ++bins_with_share;
    }
};

Json rounded(const std::optional<double>& value, double per_unit) {
    return value ? Json(std::round(*value * per_unit) / per_unit) : Json();
}

/// The records of a sonar that its objects are found in.
class ObjectRecords {
  public:
    ObjectRecords(const WriterContext& context, const std::filesystem::path& folder)
        : context_(context),
          object_(open(folder, "instance", "<u2")),
          shadow_(open(folder, object_shadow_record, "<u2")),
          visible_share_(open(folder, visible_share_record, "<u2")),
          level_(open(folder, context.kind().record.name, "<f4")),
          is_background_(background_ids(context.assembly.objects)) {
        const std::vector<double>& edges = context.sonar().range_edges_m;
        for (std::size_t k = 0; k + 1 < edges.size(); ++k)
            range_m.push_back(0.5 * (edges[k] + edges[k + 1]));
    }

    bool is_background(std::uint32_t id) const { return is_background_[id] != 0; }

    /// Reads `count` pings from `first` on into the lines from `line` on.
    void read(std::size_t first, std::size_t count, std::size_t line, RecordValues& values) const {
        const auto read_one = [&](const RecordFile& file, auto& all) {
            const auto bins = static_cast<std::size_t>(values.bins);
            file.read(first,
                      std::as_writable_bytes(std::span(all).subspan(line * bins, count * bins)));
        };
        read_one(object_, values.object);
        read_one(shadow_, values.shadow);
        read_one(visible_share_, values.visible_share);
        read_one(level_, values.level);
    }

    /// Compares the object in `own` and its shadow within `around` with their surroundings.
    void add_contrasts(const RecordValues& values, const BinBox& own, const BinBox& around,
                       SeenObject& seen) const {
        const LevelMap map{values.lines,  values.bins,  values.object,
                           values.shadow, values.level, values.full_turn};
        seen.contrast_db = contrast_db(map, map.object, seen.id, own, is_background_);
        BinBox shadow;
        for (int line = around.first_line; line <= around.last_line; ++line) {
            for (int bin = around.first_bin; bin <= around.last_bin; ++bin) {
                if (map.shadow[static_cast<std::size_t>(line) * values.bins + bin] == seen.id)
                    shadow.extend(line, bin);
            }
        }
        if (!shadow.is_empty())
            seen.shadow_contrast_db = contrast_db(map, map.shadow, seen.id, shadow, is_background_);
    }

    Json json(const SeenObject& seen, const ObjectMask& mask) const {
        const auto mean = [&](double sum, int count) -> std::optional<double> {
            if (count == 0 || is_background(seen.id)) return std::nullopt;
            return sum / count;
        };
        constexpr double whole = 65535.0;
        const SceneObjects& objects = context_.assembly.objects;
        const SceneObjects::Object& object = objects.objects.at(seen.id - 1U);
        Json json = {
            {"id", seen.id}, {"name", object.name}, {"class", objects.classes[object.class_index]}};
        if (seen.side) json["side"] = seen.side;
        json["pings"] = {seen.pings.first, seen.pings.second};
        json["box_px"] = describe_box({mask.left, mask.right, mask.top, mask.bottom});
        json["area_px"] = mask.area;
        json["mask"] = coco_counts(mask.runs);
        json["range_m"] = rounded(mean(seen.range_m, seen.bins), 1e3);
        json["bearing_deg"] = rounded(seen.bearing_deg, 1e2);
        json["contrast_db"] = rounded(seen.contrast_db, 1e2);
        json["visible_share"] =
            rounded(mean(seen.visible_share / whole, seen.bins_with_share), 1e4);
        if (!seen.shadow_px.is_empty()) json["shadow_box_px"] = describe_box(seen.shadow_px);
        json["shadow_contrast_db"] = rounded(seen.shadow_contrast_db, 1e2);
        json["clipped"] = seen.clipped;
        return json;
    }

    std::vector<double> range_m;  ///< middle of each range bin

  private:
    RecordFile open(const std::filesystem::path& folder, std::string_view stem,
                    const char* type) const {
        const auto outputs = record_outputs(context_, std::string(stem), type, type[2] - '0');
        const auto& record = std::get<PingRecord>(outputs.per_ping);
        return {folder / record.file, record.format, context_.pings, RecordAccess::read};
    }

    const WriterContext& context_;
    RecordFile object_, shadow_, visible_share_, level_;
    std::vector<std::uint8_t> is_background_;  ///< indexed by id
};

void write_objects(const std::filesystem::path& path, const Json& head,
                   const std::vector<Json>& objects) {
    StreamedFile file(path);
    file.append(objects_text(head, objects));
    file.finish();
}

/// The picture of all pings of a sonar. A row, or column, may stand for several pings.
class Strip {
  public:
    Strip(const WriterContext& context, const std::filesystem::path& folder)
        : source_(context, folder),
          shape_(context.kind().record),
          pings_(context.pings),
          ranges_(static_cast<int>(source_.range_m.size())),
          bins_(static_cast<int>(shape_.values(context.sonar().config))),
          each_(pings_per_row(pings_)),
          rows_(static_cast<std::size_t>(picture_rows(pings_))),
          range_m_(source_.range_m) {
        if (!shape_.two_sides) return;
        const double column_m = context.sonar().settings.view.bin_m();
        const double offset_m = column_offset_m(context.sonar().config);
        range_m_.clear();
        for (int bin = 0; bin < bins_; ++bin)
            range_m_.push_back(std::fabs(bin + 0.5 - 0.5 * bins_) * column_m + offset_m);
    }

    void write(const std::filesystem::path& path) {
        find_passes();
        const std::size_t across = shape_.upright ? rows_ : static_cast<std::size_t>(bins_);
        const std::size_t down = shape_.upright ? static_cast<std::size_t>(bins_) : rows_;
        std::vector<Json> objects;
        for (const ObjectMask& mask : object_masks(pass_of_pixel_, static_cast<int>(down))) {
            complete(passes_[mask.id]);
            objects.push_back(source_.json(passes_[mask.id], mask));
        }
        write_objects(path,
                      {{"picture", std::string(shape_.name) + ".png"},
                       {"width", across},
                       {"height", down},
                       {"pings", pings_},
                       {"pings_per_pixel", each_}},
                      objects);
    }

  private:
    bool is_port(int bin) const { return shape_.two_sides && bin < bins_ / 2; }
    bool is_edge(int bin) const {
        const int side = shape_.two_sides ? bins_ / 2 : bins_;
        const int from_nadir = is_port(bin) ? side - 1 - bin : bin - (bins_ - side);
        return from_nadir == side - 1 || from_nadir == side - ranges_;
    }

    /// The present pass of an object on one side.
    struct Present {
        std::uint16_t pass = 0;
        std::size_t last = 0;  ///< last ping that saw the object
        BinBox shadow;         ///< shadow since then, which counts if the pass goes on
    };

    /// Numbers the passes from 1 on. `pass_of_pixel_` has the order of object_masks(). Where a row
    /// stands for several pings, it holds the pass of the first ping that shows an object.
    void find_passes() {
        std::array<std::vector<Present>, 2> present;
        present.fill(std::vector<Present>(most_passes));
        pass_of_pixel_.assign(static_cast<std::size_t>(bins_) * rows_, 0);
        RecordValues values(1, bins_);
        for (std::size_t ping = 0; ping < pings_; ++ping) {
            source_.read(ping, 1, 0, values);
            for (int bin = 0; bin < bins_; ++bin) {
                const std::uint16_t id = values.object[bin];
                if (id == 0) continue;
                Present& one = present[is_port(bin) ? 1 : 0][id];
                see(id, ping, bin, values.visible_share[bin], one);
                const std::size_t at = shape_.upright
                                           ? ping / each_ * bins_ + bin
                                           : static_cast<std::size_t>(bin) * rows_ + ping / each_;
                if (pass_of_pixel_[at] == 0) pass_of_pixel_[at] = one.pass;
            }
            for (int bin = 0; bin < bins_; ++bin) {
                const std::uint16_t id = values.shadow[bin];
                Present& one = present[is_port(bin) ? 1 : 0][id];
                if (id == 0 || one.pass == 0) continue;
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
        SeenObject& pass = passes_[one.pass];
        if (!one.shadow.is_empty()) {
            pass.shadow.extend(one.shadow.first_line, one.shadow.first_bin);
            pass.shadow.extend(one.shadow.last_line, one.shadow.last_bin);
            one.shadow = {};
        }
        one.last = ping;
        pass.add(static_cast<int>(ping), bin, range_m_[bin], share);
    }

    /// Finds the other facts of a pass.
    void complete(SeenObject& pass) const {
        const BinBox& box = pass.box;
        const bool port = is_port(box.first_bin);
        pass.pings = {box.first_line, box.last_line + 1};
        pass.clipped = is_edge(box.first_bin) || is_edge(box.last_bin) || box.first_line == 0 ||
                       pass.pings.second == pings_;
        if (shape_.two_sides) pass.side = port ? "port" : "starboard";
        if (source_.is_background(pass.id)) return;
        if (shape_.two_sides) pass.bearing_deg = port ? -90.0 : 90.0;
        add_contrasts_of(pass);
        const BinBox& shadow = pass.shadow;
        if (shadow.is_empty()) return;
        const auto each = static_cast<int>(each_);
        const int first = shadow.first_line / each;
        const int end = shadow.last_line / each + 1;
        pass.shadow_px = shape_.upright
                             ? PixelBox{first, end, shadow.first_bin, shadow.last_bin + 1}
                             : PixelBox{shadow.first_bin, shadow.last_bin + 1, first, end};
    }

    /// The beginning of a longer pass represents the whole pass.
    void add_contrasts_of(SeenObject& pass) const {
        constexpr int most_pings = 1024;
        BinBox box = pass.box;
        const int pings = std::min(box.last_line - box.first_line + 1, most_pings);
        const int margin = std::max(pings, 2);
        const int first = std::max(box.first_line - margin, 0);
        const int end = std::min(box.first_line + pings + margin, static_cast<int>(pings_));
        RecordValues values(end - first, bins_);
        source_.read(first, end - first, 0, values);
        box.first_line -= first;
        box.last_line = box.first_line + pings - 1;
        const bool port = is_port(box.first_bin);
        const int middle = shape_.two_sides ? bins_ / 2 : 0;
        const BinBox side{box.first_line, box.last_line, port ? 0 : middle,
                          port ? middle - 1 : bins_ - 1};
        source_.add_contrasts(values, box, side, pass);
    }

    ObjectRecords source_;
    const RecordShape& shape_;
    std::size_t pings_;
    int ranges_;                          ///< range bins of a side
    int bins_;                            ///< values per ping
    std::size_t each_;                    ///< pings per row
    std::size_t rows_;                    ///< rows or columns of pings
    std::vector<double> range_m_;         ///< range of each value of a ping
    std::vector<SeenObject> passes_{{}};  ///< indexed by number
    Ids pass_of_pixel_;
};

/// The facts of an object in the display of a sweep.
SeenObject seen_in_sweep(const ObjectRecords& source, const RecordValues& display, std::uint16_t id,
                         const Sonar& whole) {
    SeenObject seen;
    seen.id = id;
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
    const bool at_side =
        !display.full_turn && (box.first_line == 0 || box.last_line + 1 == display.lines);
    seen.clipped = at_side || box.first_bin == 0 || box.last_bin + 1 == display.bins;
    if (source.is_background(id)) return seen;
    seen.bearing_deg = -degrees(arctan2(to_port, ahead));
    source.add_contrasts(display, box, {0, display.lines - 1, 0, display.bins - 1}, seen);
    return seen;
}

/// Writes a file for every sweep of a scanning sonar. A step that an unfinished sweep has not
/// reached shows the sweep before.
void write_sweeps(const WriterContext& context, const std::filesystem::path& folder) {
    const ObjectRecords source(context, folder);
    const SonarConfig& config = context.sonar().config;
    const Sonar whole = whole_scan(context.sonar());
    const FanBins fan = make_fan_bins(whole);
    const auto masks = [&](const Ids& ids) {
        return object_masks(fan_values(fan.by_column, ids, std::uint16_t{0}), fan.frame.height);
    };
    RecordValues display(scan_steps(config), config.range_bins, config.sector_deg >= 360.0);
    const auto write_sweep = [&](std::size_t sweep, std::size_t end) {
        const std::size_t begin = sweep * static_cast<std::size_t>(display.lines);
        const std::vector<ObjectMask> shadows = masks(display.shadow);
        std::vector<Json> objects;
        for (const ObjectMask& mask : masks(display.object)) {
            SeenObject seen =
                seen_in_sweep(source, display, static_cast<std::uint16_t>(mask.id), whole);
            seen.pings = {begin, end};
            const auto shadow = std::ranges::find(shadows, mask.id, &ObjectMask::id);
            if (shadow != shadows.end() && !source.is_background(mask.id))
                seen.shadow_px = {shadow->left, shadow->right, shadow->top, shadow->bottom};
            objects.push_back(source.json(seen, mask));
        }
        write_objects(folder / scan_file_name("objects", sweep, ".json"),
                      {{"picture", scan_file_name("scan", sweep, ".png")},
                       {"width", fan.frame.width},
                       {"height", fan.frame.height},
                       {"pings", end - begin},
                       {"pings_per_pixel", 1}},
                      objects);
    };
    for_each_sweep(
        config, context.pings,
        [&](std::size_t ping, int step) {
            source.read(ping, 1, static_cast<std::size_t>(step), display);
        },
        write_sweep);
}

}  // namespace

void add_record_objects(const WriterContext& context, Writer& writer) {
    constexpr double longest_object = 1000.0;
    const RecordShape& shape = context.kind().record;
    const SonarConfig& config = context.sonar().config;
    const auto objects = static_cast<double>(context.assembly.objects.objects.size());
    // A mask takes at most a byte for a pixel, where ids are as ragged as noise.
    const double bytes = static_cast<double>(shape.values(config) * context.pings) +
                         longest_object * (1.0 + 2.0 * objects);
    const bool is_strip = shape.pictures == RecordPictures::strip;
    const std::size_t sweeps = is_strip ? 0 : scan_sweeps(config, context.pings);
    if (is_strip) writer.outputs.products = {{record_objects_name, bytes}};
    for (std::size_t k = 0; k < sweeps; ++k)
        writer.outputs.products.push_back({scan_file_name("objects", k, ".json"), bytes});
    writer.write_products = [context, is_strip](const RecordFile&,
                                                const std::filesystem::path& folder) {
        if (is_strip)
            Strip(context, folder).write(folder / record_objects_name);
        else
            write_sweeps(context, folder);
    };
}

}  // namespace sonarsim
