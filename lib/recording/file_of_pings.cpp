#include "recording/file_of_pings.h"

#include "core/units.h"
#include "recording/arrays.h"

namespace sonarsim {

void count_values(std::size_t more, const std::filesystem::path& path, std::size_t& values) {
    values += more;
    if (values > most_recorded_values)
        throw InputError({path.string()},
                         "makes more than 268,435,456 values in all; take fewer pings");
}

void add_soundings(const std::vector<LoggedSoundings>& pings, const std::filesystem::path& path,
                   const RecordingFile& file, std::size_t& values, Recording& recording) {
    for (const LoggedSoundings& ping : pings) {
        const double speed =
            file.sound_speed_m_s > 0.0 ? file.sound_speed_m_s : ping.sound_speed_m_s;
        if (!(speed > 0.0))
            throw InputError({path.string()},
                             "does not have the speed of sound: add `sound_speed_m_s`");
        if (recording.soundings.empty()) recording.sound_speed_m_s = speed;
        if (!recording.frequency_hz && ping.frequency_hz > 0.0 && ping.frequency_hz < 1e9)
            recording.frequency_hz = ping.frequency_hz;
        count_values(ping.beams.size(), path, values);
        RecordedSoundings& out = recording.soundings.emplace_back();
        out.time_s = ping.t_s;
        for (const LoggedSounding& beam : ping.beams) {
            out.range_m.push_back(static_cast<float>(0.5 * speed * beam.two_way_s));
            out.angle_rad.push_back(static_cast<float>(radians(beam.angle_deg)));
            out.intensity.push_back(static_cast<float>(beam.intensity));
        }
    }
}

}  // namespace sonarsim
