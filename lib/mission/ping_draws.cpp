#include "mission/ping_draws.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "mission/draw_value.h"
#include "mission/sonar_schema.h"
#include "mission/trajectory_schema.h"

namespace sonarsim {

namespace {

/// The visitor that lists the numbers of sections.
struct NumberList {
    std::string prefix;  ///< before the keys, with a dot at its end
    std::vector<std::pair<std::string, double*>> list = {};

    void number(const char* key, double& value, const Limits&, const char* /*meaning*/) {
        list.emplace_back(prefix + key, &value);
    }
    template <std::size_t N>
    void array(const char* key, std::array<double, N>& values, const Limits&,
               const char* /*meaning*/) {
        for (std::size_t k = 0; k < N; ++k)
            list.emplace_back(prefix + key + "." + std::to_string(k), &values[k]);
    }
    void flag(const char*, bool, const char*) const {}
    template <class T>
    void section(const char*, T&, const char*) const {}
    template <class T, std::size_t N>
    void choice(const char*, T&, const std::array<Choice<T>, N>&, const char*) const {}

    /// The number with this key; null if there is none.
    double* find(std::string_view key) const {
        const auto found = std::ranges::find(
            list, key, [](const auto& one) { return std::string_view(one.first); });
        return found == list.end() ? nullptr : found->second;
    }
};

constexpr const char* vehicle_section = "vehicle.";

std::string section_of(std::string_view sensor) {
    return "sensors." + std::string(sensor) + ".";
}

/// The numbers of a sensor that may be drawn for pings. Their keys begin with `section`.
NumberList numbers_of(SonarConfig& sensor, const std::string& section) {
    NumberList numbers{section + "mount."};
    describe(numbers, sensor.mount);
    numbers.prefix = section + "noise.";
    describe(numbers, sensor.noise);
    numbers.prefix = section + "streaks.";
    describe(numbers, sensor.streaks);
    return numbers;
}

NumberList numbers_of(VehicleConfig& vehicle) {
    NumberList numbers{vehicle_section};
    describe(numbers, vehicle);
    return numbers;
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

void draw_section(const Mission& mission, std::string_view section, std::uint32_t pose,
                  const NumberList& numbers) {
    for_each_rule(mission, section, [&](const VaryConfig& rule, std::uint32_t index) {
        *numbers.find(rule.key) = *parse_number(drawn_text(mission, rule, index, pose));
    });
}

}  // namespace

void check_key_of_pings(const Mission& mission, const VaryConfig& rule) {
    constexpr double least_share = 0.05;
    VehicleConfig vehicle;
    SonarConfig any_sensor;
    const NumberList of_vehicle = numbers_of(vehicle);
    const auto names_it = [&](const SonarConfig& sensor) {
        return numbers_of(any_sensor, section_of(sensor.name)).find(rule.key) != nullptr;
    };
    if (of_vehicle.find(rule.key) == nullptr && std::ranges::none_of(mission.sensors, names_it)) {
        std::string keys;
        for (const auto& number : numbers_of(any_sensor, "").list)
            keys += number.first + ", ";
        for (const auto& number : of_vehicle.list)
            keys += number.first + ", ";
        throw InputError(rule.place.location,
                         "'" + printable(rule.key) +
                             "' cannot be drawn for every ping; write per: variant, or one of "
                             "the keys that can, the first of them below sensors.NAME: " +
                             keys.substr(0, keys.size() - 2));
    }
    const auto is_number = [](const std::string& text) { return parse_number(text).has_value(); };
    if (!std::ranges::all_of(rule.choice.items, is_number)) {
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
    if (!rule.choice.items.empty()) return rule.choice.items;
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

bool vehicle_varies_by_ping(const Mission& mission) {
    bool varies = false;
    for_each_rule(mission, vehicle_section,
                  [&](const VaryConfig&, std::uint32_t) { varies = true; });
    return varies;
}

void draw_for_ping(const Mission& mission, std::uint32_t pose, SonarConfig& sensor) {
    const std::string section = section_of(sensor.name);
    draw_section(mission, section, pose, numbers_of(sensor, section));
}

VehicleConfig vehicle_at(const Mission& mission, std::uint32_t pose) {
    VehicleConfig vehicle = mission.vehicle;
    draw_section(mission, vehicle_section, pose, numbers_of(vehicle));
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
