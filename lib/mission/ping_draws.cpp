#include "mission/ping_draws.h"

#include <algorithm>
#include <array>
#include <functional>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "mission/draw_value.h"

namespace sonarsim {

namespace {

/// A number that may be drawn for every ping.
template <class Section>
struct Varying {
    std::string_view key;  ///< relative to the section
    double& (*of)(Section&);
};

constexpr std::array of_sensor{
    Varying<SonarConfig>{"mount.translation_m.0",
                         [](auto& c) -> double& { return c.mount.translation_m[0]; }},
    Varying<SonarConfig>{"mount.translation_m.1",
                         [](auto& c) -> double& { return c.mount.translation_m[1]; }},
    Varying<SonarConfig>{"mount.translation_m.2",
                         [](auto& c) -> double& { return c.mount.translation_m[2]; }},
    Varying<SonarConfig>{"mount.rpy_deg.0", [](auto& c) -> double& { return c.mount.rpy_deg[0]; }},
    Varying<SonarConfig>{"mount.rpy_deg.1", [](auto& c) -> double& { return c.mount.rpy_deg[1]; }},
    Varying<SonarConfig>{"mount.rpy_deg.2", [](auto& c) -> double& { return c.mount.rpy_deg[2]; }},
    Varying<SonarConfig>{"noise.range_lambda_m",
                         [](auto& c) -> double& { return c.noise.range_lambda_m; }},
    Varying<SonarConfig>{"noise.scatterer_m",
                         [](auto& c) -> double& { return c.noise.scatterer_m; }},
    Varying<SonarConfig>{"noise.add_sigma", [](auto& c) -> double& { return c.noise.add_sigma; }},
    Varying<SonarConfig>{"noise.mult_sigma", [](auto& c) -> double& { return c.noise.mult_sigma; }},
    Varying<SonarConfig>{"noise.lobe_sigma_deg",
                         [](auto& c) -> double& { return c.noise.lobe_sigma_deg; }},
    Varying<SonarConfig>{"noise.gain", [](auto& c) -> double& { return c.noise.gain; }},
    Varying<SonarConfig>{"streaks.threshold",
                         [](auto& c) -> double& { return c.streaks.threshold; }},
    Varying<SonarConfig>{"streaks.angle_deg",
                         [](auto& c) -> double& { return c.streaks.angle_deg; }},
};
constexpr std::array of_vehicle{
    Varying<VehicleConfig>{"offset_m.0", [](auto& c) -> double& { return c.offset_m[0]; }},
    Varying<VehicleConfig>{"offset_m.1", [](auto& c) -> double& { return c.offset_m[1]; }},
    Varying<VehicleConfig>{"offset_m.2", [](auto& c) -> double& { return c.offset_m[2]; }},
    Varying<VehicleConfig>{"turn_deg.0", [](auto& c) -> double& { return c.turn_deg[0]; }},
    Varying<VehicleConfig>{"turn_deg.1", [](auto& c) -> double& { return c.turn_deg[1]; }},
    Varying<VehicleConfig>{"turn_deg.2", [](auto& c) -> double& { return c.turn_deg[2]; }},
};

constexpr std::string_view vehicle_section = "vehicle.";

std::string section_of(std::string_view sensor) {
    return "sensors." + std::string(sensor) + ".";
}

/// The number of a section that a key names; null if it may not be drawn for pings.
template <class Section, std::size_t N>
const Varying<Section>* find_number(const std::array<Varying<Section>, N>& numbers,
                                    std::string_view key, std::string_view section) {
    if (!key.starts_with(section)) return nullptr;
    const auto found =
        std::ranges::find(numbers, key.substr(section.size()), &Varying<Section>::key);
    return found == numbers.end() ? nullptr : &*found;
}

/// Calls `visit` for every rule that is drawn for pings and whose key begins with `section`.
void for_each_rule(const Mission& mission, std::string_view section,
                   const std::function<void(const VaryConfig&, std::uint32_t index)>& visit) {
    for (std::size_t k = 0; k < mission.vary.size(); ++k) {
        const VaryConfig& rule = mission.vary[k];
        if (rule.per == VaryPer::ping && rule.key.starts_with(section))
            visit(rule, static_cast<std::uint32_t>(k));
    }
}

std::string drawn_text(const Mission& mission, const VaryConfig& rule, std::uint32_t index,
                       std::uint32_t pose) {
    return draw_value(rule, mission.seed, index, pose, Stream::ping_variation);
}

template <class Section, std::size_t N>
void draw_section(const Mission& mission, std::string_view name, std::uint32_t pose,
                  const std::array<Varying<Section>, N>& numbers, Section& section) {
    for_each_rule(mission, name, [&](const VaryConfig& rule, std::uint32_t index) {
        find_number(numbers, rule.key, name)->of(section) =
            *parse_number(drawn_text(mission, rule, index, pose));
    });
}

}  // namespace

void check_key_of_pings(const Mission& mission, const VaryConfig& rule) {
    constexpr double least_share = 0.05;
    const auto names_it = [&](const SonarConfig& sensor) {
        return find_number(of_sensor, rule.key, section_of(sensor.name)) != nullptr;
    };
    if (!find_number(of_vehicle, rule.key, vehicle_section) &&
        std::ranges::none_of(mission.sensors, names_it)) {
        std::string keys;
        for (const auto& number : of_sensor)
            keys += std::string(number.key) + ", ";
        for (const auto& number : of_vehicle)
            keys += std::string(vehicle_section) + std::string(number.key) + ", ";
        throw InputError(rule.place.location,
                         "'" + printable(rule.key) +
                             "' cannot be drawn for every ping; write per: variant, or one of "
                             "the keys that can, the first of them below sensors.NAME: " +
                             keys.substr(0, keys.size() - 2));
    }
    const auto is_number = [](const std::string& text) { return parse_number(text).has_value(); };
    if (!std::ranges::all_of(rule.choice, is_number)) {
        throw InputError(rule.place.location,
                         "'choice' for every ping takes numbers for '" + rule.key + "'");
    }
    if (share_within(rule) < least_share) {
        throw InputError(rule.place.location,
                         "'within' holds less than 5 % of the normal draws of '" + rule.key +
                             "'; make it wider");
    }
}

std::vector<std::string> extremes_of(const VaryConfig& rule) {
    if (!rule.choice.empty()) return rule.choice;
    for (const auto& range : {rule.uniform, rule.log_uniform, rule.whole, rule.within}) {
        if (range) return {number_text((*range)[0]), number_text((*range)[1])};
    }
    return {};
}

bool varies_by_ping(const Mission& mission, std::string_view sensor) {
    bool varies = false;
    for_each_rule(mission, section_of(sensor),
                  [&](const VaryConfig&, std::uint32_t) { varies = true; });
    return varies;
}

void draw_for_ping(const Mission& mission, std::uint32_t pose, SonarConfig& sensor) {
    draw_section(mission, section_of(sensor.name), pose, of_sensor, sensor);
}

VehicleConfig vehicle_at(const Mission& mission, std::uint32_t pose) {
    VehicleConfig vehicle = mission.vehicle;
    draw_section(mission, vehicle_section, pose, of_vehicle, vehicle);
    return vehicle;
}

DrawnValues drawn_for_ping(const Mission& mission, std::string_view sensor, std::uint32_t pose) {
    DrawnValues drawn;
    const auto note = [&](const VaryConfig& rule, std::uint32_t index) {
        drawn.emplace_back(rule.key, drawn_text(mission, rule, index, pose));
    };
    for_each_rule(mission, vehicle_section, note);
    for_each_rule(mission, section_of(sensor), note);
    return drawn;
}

}  // namespace sonarsim
