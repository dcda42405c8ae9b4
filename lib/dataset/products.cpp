#include "dataset/products.h"

#include "dataset/measure.h"

namespace sonarsim {

RecordFiles open_records(const Assembly& assembly, const Layout& layout) {
    RecordFiles files(layout.sensors.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        const SensorLayout& sensor = layout.sensors[i];
        if (sensor.series.record.empty()) continue;
        files[i] = std::make_unique<RecordFile>(layout.series_file(i, sensor.series.record),
                                                record_format(assembly.sonars[i], sensor.pings),
                                                sensor.pings);
    }
    return files;
}

void write_products(const Mission& mission, const Assembly& assembly, const Layout& layout,
                    const RecordFiles& records) {
    for (std::size_t i = 0; i < records.size(); ++i) {
        if (!records[i]) continue;
        const Sonar& sonar = assembly.sonars[i];
        const std::filesystem::path folder = layout.series_file(i, "");
        const SoundingSource soundings{*records[i],
                                       static_cast<std::size_t>(sonar.settings.view.beams),
                                       layout.sensors[i].every, assembly.trajectory};
        switch (sonar.config.kind) {
            case SonarKind::imaging:
                break;
            case SonarKind::profiling:
                write_soundings(soundings, folder);
                write_bathymetry(soundings, mission.output.bathymetry_cell_m, folder);
                break;
            case SonarKind::sidescan:
                write_waterfall(sonar, mission.output.full_scale, *records[i], folder);
                break;
            case SonarKind::echosounder:
                write_echogram(sonar, mission.output.full_scale, *records[i], folder);
                break;
        }
    }
}

}  // namespace sonarsim
