#include "output/dataset/writer.h"
#include "simulate/product/contrast.h"
#include "simulate/product/fan.h"

// The files of every ping: of imaging and profiling sonars, and the metadata of all.

namespace sonarsim {

/// polar/NNNNNN.npy: float32 [range, azimuth], the intensities as simulated.
Writer make_polar_writer(const WriterContext&) {
    return {.per_ping = PingFile{"polar", ".npy", PingArray::bins},
            .encode = [](const FinishedPing& finished) {
                const Ping& ping = finished.ping;
                return npy_bytes(ping.intensity, ping.range_bins, ping.beams);
            }};
}

/// image/NNNNNN.png: 16 bits [range, azimuth], 65535 * intensity / full_scale.
Writer make_image_writer(const WriterContext& context) {
    const double white = context.full_scale();
    return {
        .per_ping = PingFile{"image", ".png", PingArray::bins, {}, "polar"},
        .encode =
            [white](const FinishedPing& finished) {
                const Ping& ping = finished.ping;
                return png_bytes(grey_16(ping.intensity, white), ping.beams, ping.range_bins);
            },
        // The picture has the rows and columns of polar/. A fan has ahead up and port on the left.
        .describe =
            [](Json& sensor) {
                sensor["image"] = {{"axes", {"range", "azimuth"}},
                                   {"first_row", "nearest range"},
                                   {"first_column", "starboard"}};
            }};
}

/// fan/NNNNNN.png: grey, 8 bits, as an operator sees it; in the calibrated model raw/ as a fan.
Writer make_fan_writer(const WriterContext& context) {
    const auto map = context.assembly.fans->map(context.sonar());
    const FanFrame frame = map->frame;
    const double white = context.full_scale();
    const double apex_row = context.sonar().settings.view.range_max_m / frame.pixel_m;
    return {.per_ping = PingFile{"fan", ".png", PingArray::fan, {}, "fan"},
            .encode =
                [=](const FinishedPing& finished) {
                    const auto fan =
                        display_fan(*map, *finished.sonar.settings.model, finished.ping, white);
                    return png_bytes(fan, frame.width, frame.height);
                },
            .describe =
                [=](Json& sensor) {
                    sensor["fan"] = {{"width_px", frame.width},
                                     {"height_px", frame.height},
                                     {"pixel_m", frame.pixel_m},
                                     {"apex_px", {0.5 * frame.width, apex_row}}};
                }};
}

/// stages/NNNNNN.png: 8 bits, a fan for each stage of the echo model side by side: direct echoes,
/// then with multipath, then with one random term of the model after the other.
Writer make_stages_writer(const WriterContext& context) {
    const auto map = context.assembly.fans->map(context.sonar());
    const auto width = static_cast<std::size_t>(map->frame.width);
    const auto height = static_cast<std::size_t>(map->frame.height);
    const std::size_t stages = stage_count(context.sonar());
    const auto whole = static_cast<int>(stages * width);
    const auto encode = [=](const FinishedPing& finished) {
        std::vector<std::uint8_t> picture(height * width * stages);
        std::size_t k = 0;
        for (const Ping& stage :
             form_stages(finished.traced, finished.sonar, context.assembly.scene,
                         {context.mission.seed, finished.id.pose})) {
            const std::vector<std::uint8_t> fan =
                display_fan(*map, *finished.sonar.settings.model, stage, context.full_scale());
            for (std::size_t row = 0; row < height; ++row)
                std::copy_n(fan.data() + row * width, width,
                            picture.data() + (row * stages + k) * width);
            ++k;
        }
        return png_bytes(picture, whole, map->frame.height);
    };
    return {.per_ping = PingFile{"stages", ".png", PingArray::none, {}, "stages"},
            .encode = encode};
}

/// meta/NNNNNN.json: time, poses, seed, counts and what was measured.
Writer make_meta_writer(const WriterContext& context) {
    return {.per_ping = PingFile{"meta", ".json"},
            .encode = [context](const FinishedPing& finished) {
                return json_text(describe_ping(context.mission, context.assembly, finished));
            }};
}

}  // namespace sonarsim
