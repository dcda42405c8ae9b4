#include "mission/ping_draws.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "mission/draw_value.h"
#include "mission/schema.h"

namespace sonarsim {

namespace {

using NamedNumbers = std::vector<std::pair<std::string, double*>>;

/// Lists the numbers of a section by key; a visitor of describe().
class NumberLister {
  public:
    template <class T>
    void section(const char* key, T& value) {
        prefix_ = std::string(key) + ".";
        describe(*this, value);
    }
    void number(const char* key, double& value, const Limits&, const char*) {
        list.emplace_back(prefix_ + key, &value);
    }
    template <std::size_t N>
    void numbers(const char* key, std::array<double, N>& values, const Limits&, const char*) {
        for (std::size_t k = 0; k < N; ++k)
            list.emplace_back(prefix_ + key + "." + std::to_string(k), &values[k]);
    }
    void flag(const char*, bool, const char*) {}
    template <class T, std::size_t N>
    void choice(const char*, T, const std::array<Choice<T>, N>&, const char*) {}

    NamedNumbers list;

  private:
    std::string prefix_;
};

/// The numbers of a sensor that may be drawn for every ping: neither the scene nor the view depends
/// on them.
NamedNumbers numbers_of(SonarConfig& sensor) {
    NumberLister lister;
    lister.section("mount", sensor.mount);
    lister.section("noise", sensor.noise);
    lister.section("streaks", sensor.streaks);
    return std::move(lister.list);
}

NamedNumbers numbers_of(VehicleConfig& vehicle) {
    NumberLister lister;
    describe(lister, vehicle);
    return std::move(lister.list);
}

constexpr std::string_view vehicle_section = "vehicle.";

std::string section_of(std::string_view sensor) {
    return "sensors." + std::string(sensor) + ".";
}

/// The number of a section that a key names; null if it may not be drawn for pings.
template <class Section>
double* find_number(Section& section, std::string_view key, std::string_view name) {
    if (!key.starts_with(name)) return nullptr;
    const NamedNumbers numbers = numbers_of(section);
    const auto found = std::ranges::find(numbers, key.substr(name.size()),
                                         &std::pair<std::string, double*>::first);
    return found == numbers.end() ? nullptr : found->second;
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

template <class Section>
void draw_section(const Mission& mission, std::string_view name, std::uint32_t pose,
                  Section& section) {
    for_each_rule(mission, name, [&](const VaryConfig& rule, std::uint32_t index) {
        *find_number(section, rule.key, name) =
            *parse_number(drawn_text(mission, rule, index, pose));
    });
}

}  // namespace

void check_key_of_pings(const Mission& mission, const VaryConfig& rule) {
    constexpr double least_share = 0.05;
    const auto names_it = [&](SonarConfig sensor) {
        return find_number(sensor, rule.key, section_of(sensor.name)) != nullptr;
    };
    VehicleConfig vehicle = mission.vehicle;
    if (!find_number(vehicle, rule.key, vehicle_section) &&
        std::ranges::none_of(mission.sensors, names_it)) {
        std::string keys;
        SonarConfig any;
        for (const auto& [key, number] : numbers_of(any))
            keys += key + ", ";
        for (const auto& [key, number] : numbers_of(vehicle))
            keys += std::string(vehicle_section) + key + ", ";
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
    draw_section(mission, section_of(sensor.name), pose, sensor);
}

VehicleConfig vehicle_at(const Mission& mission, std::uint32_t pose) {
    VehicleConfig vehicle = mission.vehicle;
    draw_section(mission, vehicle_section, pose, vehicle);
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
