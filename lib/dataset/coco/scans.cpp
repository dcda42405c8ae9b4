#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/elementary.h"
#include "core/units.h"
#include "dataset/coco/coco.h"
#include "dataset/coco/file.h"
#include "dataset/coco/seen_in_records.h"
#include "dataset/file_names.h"
#include "mission/dataset_names.h"
#include "product/fan_bins.h"
#include "product/object_masks.h"
#include "product/scan.h"
#include "sonar/sonar.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// The pictures of a scanning sonar.
struct ScanPictures {
    std::size_t sensor;
    std::string pattern;  ///< file names by the number of the sweep
    std::uint64_t sweeps;
    Sonar whole;  ///< with the beams of a whole sweep
};

std::vector<ScanPictures> scan_pictures(const Layout& layout, const Mission& mission,
                                        const Json& description) {
    std::vector<ScanPictures> all;
    for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
        const Json* const picture = labelled_picture(description.at("sensors").at(i), "sweep");
        if (!picture || !record_of_label(layout.sensors[i], "instance")) continue;
        const SonarConfig& config = mission.sensors[i];
        all.push_back({i, picture->at("boxes_of"), scan_sweeps(config, layout.sensors[i].pings),
                       whole_scan(make_sonar(config, mission.accuracy, mission.water))});
    }
    return all;
}

/// Calls `visit` with the values of the display, [steps, range bins], at the end of every sweep.
void for_each_sweep(
    const SonarConfig& config, const AnnotationRecords& records,
    const std::function<void(std::size_t sweep, const RecordValues& values)>& visit) {
    const auto steps = static_cast<std::size_t>(scan_steps(config));
    RecordValues display;
    display.resize(scan_steps(config), config.range_bins);
    display.full_turn = config.sector_deg >= 360.0;
    for (std::size_t ping = 0; ping < records.pings(); ++ping) {
        const auto step = static_cast<std::size_t>(scan_step(config, ping));
        records.read(ping, 1, step, display);
        if ((ping + 1) % steps == 0 || ping + 1 == records.pings()) visit(ping / steps, display);
    }
}

/// The bins of an object, and the mean of the directions to them, deg to starboard.
struct BinsInScan {
    BinBox box;
    double bearing_deg = 0.0;
};

BinsInScan bins_in_scan(const RecordValues& display, std::uint16_t id, const Sonar& whole) {
    BinsInScan found;
    double ahead = 0.0;
    double to_port = 0.0;
    for (int step = 0; step < display.lines; ++step) {
        const SinCos at =
            sincos(0.5 * (whole.azimuth_edges_rad[step] + whole.azimuth_edges_rad[step + 1]));
        for (int bin = 0; bin < display.bins; ++bin) {
            if (display.object[static_cast<std::size_t>(step) * display.bins + bin] != id) continue;
            found.box.extend(step, bin);
            ahead += at.cos;
            to_port += at.sin;
        }
    }
    found.bearing_deg = -degrees(arctan2(to_port, ahead));
    return found;
}

/// Adds the annotations of the sweeps of a sensor; the first has the id `first_id`.
void add_annotations(const ScanPictures& pictures, const Layout& layout, const Mission& mission,
                     const Json& labels, std::uint64_t first_id, CocoFile& out) {
    const std::string file = description_name;
    const AnnotationRules rules = annotation_rules({labels, file});
    const std::vector<std::uint8_t> is_background = background_ids(labels, rules);
    const FanBins fan = make_fan_bins(pictures.whole, mission.output.fan_width_px);
    const std::vector<double>& edges_m = pictures.whole.range_edges_m;
    std::vector<double> range_m;
    for (std::size_t bin = 0; bin + 1 < edges_m.size(); ++bin)
        range_m.push_back(0.5 * (edges_m[bin] + edges_m[bin + 1]));
    const AnnotationRecords records(layout, pictures.sensor);
    for_each_sweep(pictures.whole.config, records, [&](std::size_t sweep, const auto& display) {
        const auto masks = [&](const std::vector<std::uint16_t>& ids) {
            if (ids.empty()) return std::vector<ObjectMask>();
            return object_masks(fan_values(fan.by_column, ids, std::uint16_t{0}), fan.frame.height);
        };
        const std::vector<ObjectMask> shadows = masks(display.shadow);
        const BinBox all{0, display.lines - 1, 0, display.bins - 1};
        for (const ObjectMask& mask : masks(display.object)) {
            if (is_background[mask.id] != 0) continue;
            const auto id = static_cast<std::uint16_t>(mask.id);
            CocoAnnotation annotation = mask_annotation(mask, fan.frame.width, fan.frame.height);
            annotation.image_id = first_id + sweep;
            annotation.id = annotation.image_id * ids_per_image + mask.id;
            annotation.instance = mask.id;
            annotation.category = labels.at("instances").at(mask.id - 1).at("class");
            const BinsInScan bins = bins_in_scan(display, id, pictures.whole);
            annotation.seen = seen_in_records(display, id, bins.box, shadow_box(display, id, all),
                                              range_m, is_background);
            annotation.seen.bearing_deg = bins.bearing_deg;
            const auto shadow = std::ranges::find(shadows, mask.id, &ObjectMask::id);
            if (shadow != shadows.end())
                annotation.seen.shadow =
                    PixelBox{shadow->left, shadow->right, shadow->top, shadow->bottom};
            if (apply_rules(rules.config, false, annotation)) out.add(annotation_json(annotation));
        }
    });
}

}  // namespace

void write_scan_coco(const Layout& layout, const Mission& mission, const Json& description,
                     const SharedProduct& product) {
    const std::vector<ScanPictures> sensors = scan_pictures(layout, mission, description);
    // A picture of write_record_coco() takes an id for itself, and the ids of annotations of
    // another.
    std::uint64_t first_id = 1 + 2 * layout.sensors.size();
    for (const SensorLayout& sensor : layout.sensors)
        first_id += 2 * sensor.pings;
    CocoFile out(layout.folder / product.file, description);
    out.begin_list("images");
    std::uint64_t id = first_id;
    for (const ScanPictures& pictures : sensors) {
        const FanFrame frame = fan_frame(pictures.whole, mission.output.fan_width_px);
        for (std::uint64_t sweep = 0; sweep < pictures.sweeps; ++sweep) {
            out.add({{"id", id++},
                     {"file_name", numbered(pictures.pattern, sweep)},
                     {"width", frame.width},
                     {"height", frame.height},
                     {"sensor", layout.sensors[pictures.sensor].name}});
        }
    }
    out.end_list();
    out.begin_list("annotations");
    id = first_id;
    for (const ScanPictures& pictures : sensors) {
        add_annotations(pictures, layout, mission, description.at("labels"), id, out);
        id += pictures.sweeps;
    }
    out.end_list();
    out.finish();
}

}  // namespace sonarsim
