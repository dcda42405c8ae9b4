#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace sonarsim {

/// A ping of an Oculus, by Blueprint Subsea.
struct OculusPing {
    int ranges = 0;
    int beams = 0;
    std::vector<float> values;        ///< [range, beam], the nearest range first
    std::vector<double> bearing_deg;  ///< as in the message: negative to the left
    double range_step_m = 0.0;
    double sound_speed_m_s = 0.0;
    double frequency_hz = 0.0;
    double full_value = 255.0;  ///< the largest value of the message's 8, 16 or 32 bits
};

/// Reads the simple ping results, versions 1 and 2, among any other bytes: the messages as the
/// sonar sends them, one after the other, or the log of a program that stores them unpacked. Throws
/// std::runtime_error when there is none, and when a ping has values of another size or a gain for
/// each range.
std::vector<OculusPing> read_oculus(std::string_view bytes, std::size_t most_pings);

}  // namespace sonarsim
