#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "format/sonar_log.h"

namespace sonarsim {

/// One channel of one ping of a Simrad echosounder. The samples are int16 in steps of 10 log10(2) /
/// 256 dB re 1 W, or complex floats of 16 or 32 bits, one for each sector of the transducer.
struct EkPing {
    double t_s = 0.0;
    double frequency_hz = 0.0;
    double sample_s = 0.0;
    double sound_speed_m_s = 0.0;
    std::size_t offset = 0;
    std::size_t count = 0;
    std::string_view samples;
    int sectors = 0;     ///< 0: the samples are int16
    double watts = 0.0;  ///< power of a mean over the sectors of amplitude 1
    bool has_half_floats = false;
    /// The sweep after the receiver's filters, shared by pings; null for a pulse of one frequency.
    std::shared_ptr<const std::vector<std::complex<double>>> pulse;
};

/// The datagrams of a .raw file, each from its type of four letters on. Throws std::runtime_error
/// where the file is damaged.
std::vector<std::string_view> ek_datagrams(std::string_view bytes);

/// Seconds since 1970 of a datagram.
double ek_time_s(std::string_view datagram);

/// Throws std::runtime_error for impossible numbers.
void check_ek(const EkPing& ping);

/// True for the frequency of the wanted channel.
bool is_wanted(double frequency_hz, double wanted_hz);

/// A log of the pings of one frequency.
SonarLog log_of_ek(const std::vector<EkPing>& pings, std::size_t most_pings,
                   std::optional<double> frequency_hz);

}  // namespace sonarsim
