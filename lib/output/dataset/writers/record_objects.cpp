#include "core/elementary.h"
#include "core/file.h"
#include "core/units.h"
#include "output/dataset/strip_rows.h"
#include "output/dataset/writers/object_records.h"
#include "simulate/product/fan.h"
#include "simulate/product/scan.h"
#include "simulate/product/sidescan.h"

namespace sonarsim {

namespace {

using Ids = std::vector<std::uint16_t>;

constexpr std::size_t max_missed = 32;     // pings between two of one pass
constexpr std::size_t max_passes = 65536;  // numbers of 16 bits

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
        const auto every = static_cast<std::size_t>(context.sonar().config.every);
        for (std::size_t ping = 0; ping < pings_; ++ping) {
            const Pose& vehicle = context.assembly.trajectory[ping * every].T_world_vehicle;
            bows_.emplace_back(vehicle.rotation * Eigen::Vector3d::UnitX());
        }
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
        const double range_bins = source_.cell().range_bins;
        const ResolutionCell cell =
            shape_.upright ? ResolutionCell{range_bins, 1.0} : ResolutionCell{1.0, range_bins};
        pass_of_pixel_ =
            source_.drawn({static_cast<int>(across), static_cast<int>(down), cell}, pass_of_pixel_);
        add_shadows();
        std::vector<Json> objects;
        for (const ObjectMask& mask : object_masks(pass_of_pixel_, static_cast<int>(down))) {
            SeenObject& pass = passes_[mask.id];
            complete(pass);
            pass.clipped = pass.clipped || mask.left == 0 || mask.top == 0 ||
                           mask.right == static_cast<int>(across) ||
                           mask.bottom == static_cast<int>(down);
            objects.push_back(source_.json(pass, mask));
        }
        const Json head{{"picture", std::string(shape_.name) + ".png"},
                        {"width", across},
                        {"height", down},
                        {"pings", pings_},
                        {"pings_per_pixel", each_}};
        write_file(path, objects_text(head, objects));
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
        BinBox shadow;         ///< shadow before a pass, which counts if one begins
    };

    /// True if one pass may hold both pings: few lie between them, and the vehicle has not turned.
    bool joins(std::size_t ping, std::size_t later) const {
        return later - ping <= max_missed && bows_[ping].dot(bows_[later]) > 0.0;
    }

    /// Numbers the passes from 1 on. `pass_of_pixel_` has the order of object_masks(). Where a row
    /// stands for several pings, it holds the pass of the first ping that shows an object.
    void find_passes() {
        std::array<std::vector<Present>, 2> present;
        present.fill(std::vector<Present>(max_passes));
        pass_of_pixel_.assign(static_cast<std::size_t>(bins_) * rows_, 0);
        shadow_of_pixel_ = pass_of_pixel_;
        RecordValues values(1, bins_);
        for (std::size_t ping = 0; ping < pings_; ++ping) {
            source_.read(ping, 1, 0, values);
            for (int bin = 0; bin < bins_; ++bin) {
                const std::uint16_t id = values.object[bin];
                if (id == 0) continue;
                Present& one = present[is_port(bin) ? 1 : 0][id];
                see(id, ping, bin, values.visible_share[bin], one);
                draw(ping, bin, one.pass, pass_of_pixel_);
            }
            for (int bin = 0; bin < bins_; ++bin) {
                const std::uint16_t id = values.shadow[bin];
                if (id == 0) continue;
                Present& one = present[is_port(bin) ? 1 : 0][id];
                const bool in_pass = one.pass != 0 && joins(one.last, ping);
                if (source_.has_shadow[id] != 0 && in_pass && one.last == ping)
                    draw(ping, bin, one.pass, shadow_of_pixel_);
                if (!in_pass && !goes_on(one.shadow, ping)) one.shadow = {};
                BinBox& box = in_pass ? passes_[one.pass].shadow : one.shadow;
                box.extend(static_cast<int>(ping), bin);
            }
        }
    }

    /// Adds the shadows of the passes that have pixels to their masks.
    void add_shadows() {
        std::vector<std::uint8_t> has_pixels(max_passes, 0);
        for (const std::uint16_t pass : pass_of_pixel_)
            has_pixels[pass] = 1;
        for (std::size_t k = 0; k < pass_of_pixel_.size(); ++k) {
            const std::uint16_t pass = shadow_of_pixel_[k];
            if (pass_of_pixel_[k] == 0 && has_pixels[pass] != 0) pass_of_pixel_[k] = pass;
        }
    }

    bool goes_on(const BinBox& shadow, std::size_t ping) const {
        return !shadow.is_empty() && joins(static_cast<std::size_t>(shadow.last_line), ping);
    }

    void draw(std::size_t ping, int bin, std::uint16_t pass, Ids& picture) const {
        const std::size_t at = shape_.upright
                                   ? ping / each_ * bins_ + bin
                                   : static_cast<std::size_t>(bin) * rows_ + ping / each_;
        if (picture[at] == 0) picture[at] = pass;
    }

    void see(std::uint16_t id, std::size_t ping, int bin, std::uint16_t share, Present& one) {
        const bool is_new = one.pass == 0 || !joins(one.last, ping);
        if (is_new && passes_.size() < max_passes) {
            one.pass = static_cast<std::uint16_t>(passes_.size());
            SeenObject& pass = passes_.emplace_back();
            pass.id = id;
            if (goes_on(one.shadow, ping)) pass.shadow = one.shadow;
        }
        SeenObject& pass = passes_[one.pass];
        one.shadow = {};
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
        constexpr int max_pings = 1024;
        BinBox box = pass.box;
        const int pings = std::min(box.last_line - box.first_line + 1, max_pings);
        const int margin = std::max(pings, 2);
        const int first = std::max(box.first_line - margin, 0);
        const int end = std::min(box.first_line + pings + margin, static_cast<int>(pings_));
        RecordValues values(end - first, bins_);
        source_.read(first, end - first, 0, values);
        box.first_line -= first;
        box.last_line = box.first_line + pings - 1;
        const bool port = is_port(box.first_bin);
        const int middle = shape_.two_sides ? bins_ / 2 : 0;
        const auto line = [&](int k) { return std::clamp(k - first, 0, values.lines - 1); };
        const BinBox side{line(pass.shadow.first_line), line(pass.shadow.last_line),
                          port ? 0 : middle, port ? middle - 1 : bins_ - 1};
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
    std::vector<Eigen::Vector3d> bows_;   ///< the vehicle's, by ping, world
    std::vector<SeenObject> passes_{{}};  ///< indexed by number
    Ids pass_of_pixel_;                   ///< objects
    Ids shadow_of_pixel_;                 ///< shadows that masks include
};

/// The facts of an object in the display of a sweep.
SeenObject visible_in_sweep(const ObjectRecords& source, const RecordValues& display,
                            std::uint16_t id, const Sonar& whole) {
    SeenObject visible;
    visible.id = id;
    double ahead = 0.0;
    double to_port = 0.0;
    for (int step = 0; step < display.lines; ++step) {
        const SinCos at =
            sincos(0.5 * (whole.azimuth_edges_rad[step] + whole.azimuth_edges_rad[step + 1]));
        for (int bin = 0; bin < display.bins; ++bin) {
            const std::size_t k = static_cast<std::size_t>(step) * display.bins + bin;
            if (display.object[k] != id) continue;
            visible.add(step, bin, source.range_m[bin], display.visible_share[k]);
            ahead += at.cos;
            to_port += at.sin;
        }
    }
    const BinBox& box = visible.box;
    visible.bearing_deg = -degrees(arctan2(to_port, ahead));
    source.add_contrasts(display, box, {0, display.lines - 1, 0, display.bins - 1}, visible);
    return visible;
}

/// True if the mask of an object touches the border of a sweep.
bool touches_edge(const RecordValues& display, const Ids& ids, std::uint32_t id) {
    BinBox box;
    for (int k = 0; k < std::ssize(ids); ++k) {
        if (ids[k] == id) box.extend(k / display.bins, k % display.bins);
    }
    const bool at_side = box.first_line == 0 || box.last_line + 1 == display.lines;
    return box.first_bin == 0 || box.last_bin + 1 == display.bins ||
           (at_side && !display.full_turn);
}

/// The first ping of a sweep that shows an object, and the one after the last.
std::pair<std::size_t, std::size_t> pings_of(std::uint32_t id, const RecordValues& drawn,
                                             const SonarConfig& config, std::size_t begin,
                                             std::size_t end) {
    const auto shows = [&](std::size_t ping) {
        const auto line = static_cast<std::size_t>(scan_step(config, ping));
        const auto own = std::span(drawn.object).subspan(line * drawn.bins, drawn.bins);
        return std::ranges::count(own, id) > 0;
    };
    while (begin < end && !shows(begin))
        ++begin;
    while (begin < end && !shows(end - 1))
        --end;
    return {begin, end};
}

/// Writes a file for every sweep.
void write_sweeps(const WriterContext& context, const std::filesystem::path& folder) {
    const ObjectRecords source(context, folder);
    const SonarConfig& config = context.sonar().config;
    const Sonar whole = whole_scan(context.sonar());
    const std::shared_ptr<const FanBins> fan = context.assembly.fans->bins(whole);
    const auto masks = [&](const Ids& ids) {
        return object_masks(fan_values(fan->by_column, ids, std::uint16_t{0}), fan->frame.height);
    };
    const auto write_sweep = [&](std::size_t sweep, std::size_t begin, std::size_t end) {
        RecordValues display(scan_steps(config), config.range_bins, config.sector_deg >= 360.0);
        for (std::size_t ping = begin; ping < end; ++ping)
            source.read(ping, 1, static_cast<std::size_t>(scan_step(config, ping)), display);
        const std::vector<ObjectMask> shadows = masks(display.shadow);
        RecordValues drawn = display;
        const MaskFrame frame = frame_of(whole.settings.view, source.cell());
        drawn.object = source.drawn(frame, display.object);
        const Ids mask_ids = source.shadowed(frame, display, drawn.object);
        std::vector<Json> objects;
        for (const ObjectMask& mask : masks(mask_ids)) {
            SeenObject visible =
                visible_in_sweep(source, drawn, static_cast<std::uint16_t>(mask.id), whole);
            visible.pings = pings_of(mask.id, drawn, config, begin, end);
            visible.clipped = touches_edge(display, mask_ids, mask.id);
            const auto shadow = std::ranges::find(shadows, mask.id, &ObjectMask::id);
            if (shadow != shadows.end())
                visible.shadow_px = {shadow->left, shadow->right, shadow->top, shadow->bottom};
            objects.push_back(source.json(visible, mask));
        }
        const Json head{{"picture", scan_file_name("scan", sweep, ".png")},
                        {"width", fan->frame.width},
                        {"height", fan->frame.height},
                        {"pings", end - begin},
                        {"pings_per_pixel", 1}};
        write_file(folder / scan_file_name("objects", sweep, ".json"), objects_text(head, objects));
    };
    for_each_sweep(config, context.pings, write_sweep);
}

}  // namespace

void add_record_objects(const WriterContext& context, Writer& writer) {
    const bool is_strip = context.kind().record.pictures == RecordPictures::strip;
    writer.products = is_strip ? std::vector<std::string>{record_objects_name}
                               : sweep_files(context, "objects", {".json"});
    writer.write_products = [context, is_strip](const RecordFile&,
                                                const std::filesystem::path& folder) {
        if (is_strip)
            Strip(context, folder).write(folder / record_objects_name);
        else
            write_sweeps(context, folder);
    };
}

}  // namespace sonarsim
