#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "core/error.h"
#include "format/kmall_soundings.h"
#include "format/oculus_reader.h"
#include "format/sonar_log.h"
#include "format/xtf_reader.h"
#include "recording/arrays.h"
#include "recording/recording_file.h"

// The first byte chooses the reader: 'y' for recording.yaml, 'x' for XTF, 'o'
// for an Oculus, 'l' for the logs of other sonars, 'm' for the soundings of a .kmall, anything else
// for an array (.npy or PNG). What a reader accepts keeps the promises of its struct.

using namespace sonarsim;

namespace {

void require_that(bool holds) {
    if (!holds) std::abort();
}

void check_array(const RecordedArray& array) {
    std::size_t values = 1;
    for (const std::size_t length : array.shape)
        values *= length;
    require_that(!array.shape.empty() && values == array.values.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        if (data[0] == 'y') {
            const RecordingFile file = parse_recording(text, "in.yaml", "/nowhere");
            require_that(std::isfinite(file.sound_speed_m_s) && file.sound_speed_m_s > 0.0);
        } else if (data[0] == 'x') {
            for (const XtfSidescanPing& ping : read_xtf(text, 1000).pings)
                require_that(!ping.port.samples.empty() && ping.starboard.slant_range_m > 0.0);
            for (const LoggedSoundings& ping : read_xtf_soundings(text, 1000)) {
                for (const LoggedSounding& beam : ping.beams)
                    require_that(beam.two_way_s > 0.0 && beam.intensity >= 0.0);
            }
        } else if (data[0] == 'o') {
            for (const OculusPing& ping : read_oculus(text, 1000))
                require_that(!ping.values.empty() &&
                             ping.bearing_deg.size() * static_cast<std::size_t>(ping.ranges) ==
                                 ping.values.size());
        } else if (data[0] == 'l') {
            const SonarLog log = read_sonar_log(text, 1000);
            require_that(log.range_step_s > 0.0);
            for (const LoggedPing& ping : log.pings)
                require_that(!ping.values.empty() && ping.ranges == log.pings.front().ranges &&
                             static_cast<std::size_t>(ping.ranges) *
                                     static_cast<std::size_t>(ping.beams) ==
                                 ping.values.size());
        } else if (data[0] == 'm') {
            for (const LoggedSoundings& ping : read_kmall_soundings(text, 1000)) {
                require_that(ping.sound_speed_m_s > 0.0);
                for (const LoggedSounding& beam : ping.beams)
                    require_that(beam.two_way_s > 0.0 && beam.intensity >= 0.0 &&
                                 std::isfinite(beam.angle_deg));
            }
        } else {
            check_array(read_array(text, "in"));
        }
    } catch (const InputError&) {
        return 0;
    } catch (const std::runtime_error&) {
        return 0;
    }
    return 0;
}
