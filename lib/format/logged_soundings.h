#pragma once

#include <vector>

namespace sonarsim {

/// A detected point of the bottom as stored by a multibeam.
struct LoggedSounding {
    double two_way_s = 0.0;
    double angle_deg = 0.0;  ///< across the track, from the vertical, negative to port
    double intensity = 0.0;
};

struct LoggedSoundings {
    double t_s = 0.0;                   ///< since 1970
    double sound_speed_m_s = 0.0;       ///< 0: not known
    double frequency_hz = 0.0;          ///< 0: not known
    std::vector<LoggedSounding> beams;  ///< only beams that detected the bottom
};

}  // namespace sonarsim
