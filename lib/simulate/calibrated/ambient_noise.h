#pragma once

namespace sonarsim {

// The noise of the sea, as the spectrum of the pressure in dB re 1 uPa^2/Hz. Shipping and
// turbulence matter only below 1 kHz and are left out.

/// Thermal noise: R. H. Mellen, "The thermal-noise limit in the detection of underwater acoustic
/// signals", J. Acoust. Soc. Am. 24 (1952), 478: -15 + 20 log f, f in kHz.
double thermal_noise_db(double frequency_hz);

/// Noise of the wind at the surface: the fit of R. F. W. Coates, "Underwater Acoustic Systems",
/// Macmillan 1990, to the curves of G. M. Wenz, J. Acoust. Soc. Am. 34 (1962), 1936:
/// 50 + 7.5 sqrt(w) + 20 log f - 40 log(f + 0.4), f in kHz.
double wind_noise_db(double frequency_hz, double wind_m_s);

}  // namespace sonarsim
