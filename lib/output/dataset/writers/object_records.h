#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "output/dataset/json.h"
#include "output/dataset/writer.h"
#include "simulate/labels/silhouette.h"
#include "simulate/product/contrast.h"
#include "simulate/product/object_table.h"

namespace sonarsim {

/// The values of successive pings, [lines, bins].
struct RecordValues {
    RecordValues(int line_count, int bin_count, bool is_full_turn = false)
        : lines(line_count),
          bins(bin_count),
          full_turn(is_full_turn),
          object(static_cast<std::size_t>(lines) * bins),
          shadow(object.size()),
          visible_share(object.size()),
          level(object.size()) {}

    int lines, bins;
    bool full_turn;  ///< the last line is next to the first
    std::vector<std::uint16_t> object, shadow;
    std::vector<std::uint16_t> visible_share;  ///< 65535 is all of the object, 0: not known
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

/// The records of a sonar that its objects are found in.
class ObjectRecords {
  public:
    ObjectRecords(const WriterContext& context, const std::filesystem::path& folder)
        : has_shadow(shadow_ids(context.assembly.objects)),
          context_(context),
          object_(
              open(folder,
                   context.mission.labels.mask == MaskKind::echo ? "instance" : silhouette_record,
                   "<u2")),
          shadow_(open(folder, object_shadow_record, "<u2")),
          visible_share_(open(folder, visible_share_record, "<u2")),
          level_(open(folder, context.kind().record.name, "<f4")),
          is_background_(background_ids(context.assembly.objects)) {
        for (int k = 0; k < context.sonar().settings.view.range_bins; ++k)
            range_m.push_back(context.sonar().middle_m(k));
    }

    /// The ids, or passes of objects, of a picture as their masks.
    std::vector<std::uint16_t> drawn(const MaskFrame& frame,
                                     const std::vector<std::uint16_t>& ids) const {
        return context_.mission.labels.mask == MaskKind::echo ? ids : outlined(frame, ids);
    }
    const ResolutionCell& cell() const { return context_.sonar().settings.model->info.cell; }
    /// The ids of a picture with the shadows of those whose masks include them.
    std::vector<std::uint16_t> shadowed(const MaskFrame& frame, const RecordValues& values,
                                        const std::vector<std::uint16_t>& ids) const {
        const LevelMap map = map_of(values);
        return with_shadows(frame, ids, visible_shadows(map, has_shadow, is_background_),
                            has_shadow);
    }

    /// Reads `count` pings from `first` on into the lines from `line` on, without background.
    void read(std::size_t first, std::size_t count, std::size_t line, RecordValues& values) const {
        const auto bins = static_cast<std::size_t>(values.bins);
        const auto read_one = [&](const RecordFile& file, auto& all) {
            file.read(first,
                      std::as_writable_bytes(std::span(all).subspan(line * bins, count * bins)));
        };
        read_one(object_, values.object);
        for (std::uint16_t& id : std::span(values.object).subspan(line * bins, count * bins))
            id = is_background_[id] != 0 ? 0 : id;
        read_one(shadow_, values.shadow);
        read_one(visible_share_, values.visible_share);
        read_one(level_, values.level);
    }

    /// Compares the object in `own` and its shadow within `around` with their surroundings.
    void add_contrasts(const RecordValues& values, const BinBox& own, const BinBox& around,
                       SeenObject& visible) const {
        const LevelMap map = map_of(values);
        visible.contrast_db = contrast_db(map, map.object, visible.id, own, is_background_);
        BinBox shadow;
        for (int line = around.first_line; line <= around.last_line; ++line) {
            for (int bin = around.first_bin; bin <= around.last_bin; ++bin) {
                if (map.shadow[static_cast<std::size_t>(line) * values.bins + bin] == visible.id)
                    shadow.extend(line, bin);
            }
        }
        if (!shadow.is_empty())
            visible.shadow_contrast_db =
                contrast_db(map, map.shadow, visible.id, shadow, is_background_);
    }

    Json json(const SeenObject& visible, const ObjectMask& mask) const {
        const auto mean = [&](double sum, int count) -> std::optional<double> {
            if (count == 0) return std::nullopt;
            return sum / count;
        };
        constexpr double whole = 65535.0;
        const SceneObjects& objects = context_.assembly.objects;
        const SceneObjects::Object& object = objects.objects.at(visible.id - 1U);
        Json json = {{"id", visible.id},
                     {"name", object.name},
                     {"class", objects.classes[object.class_index]}};
        if (visible.side) json["side"] = visible.side;
        json["pings"] = {visible.pings.first, visible.pings.second};
        json["box_px"] = describe_box({mask.left, mask.right, mask.top, mask.bottom});
        json["area_px"] = mask.area;
        json["mask"] = coco_counts(mask.runs);
        json["range_m"] = rounded(mean(visible.range_m, visible.bins), 1e3);
        json["bearing_deg"] = rounded(visible.bearing_deg, 1e2);
        json["contrast_db"] = rounded(visible.contrast_db, 1e2);
        json["visible_share"] =
            rounded(mean(visible.visible_share / whole, visible.bins_with_share), 1e4);
        if (!visible.shadow_px.is_empty()) json["shadow_box_px"] = describe_box(visible.shadow_px);
        json["shadow_contrast_db"] = rounded(visible.shadow_contrast_db, 1e2);
        json["clipped"] = visible.clipped;
        return json;
    }

    std::vector<double> range_m;           ///< middle of each range bin
    std::vector<std::uint8_t> has_shadow;  ///< 1 for the ids whose masks include the shadow

  private:
    static LevelMap map_of(const RecordValues& values) {
        return {values.lines,  values.bins,  values.object,
                values.shadow, values.level, values.full_turn};
    }

    RecordFile open(const std::filesystem::path& folder, std::string_view stem,
                    const char* type) const {
        const PingRecord record = record_of_kind(context_, std::string(stem), type);
        return {folder / record.file, record.format, context_.pings, RecordAccess::read};
    }

    const WriterContext& context_;
    RecordFile object_, shadow_, visible_share_, level_;
    std::vector<std::uint8_t> is_background_;  ///< indexed by id
};

}  // namespace sonarsim
