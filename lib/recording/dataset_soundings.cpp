#include "recording/dataset_soundings.h"

#include <cmath>

#include "core/error.h"

namespace sonarsim {

namespace {

constexpr double least_quality = 0.5;
/// Range, x, y, z and quality; where sound bends, the true x, y and z follow.
constexpr std::size_t sounding_values = 5;
constexpr std::size_t bent_sounding_values = 8;

}  // namespace

void read_dataset_soundings(const DatasetSource& source, const std::string& pattern,
                            Recording& recording) {
    const DescribedSensor& sensor = *source.sensor;
    const std::string file = (source.folder / *sensor.records).string();
    const RecordedArray soundings = read_array_file(file);
    const std::size_t beams = sensor.azimuth_bins;
    const std::size_t values = soundings.shape.empty() ? 0 : soundings.shape.back();
    if (soundings.shape != std::vector<std::size_t>{sensor.pings, beams, values} ||
        (values != sounding_values && values != bent_sounding_values))
        throw InputError({file},
                         "has another shape than dataset.json says; sonarsim verify says more");
    const std::vector<double> azimuths = middles(source.checked().at("azimuth_edges_rad"));
    recording.soundings.resize(source.pings());
    for_each_ping_array(
        source, pattern, [&](std::size_t k, const RecordedArray& image, const std::string& name) {
            if (image.shape != std::vector<std::size_t>{sensor.range_bins, beams})
                throw InputError(
                    {name}, "has another shape than dataset.json says; sonarsim verify says more");
            for (std::size_t j = 0; j < beams; ++j) {
                const double* own = soundings.values.data() + (k * beams + j) * values;
                const double bin =
                    (own[0] - recording.first_range_m) / recording.range_step_m + 0.5;
                const bool is_found = own[4] >= least_quality && bin >= 0.0 &&
                                      bin < static_cast<double>(sensor.range_bins);
                if (!is_found) continue;
                RecordedSoundings& ping = recording.soundings[k];
                ping.range_m.push_back(static_cast<float>(own[0]));
                ping.angle_rad.push_back(static_cast<float>(-azimuths[j]));
                ping.intensity.push_back(
                    static_cast<float>(image.values[static_cast<std::size_t>(bin) * beams + j]));
            }
        });
}

}  // namespace sonarsim
