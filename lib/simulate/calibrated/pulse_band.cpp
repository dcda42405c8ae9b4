#include "simulate/calibrated/pulse_band.h"

#include <algorithm>

#include "simulate/calibrated/directivity.h"
#include "simulate/calibrated/line_array.h"

namespace sonarsim {

PulseBand pulse_band(const PulseConfig& pulse, double bin_m, double sound_speed_m_s) {
    const double resolution_m = pulse.resolution_m > 0.0 ? pulse.resolution_m : bin_m;
    // An array of any small half-power width: its length in wavelengths times this width is k.
    constexpr double unit_width = 1e-3;
    const LineArray band = line_array(unit_width, pulse.side_lobe_db);
    const double k = band.wavelengths * unit_width;
    PulseBand out;
    out.sweep_hz = k * sound_speed_m_s / (2.0 * resolution_m);
    out.noise_hz = taper_loss(band) / std::max(pulse.duration_s, 1.0 / out.sweep_hz);
    out.length_m = taper_loss(band) * resolution_m / k;
    return out;
}

}  // namespace sonarsim
