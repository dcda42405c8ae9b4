#include "dataset/layout.h"

#include <algorithm>

#include "core/error.h"

namespace sonarsim {

std::string_view name_of(FileKind kind) {
    switch (kind) {
        case FileKind::polar:
            return "polar";
        case FileKind::image:
            return "image";
        case FileKind::fan:
            return "fan";
        case FileKind::stages:
            return "stages";
        case FileKind::meta:
            return "meta";
    }
    return "";
}

std::string_view extension_of(FileKind kind) {
    switch (kind) {
        case FileKind::polar:
            return ".npy";
        case FileKind::image:
        case FileKind::fan:
        case FileKind::stages:
            return ".png";
        case FileKind::meta:
            return ".json";
    }
    return "";
}

std::string Layout::number(std::uint32_t pose) const {
    std::string text = std::to_string(pose);
    text.insert(0, std::max(0, digits - static_cast<int>(text.size())), '0');
    return text;
}

std::filesystem::path Layout::kind_folder(std::size_t sensor, FileKind kind) const {
    return folder / sensors[sensor] / name_of(kind);
}

std::filesystem::path Layout::file(const PingId& ping, FileKind kind) const {
    return kind_folder(ping.sensor, kind) / number(ping.pose).append(extension_of(kind));
}

bool Layout::has(const PingId& ping) const {
    // Last written, first looked for: an absent ping costs one question.
    return std::all_of(kinds.rbegin(), kinds.rend(), [&](FileKind kind) {
        return std::filesystem::is_regular_file(file(ping, kind));
    });
}

Layout make_layout(const Mission& mission, std::size_t poses) {
    const OutputConfig& output = mission.output;
    Layout layout;
    layout.folder = output.folder;
    for (const SonarConfig& sensor : mission.sensors)
        layout.sensors.push_back(sensor.name);
    if (output.polar) layout.kinds.push_back(FileKind::polar);
    if (output.image) layout.kinds.push_back(FileKind::image);
    if (output.fan) layout.kinds.push_back(FileKind::fan);
    if (output.stages) layout.kinds.push_back(FileKind::stages);
    if (output.meta) layout.kinds.push_back(FileKind::meta);
    if (layout.kinds.empty()) {
        throw InputError("mission '" + mission.name +
                         "' writes nothing: set one of output.polar, image, fan, stages or "
                         "meta to true");
    }
    const std::size_t last = poses > 0 ? poses - 1 : 0;
    layout.digits = std::max(6, static_cast<int>(std::to_string(last).size()));
    return layout;
}

std::vector<PingId> list_pings(const Mission& mission, std::size_t poses) {
    std::vector<PingId> pings;
    for (std::uint32_t pose = 0; pose < poses; ++pose) {
        for (std::uint32_t sensor = 0; sensor < mission.sensors.size(); ++sensor) {
            if (pose % mission.sensors[sensor].every == 0) pings.push_back({pose, sensor});
        }
    }
    return pings;
}

}  // namespace sonarsim
