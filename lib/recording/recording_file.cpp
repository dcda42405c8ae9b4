#include "recording/recording_file.h"

#include <array>
#include <optional>

#include "core/error.h"
#include "mission/document.h"
#include "mission/reader.h"

namespace sonarsim {

namespace {

constexpr std::array recorded_kinds{Choice<RecordedKind>{"imaging", RecordedKind::imaging},
                                    Choice<RecordedKind>{"sidescan", RecordedKind::sidescan},
                                    Choice<RecordedKind>{"scanning", RecordedKind::scanning},
                                    Choice<RecordedKind>{"echosounder", RecordedKind::echosounder},
                                    Choice<RecordedKind>{"soundings", RecordedKind::soundings}};

constexpr std::array law_kinds{Choice<RecordedLaw::Kind>{"amplitude", RecordedLaw::Kind::amplitude},
                               Choice<RecordedLaw::Kind>{"power", RecordedLaw::Kind::power},
                               Choice<RecordedLaw::Kind>{"gamma", RecordedLaw::Kind::gamma},
                               Choice<RecordedLaw::Kind>{"decibel", RecordedLaw::Kind::decibel}};

constexpr std::array bearing_spreads{Choice<BearingSpread>{"angle", BearingSpread::angle},
                                     Choice<BearingSpread>{"sine", BearingSpread::sine}};

}  // namespace

// MissionReader finds these by the type of their section.

void describe(MissionReader& v, RecordedLaw& c) {
    v.choice("kind", c.kind, law_kinds, "meaning of a value", required);
    v.number("exponent", c.exponent, between(0.1, 2), "of gamma");
    v.number("range_db", c.range_db, between(0, 300), "of decibel");
    std::optional<double> full_value;
    v.number_or_auto("full_value", full_value, at_least(0), "largest value; 0: none");
    c.full_value = full_value.value_or(c.full_value);
    c.full_value_is_auto = !full_value.has_value();
    v.number("offset", c.offset, between(0, 0.9), "share of full_value that was taken away");
    v.require(c.kind != RecordedLaw::Kind::decibel || (c.range_db > 0.0 && c.full_value > 0.0),
              {"kind", "range_db", "full_value"},
              "the law decibel needs range_db and full_value above 0");
}

void describe(MissionReader& v, SoundingFiles& c) {
    v.path("range_m", c.range_m, "slant ranges", required);
    v.path("angle_rad", c.angle_rad, "angles from the vertical", required);
    v.path("intensity", c.intensity, "values by the law", required);
}

void describe(MissionReader& v, RecordingFile& c) {
    v.place(c.place);
    v.choice("kind", c.kind, recorded_kinds, "what the instrument delivers", required);
    const bool is_soundings = c.kind == RecordedKind::soundings;
    v.paths("xtf", c.xtf, "XTF files", Presence::optional);
    v.require(c.xtf.empty() || c.kind == RecordedKind::sidescan || is_soundings, {"kind", "xtf"},
              "XTF files are read for the kinds sidescan and soundings");
    v.paths("oculus", c.oculus, "messages or logs of an Oculus", Presence::optional);
    v.require(c.oculus.empty() || c.kind == RecordedKind::imaging, {"kind", "oculus"},
              "files of an Oculus are read for the kind imaging");
    v.paths("logs", c.logs, "files of the formats in docs/compare.md", Presence::optional);
    const bool is_log = !c.logs.empty();
    const bool is_format = !c.xtf.empty() || !c.oculus.empty() || is_log;
    const bool has_own_ranges = is_soundings || is_format;
    const Presence of_images = has_own_ranges ? Presence::optional : required;
    v.paths("files", c.files, "arrays of the pings", of_images);
    const int sources = (c.files.empty() ? 0 : 1) + (c.xtf.empty() ? 0 : 1) +
                        (c.oculus.empty() ? 0 : 1) + (is_log ? 1 : 0);
    v.require(sources <= 1, {"files", "xtf", "oculus", "logs"},
              "a recording has one of `files`, `xtf`, `oculus` and `logs`");
    v.optional_section("soundings", c.soundings, "files of soundings");
    v.require(is_soundings ? c.soundings.has_value() == (c.xtf.empty() && !is_log) : !c.soundings,
              {"kind", "soundings"},
              "the kind soundings has the section `soundings`, `xtf` or `logs`; other kinds have "
              "`files`");
    v.require(!is_soundings || c.files.empty(), {"kind", "files"},
              "the kind soundings has the section `soundings` in place of `files`");
    v.optional_section("law", c.law, "meaning of the values");
    v.require(is_log || c.law.has_value(), {"law"}, "'recording' lacks the key 'law'");
    v.number("sound_speed_m_s", c.sound_speed_m_s, between(300, 10000), "speed of sound",
             is_format ? Presence::optional : required);
    v.number("first_range_m", c.first_range_m, at_least(0), "middle of the first sample",
             of_images);
    v.number("range_step_m", c.range_step_m, has_own_ranges ? at_least(0) : above(0),
             "distance of samples", of_images);
    v.number("bearing_first_deg", c.bearing_first_deg, any_angle_deg, "of the first beam");
    v.number("bearing_last_deg", c.bearing_last_deg, any_angle_deg, "of the last beam");
    v.choice("spread", c.spread, bearing_spreads, "even steps of the angle or of its sine");
    v.require(c.spread == BearingSpread::angle ||
                  (c.bearing_first_deg >= -90.0 && c.bearing_first_deg <= 90.0 &&
                   c.bearing_last_deg >= -90.0 && c.bearing_last_deg <= 90.0),
              {"bearing_first_deg", "bearing_last_deg", "spread"},
              "with spread: sine bearings lie within -90 and 90");
    v.numbers("bearings_deg", c.bearings_deg, any_angle_deg, "of each beam");
    v.number("head_first_deg", c.head_first_deg, any_angle_deg, "of a scanning sonar's first ping");
    v.number("head_step_deg", c.head_step_deg, any_angle_deg, "from ping to ping");
    v.number_or_auto("frequency_hz", c.frequency_hz, between(1e3, 1e8), "frequency of the sound");
    v.number_or_auto("altitude_m", c.altitude_m, at_least(0), "height above the bottom");
    v.number_or_auto("pitch_deg", c.pitch_deg, between(-180, 180), "axis below the horizontal");
    v.number("rate_hz", c.rate_hz, at_least(0), "pings in a second");
    v.numbers("times_s", c.times_s, {-furthest_s, furthest_s}, "of each ping");
}

RecordingFile parse_recording(std::string_view text, const std::string& source,
                              const std::filesystem::path& folder) {
    RecordingFile file;
    ErrorList errors;
    const YamlNode document = read_document(text, source);
    errors.attempt([&] {
        MissionReader reader(document, "recording", folder, {}, errors);
        describe(reader, file);
        reader.finish();
    });
    errors.raise();
    return file;
}

const char* name_of_kind(RecordedKind kind) {
    for (const auto& one : recorded_kinds) {
        if (one.value == kind) return one.name;
    }
    return "unknown";
}

}  // namespace sonarsim
