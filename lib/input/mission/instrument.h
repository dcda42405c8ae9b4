#pragma once

#include <array>
#include <optional>
#include <span>

#include "input/mission/limits.h"

// The keys of the instrument that `model: calibrated` simulates, as in mission.h.

namespace sonarsim {

/// The content of the water, which scatters. `automatic`: the usual water of each instrument.
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

/// When the scatterers of the speckle are drawn: once, for every ping, or never (mean powers).
enum class SpeckleMode { scene, ping, none };

enum class Companding { gamma, log, linear };

/// The errors of an array's elements, which are drawn once for each instrument.
struct ElementsConfig {
    double gain_error_db = 0.0;    ///< standard deviation
    double phase_error_deg = 0.0;  ///< standard deviation
    int serial = 0;                ///< one instrument of its type

    bool exist() const { return gain_error_db > 0.0 || phase_error_deg > 0.0; }
};

inline constexpr double no_lobe_floor_db = -120.0;

struct BeamConfig {
    Aperture aperture = Aperture::line;
    double width_deg = 1.0;       ///< one-way half-power beamwidth
    double side_lobe_db = -13.3;  ///< highest side lobe of the array; sets the taper
    /// Phase errors at the ends of the aperture: quadratic, cubic, quartic.
    std::array<double, 3> aberration_rad{};
    double focus_m = 0.0;  ///< range at which a line array is in focus; 0: at every range
    BeamSpacing spread = BeamSpacing::equal_angle;
    double view_azimuth_deg = 0.0;  ///< full azimuth that a line array insonifies; 0: azimuth_deg
    double elevation_width_deg = 0.0;  ///< two-way half-power width; 0: constant pattern
    double elevation_side_lobe_db = -13.3;
    double across_width_deg = 50.0;  ///< port_starboard: one-way half-power width across track
    double tilt_deg = 20.0;          ///< port_starboard: depression of the axes
    /// Two-way power between the lobes, re the axis: in elevation, of a side-scan across the track.
    double lobe_floor_db = no_lobe_floor_db;
    ElementsConfig elements = {};
};

struct PulseConfig {
    double resolution_m = 0.0;    ///< half-power width of a point target in range; 0: one bin
    double duration_s = 0.0;      ///< transmitted pulse; 0: that of a pulse without a code
    double side_lobe_db = -30.0;  ///< highest range side lobe after compression
};

struct SpeckleConfig {
    SpeckleMode mode = SpeckleMode::scene;
    double texture = 1.0;  ///< factor on the patches in dB (simulate/calibrated/speckle/speckle.h)
};

/// The value that is delivered of several samples.
enum class SampleRule { maximum, mean };

struct ReceiverConfig {
    std::optional<double> noise_db;      ///< noise power in a beam; empty: by instrument_levels()
    double noise_figure_db = 6.0;        ///< noise of the electronics, for noise_db: auto
    double converter_noise_db = -300.0;  ///< behind the gain, re full scale
    double gain_db = 0.0;                ///< raises all values, as a user's gain does
    double tvg_log = 40.0;               ///< spreading factor k of k log10 r
    bool tvg_absorption = true;          ///< TVG has the term 2 alpha r
    double tvg_from_m = 0.0;             ///< TVG is constant at shorter ranges
    /// Highest echo level after TVG that is not clipped; empty: by instrument_levels().
    std::optional<double> full_scale_db;
    Companding companding = Companding::gamma;
    double gamma = 0.5;            ///< value = (amplitude / full scale)^gamma
    double dynamic_range_db = 60;  ///< for Companding::log
    double knee = 1.0;             ///< value above which highlights are compressed
    int bits = 8;
    double samples = 1.0;  ///< independent samples of a range bin
    SampleRule combine = SampleRule::maximum;
    double expansion = 1.0;           ///< factor on the decibels of a sample about their mean
    double offset = 0.0;              ///< subtracted from raw/, as a share of its largest value
    double ring_down_db = 0.0;        ///< at range 0, above the noise; 0: none
    double ring_down_m = 0.1;         ///< range over which it falls by 10 dB
    double beam_gain_db = 0.0;        ///< standard deviation of the gains of the channels
    int channel_beams = 1;            ///< adjacent beams that one channel receives in turn
    double edge_loss_db = 0.0;        ///< loss of echoes at the edges of a fan
    double reverberation_db = -20.0;  ///< energy of the tail of an echo over the echo's
    double reverberation_s = 0.0;     ///< time in which it falls by 60 dB; 0: none
    double interference_per_s = 0.0;  ///< rate of foreign pulses
    double interference_db = 20.0;    ///< their level above the noise
    double interference_s = 0.0;      ///< their length; at least that of the own pulse
    double loss_share = 0.0;          ///< pings that are weakened, as by bubbles
    double loss_db = 10.0;            ///< the mean loss of these
};

/// Echoes and noise of the sea lie above 0 dB re 1 uPa: lower levels are relative. -300: none.
constexpr bool is_relative_level(double level_db) {
    return level_db < 0.0 && level_db > -300.0;
}

constexpr bool has_relative_level(const ReceiverConfig& receiver) {
    return is_relative_level(receiver.noise_db.value_or(0.0)) ||
           is_relative_level(receiver.full_scale_db.value_or(0.0));
}

/// 120 dB re 1 uPa at 1 m are 8 microwatts. A smaller number is the reference of other levels.
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
};

inline constexpr auto beam_spacings = choices_of<BeamSpacing>("angle", "sine");
inline constexpr auto speckle_modes = choices_of<SpeckleMode>("scene", "ping", "none");
inline constexpr auto compandings = choices_of<Companding>("gamma", "log", "linear");

inline constexpr auto water_contents =
    choices_of<WaterContent>("auto", "none", "clear", "coastal", "plankton", "plume");
inline constexpr Limits any_level_db{-300.0, 300.0};
inline constexpr auto sample_rules = choices_of<SampleRule>("max", "mean");
/// Levels above the noise.
inline constexpr Limits raised_levels_db{0.0, 200.0};
/// From a Hamming taper to no taper.
inline constexpr Limits side_lobes_db{-42.0, -13.0};

void describe(auto& v, ElementsConfig& c) {
    v.number("gain_error_db", c.gain_error_db, between(0, 6),
             "standard deviation of the gains of the array's elements");
    v.number("phase_error_deg", c.phase_error_deg, between(0, 60),
             "standard deviation of their phases");
    v.number("serial", c.serial, between(0, 2e9),
             "serial number of the instrument; each has errors of its own, the same in all its "
             "datasets");
}

void describe(auto& v, BeamConfig& c) {
    v.number("width_deg", c.width_deg, between(0.05, 60),
             "one-way half-power beamwidth: of the receiving line array, across a scanning sonar's "
             "beam, along track of a side-scan sonar, or of an echosounder's cone");
    if (c.aperture == Aperture::piston) return;
    v.number("lobe_floor_db", c.lobe_floor_db, between(no_lobe_floor_db, 0),
             "two-way power that fills the nulls in elevation, or of a side-scan across the track, "
             "where transmitter, receiver and housing differ; -120 means none");
    v.number("side_lobe_db", c.side_lobe_db, side_lobes_db,
             "highest side lobe of that array, set by its taper; -13.3 means no taper");
    if (c.aperture == Aperture::port_starboard) {
        v.number("across_width_deg", c.across_width_deg, between(5, 120),
                 "one-way half-power beamwidth of each side across the track");
        v.number("tilt_deg", c.tilt_deg, between(-90, 90),
                 "depression angle of each side's axis below the horizontal");
        return;
    }
    v.section("elements", c.elements,
              "errors of the array's elements, half a wavelength apart; they fill the nulls of "
              "its pattern");
    if (c.aperture == Aperture::line) {
        v.array("aberration_rad", c.aberration_rad, between(-100, 100),
                "phase error at the ends of the array: quadratic, cubic and quartic part");
        v.number("focus_m", c.focus_m, between(0, 1000),
                 "range at which a lens is in focus; 0: at every range");
        v.choice("spread", c.spread, beam_spacings,
                 "beam spacing: equal steps of the angle, or of its sine");
        v.number(
            "view_azimuth_deg", c.view_azimuth_deg, between(0, 180),
            "full azimuth of the surface that is insonified; 0 means azimuth_deg. A beam of a line "
            "array is a cone: at steep elevations it receives surface from greater azimuths");
    }
    v.number(
        "elevation_width_deg", c.elevation_width_deg, between(0, 120),
        "two-way half-power beamwidth in elevation; 0 means a constant pattern over elevation_deg");
    v.number("elevation_side_lobe_db", c.elevation_side_lobe_db, side_lobes_db,
             "highest two-way side lobe in elevation");
    v.require(c.elevation_width_deg == 0.0 || c.elevation_width_deg >= 0.01,
              {"elevation_width_deg"},
              "elevation_width_deg is 0, for a constant pattern, or at least 0.01");
}

void describe(auto& v, PulseConfig& c) {
    v.number("resolution_m", c.resolution_m, between(0, 1000),
             "half-power width in range of a point target's echo; 0 means one range bin");
    // Speckle cells have this length. The number of much shorter cells would overflow.
    v.require(c.resolution_m == 0.0 || c.resolution_m >= 1e-6, {"resolution_m"},
              "resolution_m is 0, for one range bin, or at least 1e-6");
    v.number("duration_s", c.duration_s, between(0, 10),
             "length of the transmitted pulse, for noise_db: auto. A pulse that is longer than its "
             "resolution is coded, and its noise is that of the long pulse; 0 means no code");
    v.number("side_lobe_db", c.side_lobe_db, side_lobes_db,
             "highest range side lobe of the compressed pulse");
}

void describe(auto& v, SpeckleConfig& c) {
    v.choice("mode", c.mode, speckle_modes,
             "`scene`: scatterers stay in place in the scene; `ping`: scatterers are drawn "
             "for every ping, which is faster; `none`: no speckle, the mean power");
    v.number("texture", c.texture, between(0, 10),
             "factor on the texture of surface, patches of stronger and weaker echoes; 0: none");
}

/// The keys of a receiver besides noise, gain and companding.
void describe_chain(auto& v, ReceiverConfig& c) {
    v.number(
        "samples", c.samples, between(1, 100),
        "independent samples of a range bin, of pulses, bands or ranges, of which one value is "
        "delivered; need not be whole");
    v.choice("combine", c.combine, sample_rules,
             "the value that is delivered: their largest or their mean power");
    v.number("expansion", c.expansion, between(0.5, 3),
             "factor by which the instrument stretches the decibels of a sample about their mean");
    v.number("offset", c.offset, between(0, 0.9),
             "share of the largest value that is taken from the values of raw/; what would be "
             "negative is 0");
    v.number("ring_down_db", c.ring_down_db, raised_levels_db,
             "level of the transducer's ringing at range 0 above the noise; 0 means none");
    v.number("ring_down_m", c.ring_down_m, between(1e-4, 1e4),
             "range over which the ringing falls by 10 dB");
    v.number("reverberation_s", c.reverberation_s, between(0, 10),
             "time in which the reverberation behind an echo falls by 60 dB; 0 means none");
    v.number("reverberation_db", c.reverberation_db, between(-100, 0),
             "energy of the reverberation behind an echo over that of the echo");
    v.number("interference_per_s", c.interference_per_s, between(0, 1000),
             "foreign pulses per second of reception, at drawn times, in all beams; 0 means none");
    v.number("interference_db", c.interference_db, between(-20, 100),
             "mean level of a foreign pulse above the noise before TVG");
    v.number("interference_s", c.interference_s, between(0, 1),
             "length of foreign pulses, at least that of the own; noise of thrusters is long");
    v.number("loss_share", c.loss_share, between(0, 1),
             "share of the pings that are weaker, as by bubbles below a hull");
    v.number("loss_db", c.loss_db, between(0, 60),
             "mean loss of such a ping with its noise, exponentially distributed");
    v.number("beam_gain_db", c.beam_gain_db, between(0, 30),
             "standard deviation of the gains of channels, which stay from ping to ping");
    v.number("channel_beams", c.channel_beams, between(1, 4096),
             "adjacent beams that one channel receives in turn, with one gain; beams of one "
             "turn leak into each other, at -30 dB");
    v.number("edge_loss_db", c.edge_loss_db, between(0, 30),
             "loss of echoes at the edges of a fan; it grows from the middle as the square");
}

void describe(auto& v, ReceiverConfig& c) {
    v.number("noise_db", c.noise_db, any_level_db,
             "noise level in a beam before TVG, in the unit of source_level_db; `auto` "
             "computes it from frequency, pulse, beam and water.wind_m_s; -300 means none");
    v.number("noise_figure_db", c.noise_figure_db, between(0, 40),
             "noise of the electronics above heat, for noise_db: auto");
    v.number("converter_noise_db", c.converter_noise_db, between(-300, 0),
             "noise behind the TVG, as of a converter, below full_scale_db; -300 means none");
    v.number("gain_db", c.gain_db, between(-60, 60),
             "gain above full_scale_db, as set by a user: raises all values");
    v.number("tvg_log", c.tvg_log, between(0, 60), "spreading factor k of the TVG k log10 r");
    v.flag("tvg_absorption", c.tvg_absorption, "TVG compensates absorption");
    v.number("tvg_from_m", c.tvg_from_m, at_least(0),
             "range at which TVG starts; at shorter ranges the gain is constant");
    v.number(
        "full_scale_db", c.full_scale_db, any_level_db,
        "echo level after TVG that becomes the largest value of raw/; with `auto` a "
        "bottom of sand at half of the range has 1 % of its speckle above it, or the mean at a "
        "third of it if companding is not gamma; less if the noise at range_max_m would else "
        "be above two thirds");
    v.choice(
        "companding", c.companding, compandings,
        "law that turns an amplitude A into a value of raw/: A^gamma, the decibels of A, or A");
    v.number("gamma", c.gamma, between(0.1, 2), "exponent of `gamma`");
    v.number("dynamic_range_db", c.dynamic_range_db, between(10, 200),
             "decibels between the values 0 and the largest one with `log`");
    v.number("knee", c.knee, between(0.1, 1),
             "share of the largest value above which values are compressed, as on a screen");
    v.number("bits", c.bits, between(4, 16), "bits of raw/; more than 8 make 16-bit files");
    describe_chain(v, c);
}

/// Levels are in one unit: all in dB re 1 uPa, or all relative to the source level.
void require_one_unit(auto& v, const InstrumentConfig& c) {
    const bool absolute = c.source_level_db && !is_relative_source(*c.source_level_db);
    v.require(!absolute || !has_relative_level(c.receiver), {"source_level_db", "receiver"},
              "source_level_db is in dB re 1 uPa, where a noise_db or "
              "full_scale_db below 0 makes no sense: give them in dB re 1 uPa or leave them out; "
              "or give source_level_db: 0, to which they are then relative");
}

void describe(auto& v, InstrumentConfig& c) {
    v.number("frequency_hz", c.frequency_hz, between(1e3, 1e7), "frequency of the sound");
    v.number("source_level_db", c.source_level_db, any_level_db,
             "source level, re 1 uPa at 1 m; with 0 all levels are relative to it. `auto` is that "
             "of 100 W of electric power; if another level is below 0 dB, it is 0");
    v.section("beam", c.beam, "beam pattern");
    v.section("pulse", c.pulse, "the pulse after compression");
    v.section("speckle", c.speckle, "interference of the echoes of many scatterers");
    v.section("receiver", c.receiver, "noise, TVG and the values of raw/");
    v.choice("usual_water", c.usual_water, std::span(water_contents).subspan(1),
             "content of the water if water.content is `auto`: the water in which such an "
             "instrument is used");
    v.flag("below_bottom", c.below_bottom,
           "the volume of the sediment echoes behind its surface, as a tail, in place of at it");
    require_one_unit(v, c);
}

}  // namespace sonarsim
