#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dataset/coco/coco.h"
#include "dataset/coco/file.h"
#include "dataset/file_names.h"
#include "dataset/record_file.h"
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
    PingRecord ids;  ///< the records of instances
    Sonar whole;     ///< with the beams of a whole sweep
};

std::vector<ScanPictures> scan_pictures(const Layout& layout, const Mission& mission,
                                        const Json& description) {
    std::vector<ScanPictures> all;
    for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
        const Json* const picture = labelled_picture(description.at("sensors").at(i), "sweep");
        const PingRecord* const ids = instance_record(layout.sensors[i]);
        if (!picture || !ids) continue;
        const SonarConfig& config = mission.sensors[i];
        all.push_back({i, picture->at("boxes_of"), scan_sweeps(config, layout.sensors[i].pings),
                       *ids, whole_scan(make_sonar(config, mission.accuracy, mission.water))});
    }
    return all;
}

/// Calls `visit` with the ids of the display, [steps, range bins], at the end of every sweep.
void for_each_sweep(
    const SonarConfig& config, const RecordFile& records,
    const std::function<void(std::size_t sweep, const std::vector<std::uint16_t>& ids)>& visit) {
    const auto bins = static_cast<std::size_t>(config.range_bins);
    const auto steps = static_cast<std::size_t>(scan_steps(config));
    std::vector<std::uint16_t> display(steps * bins, 0);
    for (std::size_t ping = 0; ping < records.records(); ++ping) {
        const auto step = static_cast<std::size_t>(scan_step(config, ping));
        records.read(ping, std::as_writable_bytes(std::span(display).subspan(step * bins, bins)));
        if ((ping + 1) % steps == 0 || ping + 1 == records.records()) visit(ping / steps, display);
    }
}

}  // namespace

void write_scan_coco(const Layout& layout, const Mission& mission, const Json& description,
                     const SharedProduct& product) {
    const std::vector<ScanPictures> sensors = scan_pictures(layout, mission, description);
    std::uint64_t first_id = 2 + layout.sensors.size();
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
    const Json& instances = description.at("labels").at("instances");
    id = first_id;
    for (const ScanPictures& pictures : sensors) {
        const FanBins fan = make_fan_bins(pictures.whole, mission.output.fan_width_px);
        const RecordFile records(layout.sensor_folder(pictures.sensor) / pictures.ids.file,
                                 pictures.ids.format, layout.sensors[pictures.sensor].pings,
                                 RecordAccess::read);
        for_each_sweep(pictures.whole.config, records, [&](std::size_t sweep, const auto& display) {
            const std::vector<std::uint16_t> ids =
                fan_values(fan.by_column, display, std::uint16_t{0});
            for (const ObjectMask& mask : object_masks(ids, fan.frame.height)) {
                CocoAnnotation annotation =
                    mask_annotation(mask, fan.frame.width, fan.frame.height);
                annotation.image_id = id + sweep;
                annotation.id = annotation.image_id * ids_per_image + mask.id;
                annotation.instance = mask.id;
                annotation.category = instances.at(mask.id - 1).at("class");
                out.add(annotation_json(annotation));
            }
        });
        id += pictures.sweeps;
    }
    out.end_list();
    out.finish();
}

}  // namespace sonarsim
