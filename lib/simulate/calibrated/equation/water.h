#pragma once

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

}  // namespace sonarsim
