#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.h"
#include "input/mission/limits.h"

// The keys of scene.particles, as in mission.h.

namespace sonarsim {

enum class ParticleKind { points, fish, bubbles };
enum class ParticleRegion { box, ellipsoid };

/// Point targets in the water. Pairs are limits of uniform draws.
struct ParticlesConfig {
    std::string name;        ///< the targets are NAME_1, NAME_2, ...
    std::string class_name;  ///< "": the name
    std::optional<std::array<double, 2>> target_strength_db = {};  ///< points; dB re 1 m^2
    std::array<double, 2> length_m{};                              ///< fish; 0: none
    std::array<double, 2> radius_m{};                              ///< bubbles; 0: none
    std::array<double, 2> count{};
    ParticleRegion region = ParticleRegion::box;
    std::array<double, 3> position_m{};  ///< middle of the region, world
    std::array<double, 3> size_m{};      ///< from end to end along x, y and z
    std::array<double, 3> drift_m_s{};
    double rise_m_s = 0.0;  ///< for bubbles, which come back at the bottom of the region
    Location place = {};

    const std::string& class_or_name() const { return class_name.empty() ? name : class_name; }
    ParticleKind kind() const {
        return length_m[0] > 0.0   ? ParticleKind::fish
               : radius_m[0] > 0.0 ? ParticleKind::bubbles
                                   : ParticleKind::points;
    }
};

/// The most particles of a group.
inline constexpr double max_particles = 1e6;
/// Larger groups are one object of the labels each.
inline constexpr double max_single_particles = 100;

inline constexpr auto particle_regions = choices_of<ParticleRegion>("box", "ellipsoid");

/// From a grain of dust to a ship.
inline constexpr Limits target_strengths_db{-200.0, 60.0};

void describe(auto& v, ParticlesConfig& c) {
    v.text("name", c.name,
           "name of the group; single targets are the instances NAME_1, NAME_2 and so on",
           required);
    v.text("class", c.class_name, "class of the targets, for labels; default: NAME");
    v.number("target_strength_db", c.target_strength_db, target_strengths_db,
             "target strength of points, dB re 1 m^2");
    v.number("length_m", c.length_m, between(0, 30),
             "in place of it, the length of fish, which decides it with the sonar's frequency");
    v.number("radius_m", c.radius_m, between(0, 0.1), "likewise, the radius of bubbles of air");
    v.number("count", c.count, {0, max_particles},
             "number of targets; groups of 100 or more are one object of the labels");
    v.choice("region", c.region, particle_regions,
             "shape of the region in which the targets are at the first ping, evenly distributed");
    v.array("position_m", c.position_m, any_position_m, "middle of the region in the world",
            required);
    v.array("size_m", c.size_m, any_position_m, "size of the region along x, y and z");
    v.array("drift_m_s", c.drift_m_s, {-100, 100}, "velocity of all targets");
    v.number("rise_m_s", c.rise_m_s, between(0, 10),
             "speed at which bubbles rise, in addition; at the top of the region they start again "
             "at its bottom");
    v.require((c.length_m[1] > 0.0) + (c.radius_m[1] > 0.0) + c.target_strength_db.has_value() == 1,
              {"target_strength_db", "length_m", "radius_m"},
              "targets need one of target_strength_db, length_m and radius_m");
    v.require(c.target_strength_db || c.length_m[0] > 0.0 || c.radius_m[0] > 0.0,
              {"length_m", "radius_m"}, "length_m and radius_m must be above 0");
    v.require(c.kind() == ParticleKind::bubbles || c.rise_m_s == 0.0, {"rise_m_s"},
              "rise_m_s is for bubbles, which have a radius_m; others have a drift_m_s");
    v.require(c.count[1] > 0.0, {"count"}, "'count' must be above 0");
    v.require(c.count[0] == std::floor(c.count[0]) && c.count[1] == std::floor(c.count[1]),
              {"count"}, "'count' must be a whole number or two of them");
    v.require(c.size_m[0] >= 0.0 && c.size_m[1] >= 0.0 && c.size_m[2] >= 0.0, {"size_m"},
              "size_m must not be negative");
    v.require(c.rise_m_s == 0.0 || c.size_m[2] > 0.0, {"rise_m_s", "size_m"},
              "bubbles that rise need a region with a height: size_m");
}

}  // namespace sonarsim
