#include "dataset/record_objects.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/error.h"
#include "core/units.h"
#include "dataset/averaged_rows.h"
#include "dataset/object_records.h"
#include "mission/dataset_names.h"
#include "product/fan_bins.h"
#include "product/object_masks.h"
#include "product/scan.h"
#include "sonar/sonar.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_unseen = 32;     ///< pings; see the header
constexpr std::size_t most_passes = 65536;  // numbers of 16 bits

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
            objects.push_back(passes_[mask.id].json(source_, mask));
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
        const int from_nadir =
            is_port(bin) ? bins_ / 2 - 1 - bin : bin - (two_sides_ ? bins_ / 2 : 0);
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
        RecordValues values(1, bins_);
        for (std::size_t ping = 0; ping < source_.pings(); ++ping) {
            source_.read(ping, 1, 0, values);
            for (int bin = 0; bin < bins_; ++bin) {
                const std::uint16_t id = values.object[bin];
                if (id == 0) continue;
                Present& one = present[is_port(bin) ? 1 : 0][id];
                see(id, ping, bin, values.visible_share[bin], one);
                const std::size_t at = is_upright_
                                           ? ping / each * bins_ + bin
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
    void add_contrasts_of(SeenObject& pass) const {
        constexpr int most_pings = 1024;
        BinBox box = pass.box;
        const int pings = std::min(box.last_line - box.first_line + 1, most_pings);
        const int margin = std::max(pings, 2);
        const int first = std::max(box.first_line - margin, 0);
        const int end =
            std::min(box.first_line + pings + margin, static_cast<int>(source_.pings()));
        RecordValues values(end - first, bins_);
        source_.read(first, end - first, 0, values);
        box.first_line -= first;
        box.last_line = box.first_line + pings - 1;
        BinBox within = side_of(box.first_bin);
        within.first_line = box.first_line;
        within.last_line = box.last_line;
        pass.add_contrasts(source_, values, box, values.shadow_box(pass.id, within));
    }

    ObjectRecords source_;
    bool is_upright_;                     ///< pings are columns
    bool two_sides_;                      ///< port, then starboard
    int ranges_;                          ///< range bins of a side
    int bins_ = 0;                        ///< values per ping
    std::size_t rows_;                    ///< rows or columns of pings
    std::vector<double> range_m_;         ///< range of each value of a ping
    std::vector<SeenObject> passes_{{}};  ///< indexed by number
    std::vector<std::uint16_t> of_pixel_;
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
    if (source.is_background[id] != 0) return seen;
    seen.bearing_deg = -degrees(arctan2(to_port, ahead));
    const BinBox all{0, display.lines - 1, 0, display.bins - 1};
    seen.add_contrasts(source, display, box, display.shadow_box(id, all));
    return seen;
}

/// Writes a file for every sweep of a scanning sonar. A step that an unfinished sweep has not
/// reached shows the sweep before.
void write_sweeps(const Layout& layout, const Mission& mission, std::size_t sensor,
                  const Json& description) {
    const ObjectRecords source(layout, sensor, description);
    const SonarConfig& config = mission.sensors[sensor];
    const Sonar whole = whole_scan(make_sonar(config, mission.accuracy, mission.water));
    const FanBins fan = make_fan_bins(whole, mission.output.fan_width_px);
    const auto masks = [&](const std::vector<std::uint16_t>& ids) {
        return object_masks(fan_values(fan.by_column, ids, std::uint16_t{0}), fan.frame.height);
    };
    const auto steps = static_cast<std::size_t>(scan_steps(config));
    RecordValues display(scan_steps(config), config.range_bins, config.sector_deg >= 360.0);
    for (std::size_t ping = 0; ping < source.pings(); ++ping) {
        source.read(ping, 1, static_cast<std::size_t>(scan_step(config, ping)), display);
        if ((ping + 1) % steps != 0 && ping + 1 != source.pings()) continue;
        const std::size_t sweep = ping / steps;
        const std::vector<ObjectMask> shadows = masks(display.shadow);
        std::vector<Json> objects;
        for (const ObjectMask& mask : masks(display.object)) {
            SeenObject seen =
                seen_in_sweep(source, display, static_cast<std::uint16_t>(mask.id), whole);
            seen.pings = {sweep * steps, ping + 1};
            const auto shadow = std::ranges::find(shadows, mask.id, &ObjectMask::id);
            if (shadow != shadows.end() && source.is_background[mask.id] == 0)
                seen.shadow_px = PixelBox{shadow->left, shadow->right, shadow->top, shadow->bottom};
            objects.push_back(seen.json(source, mask));
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
} catch (const Json::exception&) {  // somebody else made the part
    throw InputError({(layout.folder / description_name).string()},
                     "has labels that do not fit the records; render the dataset anew");
}

}  // namespace sonarsim
