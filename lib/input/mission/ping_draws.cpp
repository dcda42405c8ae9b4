#include "input/mission/ping_draws.h"

#include "core/elementary.h"
#include "core/error.h"
#include "core/text.h"
#include "input/mission/value_types.h"

namespace sonarsim {

namespace {

/// A number that may be drawn for pings.
struct VaryingNumber {
    std::string name;  ///< its key
    double* value;
    Limits limits;
};

/// The visitor that lists the numbers of sections.
struct NumberList : KeyVisitor<NumberList> {
    std::string prefix;  ///< before the keys, with a dot at its end
    std::vector<VaryingNumber> list;

    void value(const char* key, double& value, const NumberType& type, const char* /*meaning*/,
               Presence) {
        list.push_back({prefix + key, &value, type.limits});
    }
    template <std::size_t N>
    void value(const char* key, std::array<double, N>& values, const ArrayType& type,
               const char* /*meaning*/, Presence) {
        for (std::size_t k = 0; k < N; ++k)
            list.push_back({prefix + key + "." + std::to_string(k), &values[k], type.limits});
    }
    // Other keys do not vary for pings.
    void value(const char*, const auto&, const auto&, const char*, Presence) const {}
    void section(const char*, auto&, const char*) const {}

    void add(const std::string& section, auto& values) {
        prefix = section;
        describe(*this, values);
    }

    /// The number with this key; null if there is none.
    const VaryingNumber* find(std::string_view key) const {
        const auto found = std::ranges::find(list, key, &VaryingNumber::name);
        return found == list.end() ? nullptr : &*found;
    }
};

constexpr const char* vehicle_section = "vehicle.";

std::string section_of(std::string_view sensor) {
    return "sensors." + std::string(sensor) + ".";
}

/// Adds the numbers of a sensor that may be drawn for pings. Their keys begin with `section`.
void add_sensor(const std::string& section, SonarConfig& sensor, NumberList& numbers) {
    numbers.add(section + "mount.", sensor.mount);
    if (sensor.model != ModelKind::paper) return;
    numbers.add(section + "noise.", sensor.noise);
    // A side-scan sonar has no range noise.
    if (sensor.kind == SonarKind::sidescan) {
        std::erase_if(numbers.list, [&](const VaryingNumber& one) {
            return one.value == &sensor.noise.range_lambda_m;
        });
    }
    numbers.add(section + "streaks.", sensor.streaks);
}

/// A rule that is drawn for pings, and its index in `vary`.
struct PingRule {
    const VaryConfig& rule;
    std::uint32_t index;

    std::string draw(const Mission& mission, std::uint32_t pose) const {
        return draw_value(rule, mission.seed, index, pose, Stream::ping_variation);
    }
};

/// The rules whose key begins with `section`.
std::vector<PingRule> rules_of(const Mission& mission, std::string_view section) {
    std::vector<PingRule> rules;
    for (std::size_t k = 0; k < mission.vary.size(); ++k) {
        const VaryConfig& rule = mission.vary[k];
        if (rule.per == VaryPer::ping && rule.key.starts_with(section))
            rules.push_back({rule, static_cast<std::uint32_t>(k)});
    }
    return rules;
}

void draw_section(const Mission& mission, std::string_view section, std::uint32_t pose,
                  const NumberList& numbers) {
    for (const PingRule& one : rules_of(mission, section))
        *numbers.find(one.rule.key)->value = *parse_number(one.draw(mission, pose));
}

/// The limits of a rule's draws, or all of its choices, as YAML.
std::vector<std::string> extremes_of(const VaryConfig& rule) {
    for (const auto& range : {rule.uniform, rule.log_uniform, rule.whole, rule.within}) {
        if (range) return {number_text((*range)[0]), number_text((*range)[1])};
    }
    return rule.choice.items;
}

void check_rule(const Mission& mission, const VaryConfig& rule) {
    constexpr double min_share = 0.05;
    VehicleConfig vehicle;
    SonarConfig any_sensor;
    std::vector<SonarConfig> sensors = mission.sensors;
    NumberList numbers;
    for (SonarConfig& sensor : sensors)
        add_sensor(section_of(sensor.name), sensor, numbers);
    numbers.add(vehicle_section, vehicle);
    const VaryingNumber* const number = numbers.find(rule.key);
    if (number == nullptr) {
        numbers.list.clear();
        add_sensor("", any_sensor, numbers);
        numbers.add(vehicle_section, vehicle);
        refuse(rule.place,
               "'{}' cannot be drawn for every ping; write per: variant, or one of the keys that "
               "can, the first of them below sensors.NAME: {}",
               printable(rule.key), listed(names_of(numbers.list)));
    }
    for (const std::string& text : extremes_of(rule)) {
        const std::optional<double> value = parse_number(text);
        if (!value) refuse(rule.place, "'choice' for every ping takes numbers for '{}'", rule.key);
        const std::string fault = fault_of(*value, number->limits);
        if (!fault.empty()) refuse(rule.place, "'{}' must be {}, not {}", rule.key, fault, text);
    }
    if (share_within(rule) < min_share)
        refuse(rule.place,
               "'within' holds less than 5 % of the normal draws of '{}'; make it wider", rule.key);
}

double draw_normal(const VaryConfig& rule, PhiloxKey key) {
    constexpr std::uint32_t max_tries = 1000;
    const auto [mean, sigma] = *rule.normal;
    for (std::uint32_t attempt = 0; attempt < max_tries; ++attempt) {
        const double value = mean + sigma * two_normals(philox({attempt, 0, 0, 0}, key)).first;
        if (!rule.within || ((*rule.within)[0] <= value && value <= (*rule.within)[1]))
            return value;
    }
    refuse(
        rule.place,
        "a thousand normal draws of '{}' lie outside of 'within'; make it wider or the deviation "
        "larger",
        printable(rule.key));
}

std::size_t one_of(double count, double share) {
    return static_cast<std::size_t>(std::min(std::floor(share * count), count - 1.0));
}

/// The normal distribution function at x.
double normal_below(double mean, double sigma, double x) {
    return 0.5 * std::erfc((mean - x) / (std::sqrt(2.0) * sigma));
}

}  // namespace

void check_ping_draws(const Mission& mission) {
    ErrorList errors;
    for (const PingRule& one : rules_of(mission, ""))
        errors.attempt([&] { check_rule(mission, one.rule); });
    errors.raise();
}

bool varies_by_ping(const Mission& mission, std::string_view sensor) {
    return !rules_of(mission, section_of(sensor)).empty();
}

bool vehicle_varies_by_ping(const Mission& mission) {
    return !rules_of(mission, vehicle_section).empty();
}

void draw_for_ping(const Mission& mission, std::uint32_t pose, SonarConfig& sensor) {
    NumberList numbers;
    add_sensor(section_of(sensor.name), sensor, numbers);
    draw_section(mission, section_of(sensor.name), pose, numbers);
}

VehicleConfig vehicle_at(const Mission& mission, std::uint32_t pose) {
    VehicleConfig vehicle = mission.vehicle;
    NumberList numbers;
    numbers.add(vehicle_section, vehicle);
    draw_section(mission, vehicle_section, pose, numbers);
    return vehicle;
}

DrawnValues drawn_for_ping(const Mission& mission, std::string_view sensor, std::uint32_t pose) {
    DrawnValues drawn;
    for (const std::string& section : {std::string(vehicle_section), section_of(sensor)}) {
        for (const PingRule& one : rules_of(mission, section))
            drawn.emplace_back(one.rule.key, one.draw(mission, pose));
    }
    return drawn;
}

double share_within(const VaryConfig& rule) {
    if (!rule.normal || !rule.within) return 1.0;
    const auto [mean, sigma] = *rule.normal;
    const auto [low, high] = *rule.within;
    if (sigma == 0.0) return low <= mean && mean <= high ? 1.0 : 0.0;
    return normal_below(mean, sigma, high) - normal_below(mean, sigma, low);
}

std::string draw_value(const VaryConfig& rule, std::uint64_t seed, std::uint32_t rule_index,
                       std::uint32_t number, Stream stream) {
    const PhiloxKey key = stream_key(seed, rule_index, number, stream);
    const PhiloxBlock words = philox({0, 0, 0, 0}, key);
    const double share = unit_double(words.x0, words.x1);
    if (rule.normal) return number_text(draw_normal(rule, key));
    if (rule.uniform) {
        const auto [low, high] = *rule.uniform;
        return number_text(low + share * (high - low));
    }
    if (rule.log_uniform || rule.scale) {
        const auto [low, high] = rule.scale ? *rule.scale : *rule.log_uniform;
        return number_text(std::min(high, low * exponential(share * logarithm(high / low))));
    }
    if (rule.whole) {
        const double low = std::ceil((*rule.whole)[0]);
        const double count = std::floor((*rule.whole)[1]) - low + 1.0;
        if (count < 1.0) refuse(rule.place, "there is no whole number in 'whole'");
        // No exponent, which keys of whole numbers refuse.
        return std::to_string(static_cast<std::int64_t>(low) +
                              static_cast<std::int64_t>(one_of(count, share)));
    }
    return rule.choice.items[one_of(static_cast<double>(rule.choice.items.size()), share)];
}

}  // namespace sonarsim
