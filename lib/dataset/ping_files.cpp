#include "dataset/ping_files.h"

#include <algorithm>
#include <cmath>

#include "dataset/metadata.h"
#include "dataset/npy.h"
#include "dataset/png.h"
#include "product/panels.h"

namespace sonarsim {

std::vector<std::uint16_t> grey_16(std::span<const float> intensity, double full_scale) {
    const float scale = static_cast<float>(65535.0 / full_scale);
    std::vector<std::uint16_t> grey(intensity.size());
    for (std::size_t i = 0; i < grey.size(); ++i) {
        const float value = std::min(65535.0F, std::max(0.0F, intensity[i] * scale));
        grey[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(value + 0.5F));
    }
    return grey;
}

std::vector<FanMap> make_fan_maps(const Mission& mission, const Assembly& assembly,
                                  const Layout& layout) {
    std::vector<FanMap> fans(assembly.sonars.size());
    for (std::size_t i = 0; i < fans.size(); ++i) {
        const SensorLayout& files = layout.sensors[i];
        if (files.writes(FileKind::fan) || files.writes(FileKind::stages))
            fans[i] = make_fan_map(assembly.sonars[i], mission.output.fan_width_px);
    }
    return fans;
}

PingFiles encode_ping(const Mission& mission, const Assembly& assembly, const Layout& layout,
                      const std::vector<FanMap>& fans, const PingId& id, const Ping& ping,
                      const nlohmann::ordered_json& measured, std::span<const Ping> stages) {
    const double full_scale = mission.output.full_scale;
    const auto white = static_cast<float>(full_scale);
    PingFiles out;
    out.clipped_pixels = std::ranges::count_if(ping.intensity, [&](float v) { return v > white; });
    const auto encode = [&](FileKind kind) {
        switch (kind) {
            case FileKind::polar:
                return npy_bytes(ping.intensity, ping.range_bins, ping.beams);
            case FileKind::image:
                return png_bytes(grey_16(ping.intensity, full_scale), ping.beams, ping.range_bins);
            case FileKind::fan: {
                const FanMap& map = fans[id.sensor];
                return png_bytes(render_fan(map, ping, full_scale), map.frame.width,
                                 map.frame.height);
            }
            case FileKind::stages: {
                const FanMap& map = fans[id.sensor];
                return png_bytes(render_panels(map, stages, full_scale),
                                 map.frame.width * static_cast<int>(stages.size()),
                                 map.frame.height);
            }
            case FileKind::meta:
                return json_text(describe_ping(mission, assembly, id, ping.counts,
                                               out.clipped_pixels, measured));
        }
        return std::string();
    };
    for (const FileKind kind : layout.sensors[id.sensor].kinds)
        out.files.emplace_back(kind, encode(kind));
    return out;
}

}  // namespace sonarsim
