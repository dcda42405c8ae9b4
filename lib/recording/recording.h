#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sonarsim {

/// The law from the amplitude A of an echo to a value of a recording.
struct RecordedLaw {
    enum class Kind {
        amplitude,  ///< proportional to the amplitude A
        power,      ///< proportional to A^2
        gamma,      ///< full_value (A / A_max)^exponent
        decibel     ///< 20 log A, `range_db` from value 0 to `full_value`
    };

    Kind kind = Kind::amplitude;
    double exponent = 0.5;    ///< exponent of `gamma`
    double range_db = 0;      ///< range of `decibel`
    double full_value = 255;  ///< the largest value that the instrument delivers; 0 for none
    double offset = 0;        ///< share of `full_value` that the instrument subtracts
    bool full_value_is_auto = false;  ///< `full_value` is not given
};

/// The kinds of data that instruments deliver.
enum class RecordedKind { imaging, sidescan, scanning, echosounder, soundings };

/// One ping as delivered, before any law is undone.
struct RecordedPing {
    double time_s = 0;
    int ranges = 0;
    int beams = 0;              ///< side-scan: 2, port first; scanning and echosounder: 1
    std::vector<float> values;  ///< [ranges x beams], a range after the other
    double bearing_rad = 0;     ///< direction of the head of a scanning sonar
};

/// The detected bottom of one ping, one entry per beam; beams without a detection are left out.
struct RecordedSoundings {
    double time_s = 0;
    std::vector<float> range_m;
    std::vector<float> angle_rad;  ///< from the vertical, negative to port
    std::vector<float> intensity;  ///< in values of the recording's law
};

/// Pings of one instrument, in the order of time, from a real sonar or from a dataset.
struct Recording {
    std::string name;  ///< for messages and tables
    RecordedKind kind = RecordedKind::imaging;
    RecordedLaw law;
    double sound_speed_m_s = 1500;
    double first_range_m = 0;  ///< slant range of the middle of the first sample
    double range_step_m = 0;
    std::vector<double> bearing_rad;  ///< each beam's; positive to port as in a mission
    std::optional<double> frequency_hz;
    std::optional<double> altitude_m;
    std::optional<double> pitch_rad;  ///< the mount's; positive turns the axis down
    std::vector<RecordedPing> pings;
    std::vector<RecordedSoundings> soundings;  ///< for `soundings`, instead of `pings`
};

}  // namespace sonarsim
