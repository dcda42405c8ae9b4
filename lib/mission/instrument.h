#pragma once

#include <array>
#include <optional>
#include <vector>

namespace sonarsim {

// The instrument that `model: calibrated` simulates, with its defaults. Names are the YAML keys.

/// The volume scattering of the water, by its content. `automatic`: the usual water of each
/// instrument.
enum class WaterContent { automatic, none, clear, coastal, plankton, plume };

/// The transducer's shape. It has no key: it follows from the kind of sonar.
enum class Aperture {
    line,            ///< an array across track that forms beams
    port_starboard,  ///< two arrays along track, one for each side
    piston,          ///< a circular disc
    head             ///< a turning array, across the boresight, that sends and receives ahead
};

/// The quantity in which the beams of a fan have equal steps.
enum class BeamSpacing { equal_angle, equal_sine };

enum class SpeckleMode {
    scene,  ///< scatterers stay in place in the scene
    ping,   ///< scatterers are drawn for every ping
    none    ///< no speckle, the mean power
};

enum class Companding { gamma, log, linear };

/// The errors of an array's elements, which are drawn once for each instrument.
struct ElementsConfig {
    double gain_error_db = 0.0;    ///< standard deviation
    double phase_error_deg = 0.0;  ///< standard deviation
    int serial = 0;                ///< one instrument of its type

    bool exist() const { return gain_error_db > 0.0 || phase_error_deg > 0.0; }
    bool operator==(const ElementsConfig&) const = default;
};

struct BeamConfig {
    Aperture aperture = Aperture::line;
    double width_deg = 1.0;       ///< one-way half-power beamwidth
    double side_lobe_db = -13.3;  ///< highest side lobe of the array; sets the taper
    /// Phase errors at the ends of the aperture: quadratic, cubic, quartic.
    std::array<double, 3> aberration_rad{};
    BeamSpacing spread = BeamSpacing::equal_angle;
    double view_azimuth_deg = 0.0;  ///< full azimuth that a line array insonifies; 0: azimuth_deg
    double elevation_width_deg = 0.0;  ///< two-way half-power width; 0: constant pattern
    double elevation_side_lobe_db = -13.3;
    double across_width_deg = 50.0;  ///< port_starboard: one-way half-power width across track
    double tilt_deg = 20.0;          ///< port_starboard: depression of the axes
    ElementsConfig elements = {};

    bool operator==(const BeamConfig&) const = default;
};

struct PulseConfig {
    double resolution_m = 0.0;    ///< half-power width of a point target in range; 0: one bin
    double duration_s = 0.0;      ///< transmitted pulse; 0: that of a pulse without a code
    double side_lobe_db = -30.0;  ///< highest range side lobe after compression

    bool operator==(const PulseConfig&) const = default;
};

struct SpeckleConfig {
    SpeckleMode mode = SpeckleMode::scene;
    double clutter_shape = 0.0;  ///< nu of the K-distribution; 0: Rayleigh
    double clutter_m = 0.1;      ///< edge of the cells that share one clutter strength

    bool operator==(const SpeckleConfig&) const = default;
};

/// The rule by which several samples become the one that is delivered.
enum class SampleRule { maximum, mean, rms };

struct ReceiverConfig {
    std::optional<double> noise_db;  ///< noise power in a beam; empty: by instrument_levels()
    double common_mode_db = -300.0;  ///< power of the noise that all elements share
    double tvg_log = 40.0;           ///< spreading factor k of k log10 r
    bool tvg_absorption = true;      ///< TVG has the term 2 alpha r
    double tvg_from_m = 0.0;         ///< TVG is constant at shorter ranges
    /// Highest echo level after TVG that is not clipped; empty: by instrument_levels().
    std::optional<double> full_scale_db;
    Companding companding = Companding::gamma;
    double gamma = 0.5;            ///< value = (amplitude / full scale)^gamma
    double dynamic_range_db = 60;  ///< for Companding::log
    int bits = 8;
    int samples = 1;  ///< for each range bin
    SampleRule combine = SampleRule::maximum;
    int looks = 1;              ///< their powers are averaged
    double offset = 0.0;        ///< subtracted from raw/, as a share of its largest value
    double ring_down_db = 0.0;  ///< at range 0, above the noise; 0: none
    double ring_down_m = 0.1;   ///< range over which it falls by 10 dB
    double beam_gain_db = 0.0;  ///< standard deviation of the gains of the beams

    bool operator==(const ReceiverConfig&) const = default;
};

/// Echoes and noise of the sea lie above 0 dB re 1 uPa, so a lower level must be relative to the
/// source level. -300 means none.
constexpr bool is_relative_level(double level_db) {
    return level_db < 0.0 && level_db > -300.0;
}

constexpr bool has_relative_level(const ReceiverConfig& receiver) {
    return is_relative_level(receiver.noise_db.value_or(0.0)) ||
           is_relative_level(receiver.full_scale_db.value_or(0.0)) ||
           is_relative_level(receiver.common_mode_db);
}

/// 120 dB re 1 uPa at 1 m are 8 microwatts of sound. A smaller number is no source level but the
/// reference of the other levels.
constexpr bool is_relative_source(double source_level_db) {
    return source_level_db < 120.0;
}

struct InstrumentConfig {
    double frequency_hz = 1e6;
    std::optional<double> source_level_db;  ///< empty: by instrument_levels()
    BeamConfig beam;
    PulseConfig pulse;
    SpeckleConfig speckle;
    ReceiverConfig receiver;
    WaterContent usual_water = WaterContent::none;  ///< for WaterContent::automatic
    bool below_bottom = false;  ///< the volume of the sediment echoes behind its surface

    bool operator==(const InstrumentConfig&) const = default;
};

}  // namespace sonarsim
