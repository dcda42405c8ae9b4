#include "recording/recorded_xtf.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "core/text.h"
#include "format/xtf_reader.h"
#include "recording/file_of_pings.h"
#include "recording/law.h"

namespace sonarsim {

namespace {

/// The samples and the range of a side, for a message.
std::string extent_text(const XtfSide& side) {
    return std::to_string(side.samples.size()) + " samples over " +
           number_text(side.slant_range_m) + " m";
}

RecordedPing two_sides_of(const XtfSidescanPing& own) {
    RecordedPing ping;
    ping.time_s = own.t_s;
    ping.ranges = static_cast<int>(own.port.samples.size());
    ping.beams = 2;
    for (std::size_t i = 0; i < own.port.samples.size(); ++i) {
        ping.values.push_back(own.port.samples[i]);
        ping.values.push_back(own.starboard.samples[i]);
    }
    return ping;
}

}  // namespace

void read_xtf_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording) {
    XtfSide first;
    std::size_t values = 0;
    for (const std::filesystem::path& path : file.xtf) {
        const XtfPings xtf = parsed_file(path, [&](const std::string& bytes) {
            return read_xtf(bytes, most_pings - recording.pings.size());
        });
        for (std::size_t k = 0; k < xtf.pings.size(); ++k) {
            const XtfSidescanPing& ping = xtf.pings[k];
            if (recording.pings.empty()) {
                first = ping.port;
                recording.range_step_m =
                    first.slant_range_m / static_cast<double>(first.samples.size());
                recording.first_range_m = 0.5 * recording.range_step_m;
                take_full_value(xtf.full_value, recording.law);
                if (file.sound_speed_m_s == 0.0) recording.sound_speed_m_s = ping.sound_speed_m_s;
                if (!recording.frequency_hz && xtf.frequency_hz > 0.0)
                    recording.frequency_hz = xtf.frequency_hz;
                if (!recording.altitude_m && ping.altitude_m > 0.0)
                    recording.altitude_m = ping.altitude_m;
            }
            for (const XtfSide* side : {&ping.port, &ping.starboard}) {
                const bool is_alike = side->samples.size() == first.samples.size() &&
                                      std::fabs(side->slant_range_m - first.slant_range_m) <
                                          0.01 * first.slant_range_m;
                if (is_alike) continue;
                throw InputError({path.string()}, "ping " + std::to_string(k) + " has " +
                                                      extent_text(*side) + ", the first ping " +
                                                      extent_text(first) +
                                                      "; split the file where the range changes");
            }
            count_values(2 * first.samples.size(), path, values);
            recording.pings.push_back(two_sides_of(ping));
        }
        if (recording.pings.size() >= most_pings) break;
    }
}

void read_xtf_pings_of_soundings(const RecordingFile& file, std::size_t most_pings,
                                 Recording& recording) {
    std::size_t values = 0;
    for (const std::filesystem::path& path : file.xtf) {
        if (recording.soundings.size() >= most_pings) break;
        const auto pings = parsed_file(path, [&](const std::string& bytes) {
            return read_xtf_soundings(bytes, most_pings - recording.soundings.size());
        });
        add_soundings(pings, path, file, values, recording);
    }
}

}  // namespace sonarsim
