#include "mission/holoocean.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/text.h"
#include "mission/document.h"
#include "mission/holoocean_sonar.h"
#include "mission/json_values.h"
#include "mission/limits.h"

namespace sonarsim {

namespace {

std::string list_text(const std::array<double, 3>& values) {
    return "[" + number_text(values[0]) + ", " + number_text(values[1]) + ", " +
           number_text(values[2]) + "]";
}

/// Letters, digits, '_' and '-', as the name of a sensor takes them.
std::string name_from(std::string text) {
    constexpr std::string_view allowed =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    for (char& c : text) {
        if (allowed.find(c) == std::string_view::npos) c = '_';
    }
    return text.empty() ? "sonar" : text.substr(0, 60);
}

/// The section of a sonar, as YAML. A setting such as "noise.add_sigma" goes into its subsection.
std::string sonar_yaml(const std::string& name, const SonarType& type, const ImportedSonar& sonar,
                       int every, const YamlNode& sensor) {
    std::string text = "  " + name + ":\n    kind: " + type.kind + "\n";
    const auto place = vector_in(sensor, "location", any_position_m);
    const auto turn = vector_in(sensor, "rotation", any_angle_deg);
    if (place != std::array<double, 3>{} || turn != std::array<double, 3>{}) {
        text += "    mount: {translation_m: " + list_text(place) + ", rpy_deg: " + list_text(turn) +
                "}\n";
    }
    if (every > 1) text += "    every: " + std::to_string(every) + "\n";
    for (const auto& [key, value] : sonar.settings) {
        if (key.find('.') == std::string::npos) text += "    " + key + ": " + value + "\n";
    }
    for (const std::string section : {"noise", "multipath", "streaks"}) {
        std::string keys;
        for (const auto& [key, value] : sonar.settings) {
            if (key.starts_with(section + "."))
                keys += "      " + key.substr(section.size() + 1) + ": " + value + "\n";
        }
        if (!keys.empty()) text += "    " + section + ":\n" + keys;
    }
    for (const std::string& remark : sonar.remarks)
        text += "    # without a counterpart: " + remark + "\n";
    return text;
}

const YamlNode& main_agent(const YamlNode& scenario, std::vector<std::string>& warnings) {
    const YamlNode* const agents = map_at(scenario, "scenario").find("agents");
    if (agents == nullptr || agents->kind != YamlNode::Kind::list || agents->items.empty())
        refuse_at(agents != nullptr ? *agents : scenario, "a scenario needs a list of 'agents'");
    const YamlNode* const wanted = scenario.find("main_agent");
    const YamlNode* chosen = nullptr;
    for (const YamlNode& agent : agents->items) {
        const YamlNode* const name = map_at(agent, "agents").find("agent_name");
        const bool is_main =
            wanted == nullptr || (name != nullptr && name->text == text_in(*wanted, "main_agent"));
        if (is_main && chosen == nullptr) {
            chosen = &agent;
        } else {
            warnings.push_back(agent.place.location().text() +
                               ": this agent is left out: a mission has one vehicle");
        }
    }
    if (chosen == nullptr) refuse_at(*wanted, "no agent is called " + in_quotes(wanted->text));
    return *chosen;
}

double rate_of(const YamlNode& sensor, double ticks) {
    const YamlNode* const rate = sensor.find("Hz");
    return rate != nullptr ? number_in(*rate, "Hz", above(0)) : ticks;
}

/// The poses from ping to ping of a sonar. Warns if no whole number of them makes its rate.
int every_of(const YamlNode& sensor, double rate_hz, double ticks,
             std::vector<std::string>& warnings) {
    constexpr double tolerance = 0.01;
    const double wanted_hz = rate_of(sensor, ticks);
    const double every = std::clamp(std::round(rate_hz / wanted_hz), 1.0, 1e6);
    const double made_hz = rate_hz / every;
    if (std::fabs(made_hz - wanted_hz) > tolerance * wanted_hz) {
        const YamlNode* const rate = sensor.find("Hz");
        warnings.push_back(
            (rate != nullptr ? *rate : sensor).place.location().text() +
            fmt::format(": {:.4g} Hz become {:.4g} Hz: a sonar pings at every n-th pose, of which "
                        "there are {:.4g} in a second",
                        wanted_hz, made_hz, rate_hz));
    }
    return static_cast<int>(every);
}

using FoundSonars = std::vector<std::pair<const YamlNode*, const SonarType*>>;

/// The agent's sensors that are sonars. Warns of the others.
FoundSonars sonars_of(const YamlNode& agent, std::vector<std::string>& warnings) {
    const YamlNode* const sensors = agent.find("sensors");
    if (sensors == nullptr || sensors->kind != YamlNode::Kind::list)
        refuse_at(agent, "the agent needs a list of 'sensors'");
    FoundSonars sonars;
    for (const YamlNode& sensor : sensors->items) {
        const YamlNode* const type = map_at(sensor, "sensors").find("sensor_type");
        if (type == nullptr) refuse_at(sensor, "a sensor needs the key 'sensor_type'");
        const auto known = std::ranges::find_if(
            sonar_types(), [&](const SonarType& one) { return type->text == one.type; });
        if (known != sonar_types().end()) {
            sonars.emplace_back(&sensor, &*known);
            continue;
        }
        const bool is_sonar = type->text.find("onar") != std::string::npos;
        warnings.push_back(type->place.location().text() + ": " + in_quotes(type->text) +
                           " is left out: it is no sonar that sonarsim has" +
                           (is_sonar ? "; it has " + sonar_type_list() : ""));
    }
    if (sonars.empty()) refuse_at(*sensors, "none of the sensors is a sonar: " + sonar_type_list());
    return sonars;
}

/// Adds the water that a sonar assumes. Warns if it differs from that of the sonars before.
void add_water(const ImportedSonar& sonar, const YamlNode& sensor, Settings& water,
               std::vector<std::string>& warnings) {
    for (const auto& [key, value] : sonar.water) {
        const std::string* const other = setting(water, key);
        if (other == nullptr || *other == value) {
            set_key(water, key, value);
            continue;
        }
        warnings.push_back(sensor.place.location().text() +
                           ": another water than that of the sonars before; a mission has one: " +
                           key + " stays " + *other);
    }
}

/// The sections of the sonars, as YAML. Fills `water`.
std::string sensors_yaml(const FoundSonars& sonars, double rate_hz, double ticks, Settings& water,
                         std::vector<std::string>& warnings) {
    std::string yaml;
    std::set<std::string> names;
    for (const auto& [sensor, type] : sonars) {
        const ImportedSonar sonar = import_sonar(*sensor, *type, warnings);
        add_water(sonar, *sensor, water, warnings);
        const YamlNode* const given = sensor->find("sensor_name");
        const std::string wanted =
            name_from(given != nullptr ? text_in(*given, "sensor_name") : type->type);
        std::string name = wanted;
        for (int other = 2; !names.insert(name).second; ++other)
            name = wanted + "_" + std::to_string(other);
        const int every = every_of(*sensor, rate_hz, ticks, warnings);
        yaml += sonar_yaml(name, *type, sonar, every, *sensor);
        if (const YamlNode* const socket = sensor->find("socket")) {
            const std::string where = type->looks_down ? "; by default it looks down here" : "";
            warnings.push_back(
                socket->place.location().text() + ": where the socket " + in_quotes(socket->text) +
                " sits on the agent is not in the scenario: check mount of '" + name + "'" + where);
        }
    }
    return yaml;
}

/// A straight trajectory of 10 m from the agent's start, as YAML.
std::string trajectory_yaml(const YamlNode& agent, double rate_hz) {
    const auto start = vector_in(agent, "location", any_position_m);
    const auto turn = vector_in(agent, "rotation", any_angle_deg);
    // The first column of R = Rz Ry Rx is the direction of the bow.
    const double degree = std::acos(-1.0) / 180.0;
    const double along[] = {std::cos(turn[2] * degree) * std::cos(turn[1] * degree),
                            std::sin(turn[2] * degree) * std::cos(turn[1] * degree),
                            -std::sin(turn[1] * degree)};
    std::array<double, 3> end = start;
    for (std::size_t k = 0; k < 3; ++k)
        end[k] = std::round((start[k] + 10.0 * along[k]) * 1e6) / 1e6;
    std::string yaml =
        "trajectory:\n  # A scenario says where the agent starts; from there 10 m ahead.\n"
        "  waypoints:\n";
    for (const auto& position : {start, end})
        yaml +=
            "    - {position_m: " + list_text(position) + ", rpy_deg: " + list_text(turn) + "}\n";
    return yaml + "  rate_hz: " + number_text(rate_hz) + "\n";
}

/// Remarks, as YAML comments, on keys about the engine's octree and environment. Warns of each.
std::string engine_remarks(const YamlNode& scenario, std::vector<std::string>& warnings) {
    std::string remarks;
    for (const YamlNode& item : scenario.items) {
        if (!item.key.starts_with("octree_") && !item.key.starts_with("env_")) continue;
        warnings.push_back(item.key_place.location().text() + ": " + in_quotes(item.key) +
                           " has no counterpart: there is no octree to prepare");
        remarks += "# without a counterpart: " + shown(item.key, 60) + "\n";
    }
    return remarks;
}

}  // namespace

ImportedMission import_holoocean(std::string_view text, const std::string& file,
                                 const HoloOceanWorld& world) {
    // JSON is YAML, except for text that no scenario holds.
    const YamlNode scenario = read_document(text, file);
    ImportedMission mission;
    std::vector<std::string>& warnings = mission.warnings;
    const YamlNode& agent = main_agent(scenario, warnings);
    const YamlNode* const given_ticks = scenario.find("ticks_per_sec");
    const double ticks =
        given_ticks != nullptr ? number_in(*given_ticks, "ticks_per_sec", above(0)) : 30.0;
    const FoundSonars sonars = sonars_of(agent, warnings);
    double rate_hz = 0.0;
    for (const auto& [sensor, type] : sonars)
        rate_hz = std::max(rate_hz, rate_of(*sensor, ticks));
    Settings water;
    const std::string sensors = sensors_yaml(sonars, rate_hz, ticks, water, warnings);
    const std::string trajectory = trajectory_yaml(agent, rate_hz);
    warnings.push_back(agent.place.location().text() +
                       ": a scenario says where the agent starts, not where it goes: the mission "
                       "goes 10 m ahead; write a trajectory of your own");
    warnings.push_back(
        scenario.place.location().text() +
        ": the world is a level of the game engine: export it, or name another scene");

    std::string& yaml = mission.yaml;
    yaml = "# From the HoloOcean scenario " + shown(file, 200) + ".\n" +
           engine_remarks(scenario, warnings);
    if (const YamlNode* const name = scenario.find("name"))
        yaml += "name: " + quoted_text(name_from(text_in(*name, "name"))) + "\n";
    if (!water.empty()) yaml += "water:\n";
    for (const auto& [key, value] : water)
        yaml += "  " + key + ": " + value + "\n";
    yaml += "scene:\n  file: " + quoted_text(world.scene) +
            "  # the scenario's world is a level of the game engine\n  materials: " +
            quoted_text(world.materials) + "\n" + trajectory + "sensors:\n" + sensors;
    return mission;
}

}  // namespace sonarsim
