#include "recording/check_recording.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sonarsim {

namespace {

void check_ping(const RecordedPing& ping, const Recording& recording, const std::string& which) {
    const auto values =
        static_cast<std::size_t>(ping.ranges) * static_cast<std::size_t>(ping.beams);
    if (ping.ranges < 1 || ping.beams < 1 || ping.values.size() != values)
        throw InputError(which + " has no values");
    const RecordedPing& first = recording.pings.front();
    if (ping.ranges != first.ranges || ping.beams != first.beams)
        throw InputError(which + " has " + std::to_string(ping.ranges) + " ranges and " +
                         std::to_string(ping.beams) + " beams, the first ping " +
                         std::to_string(first.ranges) + " and " + std::to_string(first.beams));
    const bool may_be_negative = recording.law.kind == RecordedLaw::Kind::decibel;
    const bool is_sound = std::ranges::all_of(ping.values, [&](float value) {
        return std::isfinite(value) && (may_be_negative || value >= 0.0F);
    });
    if (!is_sound)
        throw InputError(
            which + " has values that are negative or not finite; " +
            "give the law of what the instrument delivers, and 0 where nothing was received");
}

}  // namespace

void check_recording(const Recording& recording, const std::string& source) {
    if (recording.pings.empty() && recording.soundings.empty())
        throw InputError({source}, "has no pings");
    for (std::size_t k = 0; k < recording.pings.size(); ++k)
        check_ping(recording.pings[k], recording, source + ": ping " + std::to_string(k));
    if (recording.kind != RecordedKind::imaging) return;
    const auto beams = static_cast<std::size_t>(recording.pings.front().beams);
    if (recording.bearing_rad.size() != beams)
        throw InputError({source}, "has " + std::to_string(recording.bearing_rad.size()) +
                                       " bearings for " + std::to_string(beams) + " beams");
}

}  // namespace sonarsim
