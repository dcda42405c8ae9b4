#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "format/sonar_log.h"

namespace sonarsim {

/// The samples of one beam: int8 in steps of 0.5 dB.
struct WaterBeam {
    double angle_deg = 0.0;  ///< from the vertical
    std::size_t first = 0;   ///< number of the first sample
    std::string_view samples;
};

/// One ping of a multibeam's water column.
struct WaterPing {
    double t_s = 0.0;
    double frequency_hz = 0.0;
    double sample_hz = 0.0;
    double sound_speed_m_s = 0.0;
    std::vector<WaterBeam> beams;

    /// Adds a beam, and throws std::runtime_error where it has no direction.
    void add(const WaterBeam& beam);
};

/// Throws std::runtime_error for a ping without a rate of samples or a speed of sound.
void check_water(const WaterPing& ping);

/// A log of pings with the same beams. The value 0 is -64 dB, or a sample that a beam lacks. The
/// bearings are those of the first ping. Throws std::runtime_error, with the text `missing` if
/// there are no pings.
SonarLog log_of_water(const std::vector<WaterPing>& pings, const char* missing);

}  // namespace sonarsim
