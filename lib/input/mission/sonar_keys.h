#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "input/mission/instrument.h"
#include "input/mission/limits.h"

// The keys of a sonar, with their defaults and their descriptions as in mission.h.

namespace sonarsim {

/// The position of a sonar on the vehicle, relative to the default mount of its kind.
struct MountConfig {
    std::array<double, 3> translation_m{};  ///< vehicle frame
    std::array<double, 3> rpy_deg{};        ///< roll, pitch, yaw; applied after the default mount
};

enum class MultipathMethod { none, cluster, exact };

/// Multipath via a second surface, Eq. 1-3. Off by default, since it adds half of a ping's time.
struct MultipathConfig {
    MultipathMethod method = MultipathMethod::none;
    int epsilon_bins = 5;  ///< size of a cluster in range, beam and elevation
    /// Largest angle between normals within a cluster. The paper's 15 miss more than 5 % of the
    /// bins on a rough sea floor; 5 miss 2 % and take a tenth more rays.
    double delta_deg = 5.0;
    bool operator==(const MultipathConfig&) const = default;
};

/// The groups in which the beams of a fan transmit: neighbours, or every n-th beam.
enum class ShutterOrder { in_turn, interleaved };

/// A sonar whose beams transmit in groups, one after the other.
struct ShutterConfig {
    int groups = 1;  ///< 1: all beams transmit at once
    ShutterOrder order = ShutterOrder::in_turn;
    double period_s = 0.0;  ///< from one group to the next; 0: the two-way time of range_max_m
};

/// Random terms of the paper's model; zero switches a term off.
struct NoiseConfig {
    double range_lambda_m = 0.0;   ///< mean of the exponential range noise, Eq. 7
    double scatterer_m = 0.02;     ///< edge of the cells that share one draw of the range noise
    double add_sigma = 0.0;        ///< Rayleigh scale of the additive noise, Eq. 11
    double mult_sigma = 0.0;       ///< standard deviation of the multiplicative noise, Eq. 13
    bool scale_with_range = true;  ///< additive noise grows with r^2 and the lobe, Eq. 10
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

inline constexpr auto streak_modes = choices_of<StreakMode>("none", "add", "reduce");

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

/// The model that turns the visible surface into an image: docs/model.md or docs/calibrated.md.
enum class ModelKind { paper, calibrated };

/// The models by name; the first is the default.
inline constexpr auto echo_models = choices_of<ModelKind>("paper", "calibrated");

/// The kinds of sonar; the table in simulate/sonar/kinds.h defines them.
enum class SonarKind { imaging, profiling, sidescan, echosounder, scanning };

struct SonarConfig {
    std::string name;  ///< the key below `sensors`
    SonarKind kind = SonarKind::imaging;
    MountConfig mount;
    int every = 1;                ///< the sonar pings at every n-th pose
    bool moves_in_ping = false;   ///< the sonar moves during a ping
    ShutterConfig shutter;        ///< imaging sonars
    double azimuth_deg = 120.0;   ///< full angle
    double elevation_deg = 20.0;  ///< full angle
    double opening_deg = 30.0;    ///< full angle of a cone, in place of azimuth and elevation
    double sector_deg = 360.0;    ///< full angle that a turning head covers
    double step_deg = 0.9;        ///< angle that the head turns from ping to ping
    double range_min_m = 0.1;
    double range_max_m = 10.0;
    int range_bins = 512;
    int azimuth_bins = 512;
    MultipathConfig multipath;
    NoiseConfig noise;
    StreaksConfig streaks;
    std::filesystem::path preset;  ///< empty after reading: its keys are filled in
    ModelKind model = ModelKind::paper;
    InstrumentConfig instrument;  ///< for the calibrated model only
};

/// The keys of one kind of sonar in a mission. lib/simulate/sonar defines the kinds and depends on
/// lib/input/mission, so callers that read or write a mission pass the keys of the kinds.
struct SonarKeys {
    SonarKind kind;
    std::string_view name;
    SonarConfig defaults;

    // Keys that only some kinds have.
    bool azimuth = true;        ///< azimuth_deg
    bool elevation = true;      ///< elevation_deg
    bool opening = false;       ///< opening_deg
    bool azimuth_bins = false;  ///< azimuth_bins
    bool range_noise = true;    ///< noise.range_lambda_m may be above 0
    bool head = false;          ///< sector_deg and step_deg
};

/// All kinds, in the order in which messages name them.
using SonarKeyTable = std::span<const SonarKeys>;

inline constexpr auto multipath_methods = choices_of<MultipathMethod>("none", "cluster", "exact");

inline constexpr auto shutter_orders = choices_of<ShutterOrder>("in_turn", "interleaved");

void describe(auto& v, ShutterConfig& c) {
    v.number("groups", c.groups, between(1, 64),
             "number of groups in which the beams transmit, one after the other; a ping takes "
             "nearly that many times as long to render");
    v.choice("order", c.order, shutter_orders,
             "`in_turn`: a group is a part of the sector, from starboard to port; `interleaved`: "
             "every n-th beam");
    v.number("period_s", c.period_s, between(0, 10),
             "time from one group to the next; 0: until the sound of range_max_m is back");
}

void describe(auto& v, MountConfig& c) {
    v.array("translation_m", c.translation_m, any_position_m,
            "position of the sonar in the vehicle's frame");
    v.array("rpy_deg", c.rpy_deg, any_angle_deg, "roll, pitch and yaw on top of the default mount");
}

void describe(auto& v, MultipathConfig& c) {
    v.choice("method", c.method, multipath_methods,
             "multipath via a second surface: `cluster` traces one ray for a cluster of samples, "
             "`exact` one for every sample");
    v.number("epsilon_bins", c.epsilon_bins, between(0, 8192),
             "size of a cluster in range, azimuth and elevation bins");
    v.number("delta_deg", c.delta_deg, between(0, 180),
             "largest angle between the normals within a cluster");
}

/// Checks that the angles of a calibrated sonar hold its beam.
void require_insonified(auto& v, const SonarConfig& c) {
    const BeamConfig& beam = c.instrument.beam;
    const bool forward = beam.aperture == Aperture::line || beam.aperture == Aperture::head;
    v.require(!forward || c.azimuth_deg < 180.0, {"azimuth_deg", "model"},
              "the line array of the calibrated model looks forward: azimuth_deg must be below "
              "180");
    v.require(beam.view_azimuth_deg == 0.0 || beam.view_azimuth_deg >= c.azimuth_deg,
              {"azimuth_deg", "instrument"},
              "instrument.beam.view_azimuth_deg must be 0 or at least azimuth_deg");
    v.require(beam.aperture != Aperture::head || c.azimuth_deg >= beam.width_deg,
              {"azimuth_deg", "instrument"},
              "azimuth_deg limits what a calibrated scanning sonar insonifies: it must be at "
              "least instrument.beam.width_deg; 2.5 times the width holds the main lobe, 4 "
              "times the first side lobes");
    v.require(beam.aperture != Aperture::port_starboard || c.elevation_deg >= beam.width_deg,
              {"elevation_deg", "instrument"},
              "elevation_deg limits what a calibrated side-scan sonar insonifies: it must be "
              "at least instrument.beam.width_deg; a few times the width holds the side lobes");
    v.require(beam.aperture != Aperture::piston || c.opening_deg >= beam.width_deg,
              {"opening_deg", "instrument"},
              "opening_deg limits what a calibrated echosounder insonifies: it must be at "
              "least instrument.beam.width_deg; 3 times the width holds the main lobe");
}

void describe_motion(auto& v, SonarConfig& c) {
    v.flag("moves_in_ping", c.moves_in_ping,
           "the sonar moves and turns during a ping; otherwise it is at rest. Objects and targets "
           "in the water always are");
    if (c.kind == SonarKind::imaging) {
        v.section("shutter", c.shutter, "beams that transmit one after the other");
        v.require(c.shutter.groups == 1 || c.moves_in_ping, {"shutter", "moves_in_ping"},
                  "shutter.groups needs moves_in_ping: true: a sonar at rest during a ping has all "
                  "beams from one pose");
        v.require(c.shutter.groups <= c.azimuth_bins, {"shutter", "azimuth_bins"},
                  "shutter.groups must be at most azimuth_bins");
    }
}

void describe(auto& v, SonarConfig& c) {
    const SonarKeys& keys = v.one_of("kind", c, "the kind of sonar");
    v.path("preset", c.preset,
           "YAML file with keys of this section, such as those of configs/sensors; keys given here "
           "override those of the file");
    v.section("mount", c.mount, "where the sonar sits on the vehicle");
    v.number("every", c.every, at_least(1), "the sonar pings at every n-th pose");
    describe_motion(v, c);
    if (keys.opening)
        v.number("opening_deg", c.opening_deg, between(1e-3, 180), "full angle of the cone");
    if (keys.azimuth)
        v.number("azimuth_deg", c.azimuth_deg, between(1e-3, 360), "full angle in azimuth");
    if (keys.elevation)
        v.number("elevation_deg", c.elevation_deg, between(1e-3, 180), "full angle in elevation");
    if (keys.head) {
        v.number(
            "sector_deg", c.sector_deg, between(1e-2, 360),
            "full angle that the head covers; at 360 it keeps turning, below it sweeps to and fro");
        v.number(
            "step_deg", c.step_deg, between(1e-2, 360),
            "angle that the head turns from ping to ping, rounded so that it divides the sector");
        v.require(c.step_deg <= c.sector_deg, {"sector_deg", "step_deg"},
                  "step_deg must be at most sector_deg");
    }
    v.number("range_min_m", c.range_min_m, at_least(0), "nearest slant range, one way");
    v.number("range_max_m", c.range_max_m, above(0), "farthest slant range, one way");
    // 8192 x 8192 bins are 2^26, the largest image that is rendered.
    v.number("range_bins", c.range_bins, between(1, 8192),
             "number of range bins of a ping; for a side-scan sonar, of each side");
    if (keys.azimuth_bins)
        v.number("azimuth_bins", c.azimuth_bins, between(1, 8192), "number of beams of a ping");
    v.section("multipath", c.multipath, "multipath via a second surface");
    v.choice(
        "model", c.model, echo_models,
        "echo model: the paper's, or the calibrated one, which gives what the instrument measures");
    if (c.model == ModelKind::calibrated) {
        v.section("instrument", c.instrument, "the instrument of the calibrated model");
        require_insonified(v, c);
    }
    if (c.model == ModelKind::paper) {
        v.section("noise", c.noise, "the random terms of the paper's model");
        v.section("streaks", c.streaks, "azimuth streaks of the paper's model");
        v.require(!c.moves_in_ping || keys.azimuth_bins, {"moves_in_ping", "model"},
                  "moves_in_ping of a side-scan, echosounder or scanning sonar needs model: "
                  "calibrated; the paper's beams have no pattern that turns during a ping");
    }
    v.require(keys.range_noise || c.noise.range_lambda_m == 0.0, {"noise"},
              "a side-scan sonar has no range noise: range_lambda_m must be 0");
    v.require(c.range_min_m < c.range_max_m, {"range_min_m", "range_max_m"},
              "range_min_m must be below range_max_m");
    v.require((c.range_max_m - c.range_min_m) / c.range_bins > 1e-6,
              {"range_min_m", "range_max_m", "range_bins"},
              "range bins must be wider than a micrometre");
    v.require(
        c.kind != SonarKind::sidescan ||
            c.range_min_m <= 65536.0 * (c.range_max_m - c.range_min_m) / c.range_bins,
        {"range_min_m", "range_max_m", "range_bins"},
        "a side-scan's waterfall begins at nadir: range_min_m must be at most 65536 range bins");
}

}  // namespace sonarsim
