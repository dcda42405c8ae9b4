#pragma once

#include <array>

namespace sonarsim {

// The instrument that `model: calibrated` simulates, with its defaults. Names are the YAML keys.

/// The echo model of a sonar: the paper's, docs/model.md, or the calibrated one,
/// docs/calibrated.md.
enum class ModelKind { paper, calibrated };

/// What sound is sent and heard with. No key: it follows from the kind of sonar.
enum class Aperture {
    line,    ///< an array across, whose beams are formed
    sides,   ///< two arrays along track, each looking to its side
    piston,  ///< a disc
    head     ///< an array across that sends and hears straight ahead, and is turned
};

/// How the beams of a fan are spread.
enum class BeamSpread { angle, sine };

enum class SpeckleMode {
    scene,  ///< of scatterers that stay where they are
    ping,   ///< drawn anew for every ping
    none    ///< the expected energy
};

enum class Companding { gamma, log, linear };

struct BeamConfig {
    Aperture aperture = Aperture::line;
    double width_deg = 1.0;       ///< between half-power points, one way
    double side_lobe_db = -13.3;  ///< the highest one of an array; sets the taper
    /// Errors of phase at the ends of the aperture: quadratic, cubic, quartic.
    std::array<double, 3> aberration_rad{};
    BeamSpread spread = BeamSpread::angle;
    double view_azimuth_deg = 0.0;     ///< full angle that a line array hears; 0: azimuth_deg
    double elevation_width_deg = 0.0;  ///< half-power, there and back; 0: the same all over
    double elevation_side_lobe_db = -13.3;
    double across_width_deg = 50.0;  ///< of a side: half-power, one way, across the track
    double tilt_deg = 20.0;          ///< of a side: its axis below the sensor's y axis

    bool operator==(const BeamConfig&) const = default;
};

struct PulseConfig {
    double resolution_m = 0.0;    ///< half-power width of a point's echo in range; 0: one bin
    double side_lobe_db = -30.0;  ///< of the pulse after compression

    bool operator==(const PulseConfig&) const = default;
};

struct SpeckleConfig {
    SpeckleMode mode = SpeckleMode::scene;
    double per_cell = 4.0;       ///< scatterers per resolution cell
    double clutter_shape = 0.0;  ///< nu of the K-distribution; 0: Rayleigh
    double clutter_m = 0.1;      ///< edge of the cells that share one strength

    bool operator==(const SpeckleConfig&) const = default;
};

struct ReceiverConfig {
    double noise_db = -100.0;        ///< power in a beam
    double common_mode_db = -300.0;  ///< power of the noise that all elements share
    double tvg_log = 40.0;           ///< k of k log10 r
    bool tvg_absorption = true;      ///< 2 alpha r
    double tvg_from_m = 0.0;         ///< nearer than this the gain is that of this range
    double full_scale_db = 0.0;      ///< the highest echo level after TVG that is not clipped
    Companding companding = Companding::gamma;
    double gamma = 0.5;            ///< value = (amplitude / full scale)^gamma
    double dynamic_range_db = 60;  ///< of `log`
    int bits = 8;

    bool operator==(const ReceiverConfig&) const = default;
};

struct InstrumentConfig {
    double frequency_hz = 1e6;
    double source_level_db = 0.0;
    BeamConfig beam;
    PulseConfig pulse;
    SpeckleConfig speckle;
    ReceiverConfig receiver;

    bool operator==(const InstrumentConfig&) const = default;
};

}  // namespace sonarsim
