#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mission/mission.h"

// What `vary` draws for every ping: numbers that neither the scene nor the view depends on. A draw
// follows from the seed, the place of its rule among `vary` and the pose.

namespace sonarsim {

/// InputError at the place of a rule whose key cannot be drawn for every ping.
void check_key_of_pings(const Mission& mission, const VaryConfig& rule);

/// The most that the draws of a rule reach to either side, or all that it chooses from, as YAML.
std::vector<std::string> extremes_of(const VaryConfig& rule);

/// Whether anything of a sensor is drawn for every ping.
bool varies_by_ping(const Mission& mission, std::string_view sensor);

/// Draws what varies of a sensor at a pose.
void draw_for_ping(const Mission& mission, std::uint32_t pose, SonarConfig& sensor);

/// How far the vehicle is off a pose.
VehicleConfig vehicle_at(const Mission& mission, std::uint32_t pose);

/// What was drawn for a ping of a sensor, its vehicle included.
DrawnValues drawn_for_ping(const Mission& mission, std::string_view sensor, std::uint32_t pose);

}  // namespace sonarsim
