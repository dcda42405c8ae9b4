#include "calibrate/usable.h"

#include <algorithm>
#include <string>

#include "calibrate/law_fit.h"
#include "core/error.h"

namespace sonarsim {

namespace {

constexpr double most_full = 0.1;
constexpr double most_zeros = 0.9;

SonarKind kind_of(RecordedKind kind) {
    switch (kind) {
        case RecordedKind::sidescan:
            return SonarKind::sidescan;
        case RecordedKind::scanning:
            return SonarKind::scanning;
        case RecordedKind::echosounder:
            return SonarKind::echosounder;
        case RecordedKind::soundings:
            return SonarKind::profiling;
        default:
            return SonarKind::imaging;
    }
}

std::size_t pings_of(const Recording& recording) {
    return recording.kind == RecordedKind::soundings ? recording.soundings.size()
                                                     : recording.pings.size();
}

std::string percent(double share) {
    return std::to_string(static_cast<int>(100.0 * share + 0.5)) + " %";
}

void check_values(const Recording& recording) {
    // Values are rounded to whole numbers, unless all lie below 15.
    const double largest = full_value_of(recording) * (1.0 - recording.law.offset);
    const double saturated = largest > 15.0 ? largest - 0.5 : largest;
    double count = 0.0, zeros = 0.0, full = 0.0;
    float least = recording.pings.front().values.front();
    float most = least;
    for (const RecordedPing& ping : recording.pings) {
        for (const float value : ping.values) {
            count += 1.0;
            zeros += value <= 0.0F ? 1.0 : 0.0;
            full += largest > 0.0 && value >= saturated ? 1.0 : 0.0;
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
    if (least == most) throw InputError(recording.name + ": every value is the same: it is empty");
    if (zeros > most_zeros * count) {
        throw InputError(recording.name + ": " + percent(zeros / count) +
                         " of the values are 0: record with more gain");
    }
    if (full > most_full * count) {
        throw InputError(recording.name + ": " + percent(full / count) +
                         " of the values are the largest one: it is saturated; record with less "
                         "gain");
    }
}

}  // namespace

void check_usable(const Recording& recording, SonarKind start) {
    if (kind_of(recording.kind) != start) {
        throw InputError(recording.name +
                         ": the sonar of the start is of another kind than the recording: choose a "
                         "preset of its kind (soundings: a profiling sonar)");
    }
    const std::size_t pings = pings_of(recording);
    if (pings < 2) {
        throw InputError(recording.name + ": " + std::to_string(pings) +
                         (pings == 1 ? " ping" : " pings") +
                         ": one part of the pings is fitted and the other judged, so it takes two "
                         "or more");
    }
    if (recording.kind != RecordedKind::soundings) check_values(recording);
}

SplitRecording split(const Recording& recording, double judged_share, bool reversed) {
    const std::size_t pings = pings_of(recording);
    const auto share = static_cast<std::size_t>(judged_share * static_cast<double>(pings));
    const std::size_t judged = std::clamp<std::size_t>(share, 1, pings - 1);
    const auto cut = static_cast<std::ptrdiff_t>(reversed ? judged : pings - judged);
    SplitRecording out{recording, recording};
    Recording& first = reversed ? out.judged : out.fitted;
    Recording& last = reversed ? out.fitted : out.judged;
    if (recording.kind == RecordedKind::soundings) {
        first.soundings.erase(first.soundings.begin() + cut, first.soundings.end());
        last.soundings.erase(last.soundings.begin(), last.soundings.begin() + cut);
    } else {
        first.pings.erase(first.pings.begin() + cut, first.pings.end());
        last.pings.erase(last.pings.begin(), last.pings.begin() + cut);
    }
    return out;
}

}  // namespace sonarsim
