#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/random.h"
#include "input/mission/mission.h"
#include "input/mission/variation_keys.h"

// The numbers that `vary` draws for every ping; neither the scene nor the view depends on them. A
// draw is a function of the seed, the index of its rule in `vary` and the pose.

namespace sonarsim {

/// InputError at each rule whose key cannot be drawn for every ping, or cannot have the number.
void check_ping_draws(const Mission& mission);

/// True if any key of a sensor is drawn for every ping.
bool varies_by_ping(const Mission& mission, std::string_view sensor);

/// True if any key of the vehicle is drawn for every ping.
bool vehicle_varies_by_ping(const Mission& mission);

/// Draws the varying keys of a sensor at a pose.
void draw_for_ping(const Mission& mission, std::uint32_t pose, SonarConfig& sensor);

/// The vehicle's offset from a pose.
VehicleConfig vehicle_at(const Mission& mission, std::uint32_t pose);

/// The values drawn for a ping of a sensor, with those of the vehicle.
DrawnValues drawn_for_ping(const Mission& mission, std::string_view sensor, std::uint32_t pose);

/// Draws a value of a rule, or the factor of `scale`, and returns it as YAML text: for a variant,
/// or with Stream::ping_variation for a ping. InputError at the rule if `within` is too narrow.
std::string draw_value(const VaryConfig& rule, std::uint64_t seed, std::uint32_t rule_index,
                       std::uint32_t number, Stream stream = Stream::variation);

/// The share of a rule's normal draws that lie within `within`; 1 for a rule without `within`.
double share_within(const VaryConfig& rule);

}  // namespace sonarsim
