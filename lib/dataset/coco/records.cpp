#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "dataset/coco/coco.h"
#include "dataset/coco/file.h"
#include "dataset/coco/seen_in_records.h"
#include "dataset/folded_records.h"
#include "mission/dataset_names.h"
#include "product/object_masks.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// An object that no ping shows for more pings than this begins another pass.
constexpr std::size_t most_unseen = 32;

constexpr std::size_t most_passes = 65536;  // numbers of 16 bits

/// The picture that is made of all pings of a sensor. A row, or column, may stand for several.
struct RecordPicture {
    std::uint64_t id;
    std::size_t sensor;
    std::string file;  ///< relative to the folder of the dataset
    bool is_upright;   ///< pings are columns
    bool two_sides;    ///< port, then starboard
    std::size_t bins;  ///< per ping
    std::size_t rows;  ///< rows or columns of pings

    std::size_t width() const { return is_upright ? rows : bins; }
    std::size_t height() const { return is_upright ? bins : rows; }
    bool is_port(std::size_t bin) const { return two_sides && bin < bins / 2; }
    /// The bins of the side that a bin lies on, or all.
    BinBox side_of(int bin) const {
        const auto all = static_cast<int>(bins);
        const int nadir = all / 2;
        if (!two_sides) return {0, 0, 0, all - 1};
        return bin < nadir ? BinBox{0, 0, 0, nadir - 1} : BinBox{0, 0, nadir, all - 1};
    }
};

std::optional<RecordPicture> picture_of(const SensorLayout& sensor, const Json& described) {
    const Json* const picture = labelled_picture(described, "sensor");
    const PingRecord* const ids = record_of_label(sensor, "instance");
    if (!picture || !ids) return std::nullopt;
    const bool is_upright = ids->format.fortran_order;
    return RecordPicture{.id = 0,
                         .sensor = 0,
                         .file = picture->at("boxes_of"),
                         .is_upright = is_upright,
                         .two_sides = described.contains("waterfall"),
                         .bins = ids->format.shape[is_upright ? 0 : 1],
                         .rows = static_cast<std::size_t>(picture_rows(sensor.pings))};
}

/// The slant range of the middle of each bin.
std::vector<double> ranges_of(const RecordPicture& picture, const Json& described) {
    std::vector<double> range_m;
    if (picture.two_sides) {
        const double column_m = described.at("waterfall").at("column_m");
        const double offset_m = described.at("waterfall").at("offset_m");
        const double nadir = 0.5 * static_cast<double>(picture.bins);
        for (std::size_t bin = 0; bin < picture.bins; ++bin)
            range_m.push_back(std::fabs(static_cast<double>(bin) + 0.5 - nadir) * column_m +
                              offset_m);
        return range_m;
    }
    const auto edges = described.at("range_edges_m").get<std::vector<double>>();
    for (std::size_t bin = 0; bin + 1 < edges.size(); ++bin)
        range_m.push_back(0.5 * (edges[bin] + edges[bin + 1]));
    return range_m;
}

/// The present pass of an object by the sonar, on one side.
struct Passing {
    std::uint16_t number = 0;  ///< number of the pass
    std::size_t last = 0;      ///< last ping that saw the object
};

struct Pass {
    std::uint16_t instance = 0;
    BinBox box;  ///< its bins; lines are pings
};

/// The passes of a picture, numbered from 1 on. `of_pixel` has the order of object_masks(). Where a
/// row stands for several pings, it holds the pass of the first ping that shows an object.
struct Passes {
    std::vector<std::uint16_t> of_pixel;
    std::vector<Pass> list{{}};  ///< indexed by the number of a pass
};

Passes passes_of(const RecordPicture& picture, const AnnotationRecords& records) {
    const std::size_t pings = records.pings();
    Passes out;
    out.of_pixel.resize(picture.bins * picture.rows);
    const std::size_t each = pings_per_row(pings);
    std::array<std::vector<Passing>, 2> passing;
    passing.fill(std::vector<Passing>(most_passes));
    std::vector<std::uint16_t> record(picture.bins);
    for (std::size_t ping = 0; ping < pings; ++ping) {
        records.read_objects(ping, record);
        for (std::size_t bin = 0; bin < picture.bins; ++bin) {
            const std::uint16_t id = record[bin];
            if (id == 0) continue;
            Passing& one = passing[picture.is_port(bin) ? 1 : 0][id];
            const bool is_new = one.number == 0 || ping - one.last > most_unseen;
            if (is_new && out.list.size() < most_passes) {
                one.number = static_cast<std::uint16_t>(out.list.size());
                out.list.push_back({id, {}});
            }
            one.last = ping;
            out.list[one.number].box.extend(static_cast<int>(ping), static_cast<int>(bin));
            const std::size_t row = ping / each;
            std::uint16_t& pixel = out.of_pixel[picture.is_upright ? row * picture.bins + bin
                                                                   : bin * picture.rows + row];
            if (pixel == 0) pixel = one.number;
        }
    }
    return out;
}

/// Facts of all pings of a pass.
struct WholePass {
    ObjectMeans means;
    BinBox shadow;  ///< lines are pings
};

WholePass whole_pass(const RecordPicture& picture, const AnnotationRecords& records,
                     const Pass& pass, std::span<const double> range_m) {
    RecordValues values;
    values.resize(1, static_cast<int>(picture.bins));
    const BinBox side = picture.side_of(pass.box.first_bin);
    WholePass whole;
    for (int ping = pass.box.first_line; ping <= pass.box.last_line; ++ping) {
        records.read(static_cast<std::size_t>(ping), 1, 0, values);
        whole.means.add(values, pass.instance, side, range_m);
        const BinBox own = shadow_box(values, pass.instance, side);
        if (own.is_empty()) continue;
        whole.shadow.extend(ping, own.first_bin);
        whole.shadow.extend(ping, own.last_bin);
    }
    return whole;
}

/// The facts of an object in one pass.
SeenFacts facts_of(const RecordPicture& picture, const AnnotationRecords& records, const Pass& pass,
                   std::span<const double> range_m, std::span<const std::uint8_t> is_background) {
    // For the contrasts the beginning of a longer pass represents the whole pass.
    constexpr int most_pings = 1024;
    const int pings = std::min(pass.box.last_line - pass.box.first_line + 1, most_pings);
    const int margin = std::max(pings, 2);
    const int first = std::max(pass.box.first_line - margin, 0);
    const int end =
        std::min(pass.box.first_line + pings + margin, static_cast<int>(records.pings()));
    RecordValues values;
    values.resize(end - first, static_cast<int>(picture.bins));
    records.read(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first), 0, values);
    BinBox box = pass.box;
    box.first_line -= first;
    box.last_line = box.first_line + pings - 1;
    BinBox within = picture.side_of(box.first_bin);
    within.first_line = box.first_line;
    within.last_line = box.last_line;
    SeenFacts seen =
        seen_in_records(values, pass.instance, box, shadow_box(values, pass.instance, within),
                        range_m, is_background);
    if (picture.two_sides) {
        const bool is_port = picture.is_port(static_cast<std::size_t>(box.first_bin));
        seen.side = is_port ? "port" : "starboard";
        seen.bearing_deg = is_port ? -90.0 : 90.0;
    }
    const WholePass whole = whole_pass(picture, records, pass, range_m);
    whole.means.give_to(seen);
    const BinBox& shadow = whole.shadow;
    if (shadow.is_empty()) return seen;
    const auto each = static_cast<int>(pings_per_row(records.pings()));
    const int top = shadow.first_line / each;
    const int bottom = shadow.last_line / each + 1;
    seen.shadow = picture.is_upright ? PixelBox{top, bottom, shadow.first_bin, shadow.last_bin + 1}
                                     : PixelBox{shadow.first_bin, shadow.last_bin + 1, top, bottom};
    return seen;
}

/// Adds the annotations of a picture; `id` is that of the next one.
void add_annotations(const RecordPicture& picture, const Layout& layout, const Json& description,
                     std::uint64_t& id, CocoFile& out) {
    const std::string file = description_name;
    const Json& labels = description.at("labels");
    const AnnotationRules rules = annotation_rules({labels, file});
    const std::vector<std::uint8_t> is_background = background_ids(labels, rules);
    const std::vector<double> range_m =
        ranges_of(picture, description.at("sensors").at(picture.sensor));
    const AnnotationRecords records(layout, picture.sensor);
    const Passes passes = passes_of(picture, records);
    for (const ObjectMask& mask :
         object_masks(passes.of_pixel, static_cast<int>(picture.height()))) {
        const Pass& pass = passes.list[mask.id];
        const std::uint64_t own_id = id++;
        if (is_background[pass.instance] != 0) continue;
        CocoAnnotation annotation = mask_annotation(mask, picture.width(), picture.height());
        annotation.id = own_id;
        annotation.image_id = picture.id;
        annotation.instance = pass.instance;
        annotation.category = labels.at("instances").at(pass.instance - 1U).at("class");
        annotation.seen = facts_of(picture, records, pass, range_m, is_background);
        if (apply_rules(rules.config, false, annotation)) out.add(annotation_json(annotation));
    }
}

}  // namespace

void write_record_coco(const Layout& layout, const Json& description,
                       const SharedProduct& product) {
    std::uint64_t id = 1;
    for (const SensorLayout& sensor : layout.sensors)
        id += 2 * sensor.pings;
    std::vector<RecordPicture> pictures;
    for (std::size_t i = 0; i < layout.sensors.size(); ++i, ++id) {
        if (auto picture = picture_of(layout.sensors[i], description.at("sensors").at(i))) {
            picture->id = id;
            picture->sensor = i;
            pictures.push_back(*std::move(picture));
        }
    }
    CocoFile out(layout.folder / product.file, description);
    out.begin_list("images");
    for (const RecordPicture& picture : pictures) {
        const SensorLayout& sensor = layout.sensors[picture.sensor];
        out.add({{"id", picture.id},
                 {"file_name", picture.file},
                 {"width", picture.width()},
                 {"height", picture.height()},
                 {"sensor", sensor.name}});
    }
    out.end_list();
    out.begin_list("annotations");
    std::uint64_t annotation_id = id * ids_per_image;
    for (const RecordPicture& picture : pictures)
        add_annotations(picture, layout, description, annotation_id, out);
    out.end_list();
    out.finish();
}

}  // namespace sonarsim
