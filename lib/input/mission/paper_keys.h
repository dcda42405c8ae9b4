#pragma once

#include "input/mission/limits.h"

// The keys of the paper's model, with their defaults and their descriptions as in mission.h.

namespace sonarsim {

/// Random terms of the paper's model; zero switches a term off.
struct NoiseConfig {
    double range_lambda_m = 0.0;   ///< mean of the exponential range noise, Eq. 7
    double scatterer_m = 0.02;     ///< edge of the cells that share one draw of the range noise
    double add_sigma = 0.0;        ///< Rayleigh scale of the additive noise, Eq. 11
    double mult_sigma = 0.0;       ///< standard deviation of the multiplicative noise, Eq. 13
    bool scale_with_range = true;  ///< additive noise grows with r^2 and the lobe, Eq. 10
    double lobe_sigma_deg = 0.0;   ///< width of that lobe; 0 means azimuth_deg / 8
    double gain = 0.0;             ///< m of Eq. 12; 0 means the paper's value for the kind

    bool operator==(const NoiseConfig&) const = default;
};

enum class StreakMode { none, add, reduce };

/// Azimuth streaks, Eq. 14-15.
struct StreaksConfig {
    StreakMode mode = StreakMode::none;
    double threshold = 0.08;  ///< share of a range row's echo area at normal incidence
    double angle_deg = 8.0;   ///< largest angle that counts as normal incidence

    bool operator==(const StreaksConfig&) const = default;
};

inline constexpr Choice<StreakMode> streak_modes[]{
    {"none", StreakMode::none}, {"add", StreakMode::add}, {"reduce", StreakMode::reduce}};

void describe(auto& v, NoiseConfig& c) {
    v.number("range_lambda_m", c.range_lambda_m, at_least(0),
             "mean of the exponential range noise; 0 is off, and a side-scan sonar has none");
    // The number of a cell has 21 bits (core/random.h), so draws repeat after 210 m if the edge
    // is a tenth of a millimetre, and sooner with shorter edges.
    v.number("scatterer_m", c.scatterer_m, between(1e-4, 1e3),
             "edge of the cells of the scene that share one draw of the range noise");
    v.number("add_sigma", c.add_sigma, at_least(0),
             "scale of the Rayleigh noise that is added to every pixel; 0 is off");
    v.number("mult_sigma", c.mult_sigma, at_least(0),
             "standard deviation of the normal noise that multiplies every pixel; 0 is off");
    v.flag("scale_with_range", c.scale_with_range,
           "the added noise grows with range and towards the boresight");
    v.number("lobe_sigma_deg", c.lobe_sigma_deg, between(0, 360),
             "angular width of the added noise's growth towards the boresight; 0 means an eighth "
             "of the full angle in azimuth");
    v.number("gain", c.gain, at_least(0),
             "factor m of Eq. 12 that multiplies every pixel; 0 means the paper's: 0.5 for imaging "
             "and profiling sonars, which halves their images, and 1 for others");
}

void describe(auto& v, StreaksConfig& c) {
    v.choice("mode", c.mode, streak_modes,
             "azimuth streaks: `add` brightens a range row with too many echoes at normal "
             "incidence, `reduce` darkens it");
    v.number("threshold", c.threshold, between(0, 1),
             "share of a row's echo area at normal incidence from which on the row is a streak");
    v.number("angle_deg", c.angle_deg, between(0, 90),
             "largest angle of incidence that counts as normal");
}

}  // namespace sonarsim
