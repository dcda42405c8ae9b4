#include "simulate/calibrated/equation/instrument_levels.h"

#include "core/decibel.h"
#include "simulate/calibrated/equation/expected_echo.h"
#include "simulate/calibrated/signal/directivity.h"
#include "simulate/calibrated/signal/range_response.h"

namespace sonarsim {

namespace {

/// The pressure at 1 m of a watt of sound that spreads evenly, 10 log(rho c / (4 pi)) re 1 uPa.
constexpr double watt_db = 170.8;

// Shares of the largest value of raw/.
constexpr double recorded_share_of_sand = 1.0 / 3.0;
constexpr double max_share_of_noise = 2.0 / 3.0;
// Above sand a logarithmic record keeps at most this: highlights of fans need no more.
constexpr double max_headroom_of_sand_db = 37.0;
constexpr double max_headroom_below_db = 35.0;

// The noise of the sea, as the spectrum of the pressure in dB re 1 uPa^2/Hz. Shipping and
// turbulence matter only below 1 kHz and are left out.

/// Thermal noise: R. H. Mellen, "The thermal-noise limit in the detection of underwater acoustic
/// signals", J. Acoust. Soc. Am. 24 (1952), 478: -15 + 20 log f, f in kHz.
double thermal_noise_db(double frequency_hz) {
    return -15.0 + 2.0 * db_of_power(1e-3 * frequency_hz);
}

/// Noise of the wind at the surface: the fit of R. F. W. Coates, "Underwater Acoustic Systems",
/// Macmillan 1990, to the curves of G. M. Wenz, J. Acoust. Soc. Am. 34 (1962), 1936:
/// 50 + 7.5 sqrt(w) + 20 log f - 40 log(f + 0.4), f in kHz.
double wind_noise_db(double frequency_hz, double wind_m_s) {
    const double f_khz = 1e-3 * frequency_hz;
    return 50.0 + 7.5 * std::sqrt(wind_m_s) + 2.0 * db_of_power(f_khz) -
           4.0 * db_of_power(f_khz + 0.4);
}

/// The decibels from a share of the largest value of raw/ to that value.
double headroom_db(const ReceiverConfig& receiver, double share) {
    switch (receiver.companding) {
        case Companding::log:
            return (1.0 - share) * receiver.dynamic_range_db;
        case Companding::linear:
            return -2.0 * db_of_power(share);
        default:
            return -2.0 * db_of_power(share) / receiver.gamma;
    }
}

/// The decibels from the mean power of sand to the largest value of raw/. Values by `gamma` are
/// made to be seen: sand fills them. Records of decibels and of amplitudes keep a reserve.
double headroom_of_sand_db(const ReceiverConfig& receiver, Aperture aperture) {
    if (receiver.companding == Companding::gamma) return db_of_power(speckle_p99);
    return std::min(headroom_db(receiver, recorded_share_of_sand),
                    aperture == Aperture::piston ? max_headroom_below_db : max_headroom_of_sand_db);
}

void set_received_levels(const InstrumentConfig& instrument, const WaterConfig& water,
                         const View& view, InstrumentLevels& levels) {
    const ReceiverConfig& receiver = instrument.receiver;
    const ExpectedEcho echo = expected_echo(instrument, water, view);
    const auto gain_db = [&](double range_m) {
        return tvg_db(receiver, echo.absorption_db_per_m, range_m);
    };
    const double half_m = 0.5 * view.range_max_m;
    levels.sand_db = levels.source_level_db +
                     bottom_echo_db(echo, bottom_strength_db(echo, example_sand()), half_m) +
                     gain_db(half_m);
    const double noise_db = levels.noise_db + gain_db(view.range_max_m);
    levels.full_scale_db =
        receiver.full_scale_db.value_or(
            std::max(levels.sand_db + headroom_of_sand_db(receiver, instrument.beam.aperture),
                     noise_db + headroom_db(receiver, max_share_of_noise))) -
        receiver.gain_db;
}

constexpr double min_noise_db = -300.0;
constexpr double max_noise_db = 200.0;
constexpr double max_gain_db = 370.0;

}  // namespace

double tvg_db(const ReceiverConfig& receiver, double absorption_db_per_m, double range_m) {
    const double range = std::max(range_m, receiver.tvg_from_m);
    return receiver.tvg_log / 10.0 * db_of_power(range) +
           (receiver.tvg_absorption ? 2.0 * absorption_db_per_m * range : 0.0);
}

InstrumentLevels instrument_levels(const InstrumentConfig& instrument, const WaterConfig& water,
                                   const View& view) {
    const ReceiverConfig& receiver = instrument.receiver;
    InstrumentLevels out;
    out.noise_hz = pulse_band(instrument.pulse, view.bin_m(), water.sound_speed_m_s).noise_hz;
    out.receiving_directivity_db = db_of_power(receiving_directivity(instrument.beam));
    out.transmitting_directivity_db = db_of_power(transmitting_directivity(instrument.beam, view));
    out.thermal_noise_db = thermal_noise_db(instrument.frequency_hz);
    out.wind_noise_db = wind_noise_db(instrument.frequency_hz, water.wind_m_s);

    // Rules of thumb for the levels that are auto.
    constexpr double power_w = 100.0;   // electric power of the transmitter
    constexpr double efficiency = 0.5;  // acoustic by electric power of the transducer
    const double efficiency_db = db_of_power(efficiency);
    const double source_db =
        watt_db + db_of_power(power_w) + efficiency_db + out.transmitting_directivity_db;
    const double sea_db =
        db_of_power(power_of_db(out.thermal_noise_db + receiver.noise_figure_db - efficiency_db) +
                    power_of_db(out.wind_noise_db));
    const double noise_db = sea_db + db_of_power(out.noise_hz) - out.receiving_directivity_db;

    out.source_level_db =
        instrument.source_level_db.value_or(has_relative_level(receiver) ? 0.0 : source_db);
    out.relative = is_relative_source(out.source_level_db);
    const double offset_db = out.relative ? out.source_level_db - source_db : 0.0;
    out.noise_db = receiver.noise_db.value_or(noise_db + offset_db);
    set_received_levels(instrument, water, view, out);
    return out;
}

double float_headroom_db(double noise_db) {
    const double at_least = std::max(0.0, min_noise_db - noise_db);
    return std::min(at_least, max_noise_db - noise_db);
}

std::vector<float> row_gains(const ReceiverConfig& receiver, const InstrumentLevels& levels,
                             const View& view, double absorption_db_per_m, double raised_db) {
    std::vector<float> out;
    for (int i = 0; i < view.range_bins; ++i) {
        const double range = view.range_min_m + (i + 0.5) * view.bin_m();
        const double gain_db = levels.source_level_db +
                               tvg_db(receiver, absorption_db_per_m, range) - levels.full_scale_db -
                               raised_db;
        out.push_back(static_cast<float>(power_of_db(std::min(gain_db, max_gain_db))));
    }
    return out;
}

}  // namespace sonarsim
