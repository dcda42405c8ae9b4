#include "simulate/product/scan.h"

#include "core/file.h"
#include "output/dataset/writer.h"
#include "simulate/product/fan.h"

namespace sonarsim {

namespace {

void write_displays(const WriterContext& context, const std::shared_ptr<const FanMap>& map,
                    const RecordFile& records, const std::filesystem::path& folder) {
    const std::string stem(context.kind().record.name);
    std::vector<float> bins(context.sonar().config.range_bins);
    for_each_sweep(context.sonar().config, context.pings,
                   [&](std::size_t sweep, std::size_t begin, std::size_t end) {
                       ScanDisplay display(context.sonar());
                       for (std::size_t ping = begin; ping < end; ++ping) {
                           records.read(ping, std::as_writable_bytes(std::span(bins)));
                           display.show(ping, bins);
                       }
                       const Ping& image = display.image();
                       write_file(folder / scan_file_name(stem, sweep, ".npy"),
                                  npy_bytes(image.intensity, image.range_bins, image.beams));
                       write_file(folder / scan_file_name(stem, sweep, ".png"),
                                  png_bytes(display_fan(*map, *context.sonar().settings.model,
                                                        image, context.full_scale()),
                                            map->frame.width, map->frame.height));
                   });
}

}  // namespace

/// scan.npy: float32 [ping, range]. The display of each sweep of the head, with 0 where the
/// last one has no ping: scan_NNNN.npy, float32 [range, step]; scan_NNNN.png, 8 bits, boresight up.
Writer make_scan_writer(const WriterContext& context) {
    const std::string stem(context.kind().record.name);
    const auto map = context.assembly.fans->map(whole_scan(context.sonar()));
    const auto describe = [=](Json& sensor) {
        const Sonar& sonar = context.sonar();
        if (context.kind().record.describe) context.kind().record.describe(sonar, sensor);
        const std::string file = sonar.config.name + "/" + stem + "_%04d.png";
        sensor["pictures"].push_back({{"title", stem},
                                      {"file", file},
                                      {"per", "sweep"},
                                      {"boxes_of", file},
                                      {"pings", scan_steps(sonar.config)},
                                      {"radius_px", sonar.config.range_max_m / map->frame.pixel_m},
                                      {"width_px", map->frame.width}});
    };
    return {.per_ping = record_of_kind(context, stem, "<f4"),
            .products = sweep_files(context, stem, {".npy", ".png"}),
            .encode = [](const FinishedPing& f) { return record_bytes(f.ping.intensity); },
            .write_products = std::bind_front(write_displays, context, map),
            .describe = describe};
}

}  // namespace sonarsim
