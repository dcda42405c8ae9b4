#pragma once

#include <array>

#include "mission/limits.h"
#include "mission/mission.h"

// The keys of the calibrated model, described as in schema.h.

namespace sonarsim {

inline constexpr std::array echo_models{Choice<ModelKind>{"paper", ModelKind::paper},
                                        Choice<ModelKind>{"calibrated", ModelKind::calibrated}};
inline constexpr std::array beam_spreads{Choice<BeamSpread>{"angle", BeamSpread::angle},
                                         Choice<BeamSpread>{"sine", BeamSpread::sine}};
inline constexpr std::array speckle_modes{Choice<SpeckleMode>{"scene", SpeckleMode::scene},
                                          Choice<SpeckleMode>{"ping", SpeckleMode::ping},
                                          Choice<SpeckleMode>{"none", SpeckleMode::none}};
inline constexpr std::array compandings{Choice<Companding>{"gamma", Companding::gamma},
                                        Choice<Companding>{"log", Companding::log},
                                        Choice<Companding>{"linear", Companding::linear}};

inline constexpr Limits any_level_db{-300.0, 300.0};
/// Between a Hamming taper and none.
inline constexpr Limits side_lobes_db{-42.0, -13.0};

template <class Visitor>
void describe(Visitor& v, BeamConfig& c) {
    v.number(
        "width_deg", c.width_deg, between(0.05, 60),
        "width between half-power points, one way: of a beam of the receiving line array, of a "
        "scanning sonar's beam across, of a side-scan along track, of an echosounder's cone");
    if (c.aperture == Aperture::piston) return;
    v.number("side_lobe_db", c.side_lobe_db, side_lobes_db,
             "highest side lobe of that array, by its taper; -13.3 is without one");
    if (c.aperture == Aperture::sides) {
        v.number("across_width_deg", c.across_width_deg, between(5, 120),
                 "width of a side across the track, between half-power points, one way");
        v.number("tilt_deg", c.tilt_deg, between(-90, 90),
                 "angle by which the axis of a side points below the horizontal");
        return;
    }
    if (c.aperture == Aperture::line) {
        v.numbers("aberration_rad", c.aberration_rad, between(-100, 100),
                  "error of phase at the ends of the array: its quadratic, cubic and quartic part");
        v.choice("spread", c.spread, beam_spreads, "what is even from beam to beam");
        v.number("view_azimuth_deg", c.view_azimuth_deg, between(0, 180),
                 "full angle in azimuth of what is heard; 0 means azimuth_deg. A beam is a cone: "
                 "far above and below the sonar it hears surface at greater azimuths");
    }
    v.number("elevation_width_deg", c.elevation_width_deg, between(0, 120),
             "half-power width in elevation, there and back; 0 means the same all over "
             "elevation_deg");
    v.number("elevation_side_lobe_db", c.elevation_side_lobe_db, side_lobes_db,
             "highest side lobe in elevation, there and back");
}

template <class Visitor>
void describe(Visitor& v, PulseConfig& c) {
    v.number("resolution_m", c.resolution_m, between(0, 1000),
             "half-power width in range of the echo of a point; 0 means a range bin");
    v.number("side_lobe_db", c.side_lobe_db, side_lobes_db,
             "highest side lobe of the compressed pulse");
}

template <class Visitor>
void describe(Visitor& v, SpeckleConfig& c) {
    v.choice("mode", c.mode, speckle_modes,
             "`scene`: of scatterers that stay where they are; `ping`: drawn anew for every ping, "
             "faster; `none`: the mean");
    v.number("per_cell", c.per_cell, between(1, 30), "scatterers in a resolution cell");
    v.number("clutter_shape", c.clutter_shape, between(0, 100),
             "shape nu of K-distributed clutter; 0 means Rayleigh");
    v.number("clutter_m", c.clutter_m, between(1e-3, 1e3),
             "edge of the cells of the scene that share one strength of clutter");
}

template <class Visitor>
void describe(Visitor& v, ReceiverConfig& c) {
    v.number("noise_db", c.noise_db, any_level_db,
             "noise in a beam before TVG; in the unit of source_level_db");
    v.number("common_mode_db", c.common_mode_db, any_level_db,
             "noise that all elements share, in the beam straight ahead; -300 is none");
    v.number("tvg_log", c.tvg_log, between(0, 60), "k of the gain k log10 r");
    v.flag("tvg_absorption", c.tvg_absorption, "the gain makes up for absorption");
    v.number("tvg_from_m", c.tvg_from_m, at_least(0),
             "range at which the gain begins to grow; nearer than this it is the same");
    v.number("full_scale_db", c.full_scale_db, any_level_db,
             "echo level, after the gain, that is the largest value of raw/");
    v.choice("companding", c.companding, compandings,
             "how an amplitude A becomes a value of raw/: A^gamma, its decibels, or A");
    v.number("gamma", c.gamma, between(0.1, 2), "exponent of `gamma`");
    v.number("dynamic_range_db", c.dynamic_range_db, between(10, 200),
             "decibels between 0 and the largest value with `log`");
    v.integer("bits", c.bits, between(4, 16), "bits of raw/; more than 8 make 16-bit files");
}

template <class Visitor>
void describe(Visitor& v, InstrumentConfig& c) {
    v.number("frequency_hz", c.frequency_hz, between(1e3, 1e7), "frequency of the sound");
    v.number("source_level_db", c.source_level_db, any_level_db,
             "source level, re 1 uPa at 1 m; with 0 all levels are relative to it");
    v.section("beam", c.beam, "what a point looks like across the beams");
    v.section("pulse", c.pulse, "what a point looks like along range");
    v.section("speckle", c.speckle, "how the echoes of many scatterers interfere");
    v.section("receiver", c.receiver, "noise, gain and the numbers of raw/");
}

}  // namespace sonarsim
