#include "dataset/coco/scans.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dataset/coco/file.h"
#include "dataset/coco/pings.h"
#include "dataset/record_file.h"
#include "format/coco_counts.h"
#include "product/fan_bins.h"
#include "product/object_masks.h"
#include "product/scan.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// The pictures of a scanning sonar.
struct ScanPictures {
    std::size_t sensor;
    std::vector<std::string> files;  ///< by sweep, in the folder of the sensor
    PingRecord ids;                  ///< of instances
};

std::optional<ScanPictures> scan_pictures(const SensorLayout& sensor, std::size_t index) {
    ScanPictures pictures{index, {}, {}};
    for (const std::string& file : sensor.products) {
        if (file.starts_with("scan_") && file.ends_with(".png")) pictures.files.push_back(file);
    }
    for (const auto& part : sensor.per_ping) {
        const auto* record = std::get_if<PingRecord>(&part);
        if (!record || record->label != "instance" || pictures.files.empty()) continue;
        pictures.ids = *record;
        return pictures;
    }
    return std::nullopt;
}

/// Calls `visit` with the ids of the display, [steps, range bins], at the end of every sweep.
void for_each_sweep(
    const Sonar& sonar, const RecordFile& records,
    const std::function<void(std::size_t sweep, const std::vector<std::uint16_t>& ids)>& visit) {
    const auto bins = static_cast<std::size_t>(sonar.config.range_bins);
    const auto steps = static_cast<std::size_t>(scan_steps(sonar.config));
    std::vector<std::uint16_t> display(steps * bins, 0);
    for (std::size_t ping = 0; ping < records.records(); ++ping) {
        const auto step = static_cast<std::size_t>(scan_step(sonar.config, ping));
        records.read(ping, std::as_writable_bytes(std::span(display).subspan(step * bins, bins)));
        if ((ping + 1) % steps == 0 || ping + 1 == records.records()) visit(ping / steps, display);
    }
}

}  // namespace

void write_scan_coco(const Layout& layout, const Mission& mission, const Json& description,
                     const SharedProduct& product) {
    std::vector<ScanPictures> sensors;
    std::uint64_t first_id = 2 + layout.sensors.size();
    for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
        first_id += 2 * layout.sensors[i].pings;
        if (auto pictures = scan_pictures(layout.sensors[i], i))
            sensors.push_back(*std::move(pictures));
    }
    const auto frame_of = [&](const ScanPictures& pictures) {
        const Sonar sonar =
            make_sonar(mission.sensors[pictures.sensor], mission.accuracy, mission.water);
        return fan_frame(whole_scan(sonar), mission.output.fan_width_px);
    };

    CocoFile out(layout.folder / product.file, description);
    out.begin_list("images");
    std::uint64_t id = first_id;
    for (const ScanPictures& pictures : sensors) {
        const FanFrame frame = frame_of(pictures);
        const std::string& name = layout.sensors[pictures.sensor].name;
        for (const std::string& file : pictures.files) {
            out.add({{"id", id++},
                     {"file_name", name + "/" + file},
                     {"width", frame.width},
                     {"height", frame.height},
                     {"sensor", name}});
        }
    }
    out.end_list();
    out.begin_list("annotations");
    const Json& instances = description.at("labels").at("instances");
    id = first_id;
    for (const ScanPictures& pictures : sensors) {
        const Sonar sonar =
            make_sonar(mission.sensors[pictures.sensor], mission.accuracy, mission.water);
        const FanBins fan = make_fan_bins(whole_scan(sonar), mission.output.fan_width_px);
        const RecordFile records(layout.sensor_folder(pictures.sensor) / pictures.ids.file,
                                 pictures.ids.format, layout.sensors[pictures.sensor].pings,
                                 RecordAccess::read);
        for_each_sweep(sonar, records, [&](std::size_t sweep, const auto& display) {
            const std::vector<std::uint16_t> ids =
                fan_values(fan.by_column, display, std::uint16_t{0});
            for (const ObjectMask& mask : object_masks(ids, fan.frame.height)) {
                const std::uint64_t image_id = id + sweep;
                out.add(
                    annotation_json({.id = image_id * ids_per_image + mask.id,
                                     .image_id = image_id,
                                     .instance = mask.id,
                                     .category = instances.at(mask.id - 1).at("class"),
                                     .left = mask.left,
                                     .top = mask.top,
                                     .width = mask.right - mask.left,
                                     .height = mask.bottom - mask.top,
                                     .area = mask.area,
                                     .image_width = static_cast<std::uint64_t>(fan.frame.width),
                                     .image_height = static_cast<std::uint64_t>(fan.frame.height),
                                     .counts = coco_counts(mask.runs)}));
            }
        });
        id += pictures.files.size();
    }
    out.end_list();
    out.finish();
}

}  // namespace sonarsim
