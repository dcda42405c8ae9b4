#include "dataset/layout.h"

#include <algorithm>

#include "core/error.h"

namespace sonarsim {

namespace {

bool has_images(SonarKind kind) {
    return kind == SonarKind::imaging || kind == SonarKind::profiling;
}

bool wants_series(const OutputConfig& output, SonarKind kind) {
    switch (kind) {
        case SonarKind::imaging:
            return false;
        case SonarKind::profiling:
            return output.soundings;
        case SonarKind::sidescan:
            return output.waterfall;
        case SonarKind::echosounder:
            return output.echogram;
    }
    return false;
}

}  // namespace

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

bool SensorLayout::writes(FileKind kind) const {
    return std::ranges::find(kinds, kind) != kinds.end();
}

std::string Layout::number(std::uint32_t pose) const {
    std::string text = std::to_string(pose);
    text.insert(0, std::max(0, digits - static_cast<int>(text.size())), '0');
    return text;
}

std::filesystem::path Layout::kind_folder(std::size_t sensor, FileKind kind) const {
    return folder / sensors[sensor].name / name_of(kind);
}

std::filesystem::path Layout::file(const PingId& ping, FileKind kind) const {
    return kind_folder(ping.sensor, kind) / number(ping.pose).append(extension_of(kind));
}

std::filesystem::path Layout::series_file(std::size_t sensor, const std::string& name) const {
    return folder / sensors[sensor].name / name;
}

std::size_t Layout::record_of(const PingId& ping) const {
    return ping.pose / sensors[ping.sensor].every;
}

bool Layout::has(const PingId& ping) const {
    // Last written, first looked for: an absent ping costs one question.
    const std::vector<FileKind>& kinds = sensors[ping.sensor].kinds;
    return std::all_of(kinds.rbegin(), kinds.rend(), [&](FileKind kind) {
        return std::filesystem::is_regular_file(file(ping, kind));
    });
}

bool Layout::has_products() const {
    for (std::size_t sensor = 0; sensor < sensors.size(); ++sensor) {
        for (const std::string& name : sensors[sensor].series.products) {
            if (!std::filesystem::is_regular_file(series_file(sensor, name))) return false;
        }
    }
    return true;
}

const SeriesFiles& series_files(SonarKind kind) {
    static const SeriesFiles none;
    static const SeriesFiles waterfall{"waterfall.npy", {"waterfall.png", "waterfall_view.png"}};
    static const SeriesFiles echogram{"echogram.npy", {"echogram.png", "echogram_view.png"}};
    static const SeriesFiles soundings{
        "soundings.npy",
        {"soundings.csv", "soundings.ply", "bathymetry.tif", "bathymetry.json", "bathymetry.png"}};
    switch (kind) {
        case SonarKind::imaging:
            return none;
        case SonarKind::profiling:
            return soundings;
        case SonarKind::sidescan:
            return waterfall;
        case SonarKind::echosounder:
            return echogram;
    }
    return none;
}

Layout make_layout(const Mission& mission, std::size_t poses) {
    const OutputConfig& output = mission.output;
    Layout layout;
    layout.folder = output.folder;
    for (const SonarConfig& sensor : mission.sensors) {
        const bool series = wants_series(output, sensor.kind);
        const auto every = static_cast<std::uint32_t>(sensor.every);
        SensorLayout files{sensor.name, {}, {}, every, (poses + every - 1) / every};
        if (has_images(sensor.kind)) {
            if (output.polar) files.kinds.push_back(FileKind::polar);
            if (output.image) files.kinds.push_back(FileKind::image);
            if (output.fan) files.kinds.push_back(FileKind::fan);
            if (output.stages) files.kinds.push_back(FileKind::stages);
        }
        if (output.meta || series) files.kinds.push_back(FileKind::meta);
        if (series) files.series = series_files(sensor.kind);
        if (files.kinds.empty()) {
            throw InputError("mission '" + mission.name + "' writes nothing of sensor '" +
                             sensor.name + "': set one of output." +
                             (has_images(sensor.kind) ? "polar, image, fan, stages or meta"
                                                      : "meta, waterfall or echogram") +
                             " to true");
        }
        layout.sensors.push_back(std::move(files));
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
