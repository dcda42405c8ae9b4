#include "recording/recorded_oculus.h"

#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "format/oculus_reader.h"
#include "recording/file_of_pings.h"
#include "recording/law.h"

namespace sonarsim {

namespace {

/// Takes the values that hold for all pings from the first one.
void take_facts(const OculusPing& first, const RecordingFile& file, Recording& recording) {
    take_full_value(first.full_value, recording.law);
    recording.range_step_m = first.range_step_m;
    recording.first_range_m = 0.5 * first.range_step_m;
    if (file.sound_speed_m_s == 0.0) recording.sound_speed_m_s = first.sound_speed_m_s;
    if (!recording.frequency_hz) recording.frequency_hz = first.frequency_hz;
    for (const double bearing : first.bearing_deg)
        recording.bearing_rad.push_back(-bearing * pi / 180.0);  // positive to port
}

}  // namespace

void read_oculus_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording) {
    std::size_t values = 0;
    for (const std::filesystem::path& path : file.oculus) {
        if (recording.pings.size() >= most_pings) break;
        std::vector<OculusPing> pings = parsed_file(path, [&](const std::string& bytes) {
            return read_oculus(bytes, most_pings - recording.pings.size());
        });
        for (OculusPing& own : pings) {
            if (recording.pings.empty()) take_facts(own, file, recording);
            if (std::fabs(own.range_step_m - recording.range_step_m) >
                1e-4 * recording.range_step_m)
                throw InputError({path.string()},
                                 "ping " + std::to_string(recording.pings.size()) +
                                     " has another range than the first; split the "
                                     "file where the range changes");
            count_values(own.values.size(), path, values);
            RecordedPing& ping = recording.pings.emplace_back();
            ping.ranges = own.ranges;
            ping.beams = own.beams;
            ping.values = std::move(own.values);
        }
    }
}

}  // namespace sonarsim
