#pragma once

// Sound in water: its absorption, and the echoes of fish and bubbles.

namespace sonarsim {

/// The water between sonar and scene.
struct WaterState {
    double temperature_c = 10.0;
    double salinity_psu = 35.0;
    double depth_m = 10.0;
    double ph = 8.0;
};

/// Absorption, dB/m: R. E. Francois and G. R. Garrison, "Sound absorption based on ocean
/// measurements", parts I and II, J. Acoust. Soc. Am. 72 (1982), 896 and 1879. Boric acid,
/// magnesium sulphate and pure water; within 5 % in the sea, 200 Hz to 1 MHz. Above 1 MHz and in
/// fresh water only the term of pure water is left, which grows with the square of the frequency.
double absorption_db_per_m(double frequency_hz, const WaterState& water);

// Backscattering cross-sections of single targets in the water, m^2; 10 log is the target strength.

/// A fish seen from above: TS = 19.1 log L - 0.9 log f - 62.0, L in cm, f in kHz. R. H. Love,
/// "Dorsal-aspect target strength of an individual fish", J. Acoust. Soc. Am. 49 (1971) 816, from
/// measurements between 15 kHz and 1 MHz.
double fish_section_m2(double length_m, double frequency_hz);

/// A bubble of air at a depth:
///
///     sigma = a^2 / ((f0^2 / f^2 - 1)^2 + (k a)^2),    f0 = sqrt(3 gamma p / rho) / (2 pi a)
///
/// (M. Minnaert 1933; H. Medwin and C. S. Clay, "Fundamentals of Acoustical Oceanography", 1998,
/// chapter 8). It includes the damping by radiation, but not by heat conduction and viscosity: near
/// resonance, real bubbles below a millimetre are weaker. From k a = 1 on it is at least a^2 / 4.
double bubble_section_m2(double radius_m, double depth_m, double density_kg_m3,
                         double sound_speed_m_s, double frequency_hz);

}  // namespace sonarsim
