#include "input/mission/variants.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/random.h"
#include "core/text.h"
#include "input/mission/ping_draws.h"
#include "input/mission/preset.h"
#include "input/mission/resolved.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t all_variants = 0xFFFFFFFFU;
constexpr std::uint32_t no_sensor = 0xFFFFFFFFU;

/// Keeps only the rules that are drawn for every ping.
void keep_rules_of_pings(YamlNode& root, const std::vector<VaryConfig>& rules) {
    YamlNode* list = root.find("vary");
    if (list == nullptr) return;
    std::vector<YamlNode> kept;
    for (std::size_t k = 0; k < rules.size(); ++k) {
        if (rules[k].per == VaryPer::ping) kept.push_back(list->items[k]);
    }
    list->items = std::move(kept);
    if (list->items.empty()) erase_key(root, "vary");
}

bool has_scale(const VaryConfig& rule) {
    return rule.scale.has_value();
}

/// The value of a rule with `scale`; `own` has the values without it.
std::string scaled(const VaryConfig& rule, const std::string& factor, const YamlNode& own) {
    if (const std::optional<double> value = number_at(own, rule.key))
        return number_text(*value * *parse_number(factor));
    throw InputError(rule.place, "'scale' needs a number to multiply, which '" +
                                     printable(rule.key) + "' is not");
}

/// True if a rule without `scale` may change the value that a rule with `scale` multiplies: by
/// drawing it, a section around it, or what its default follows from.
bool may_change(const VaryConfig& rule, const VaryConfig& scaled) {
    return scaled.key.starts_with(rule.key) || rule.key.ends_with("preset") ||
           rule.key.ends_with("kind") || rule.key.ends_with("model");
}

bool is_of_variants(const VaryConfig& rule) {
    return rule.per != VaryPer::ping;
}

/// The values of a rule that show all objects that it may bring.
std::vector<std::string> choices_of_objects(const VaryConfig& rule) {
    const bool is_of_objects = rule.key.starts_with("scene") || rule.key.starts_with("classes");
    if (!is_of_objects || rule.per != VaryPer::variant) return {};
    if (!rule.whole) return rule.choice.items;
    return {std::to_string(static_cast<std::int64_t>((*rule.whole)[1]))};
}

}  // namespace

std::string variant_folder(int index) {
    return fmt::format("variant_{:04}", index);
}

Variants::Variants(const Mission& mission, const MissionSource& source, SonarKeyTable sonars)
    : mission_(mission), source_(source), sonars_(sonars), whole_(read_mission_document(source)) {
    fill_in_rules(whole_, source.base_folder);
    erase_key(whole_, "variants");
    keep_rules_of_pings(whole_, mission.vary);
    const std::vector<VaryConfig>& rules = mission_.vary;
    const bool is_changed = std::ranges::any_of(rules, [&](const VaryConfig& scaled) {
        return has_scale(scaled) && std::ranges::any_of(rules, [&](const VaryConfig& rule) {
                   return is_of_variants(rule) && !has_scale(rule) && may_change(rule, scaled);
               });
    });
    if (std::ranges::any_of(rules, has_scale) && !is_changed)
        own_ = read_document(resolved_yaml(parsed(whole_), sonars_), "");
}

std::uint64_t Variants::seed(int index) const {
    const PhiloxKey key =
        stream_key(mission_.seed, no_sensor, static_cast<std::uint32_t>(index), Stream::variation);
    return (std::uint64_t{key.k1} << 32) | key.k0;
}

DrawnValues Variants::drawn(int index) const {
    return drawn_of(draw_values(index));
}

std::vector<Mission> Variants::extremes() const {
    std::vector<Mission> extremes;
    for (std::size_t k = 0; k < mission_.vary.size(); ++k) {
        for (const std::string& value : choices_of_objects(mission_.vary[k])) {
            std::vector<std::string> values = draw_values(0);
            values[k] = value;
            extremes.push_back(make(0, values));
        }
    }
    return extremes;
}

/// The values by the rules of `vary`; "" for rules that are drawn for every ping.
std::vector<std::string> Variants::draw_values(int index) const {
    std::vector<std::string> values;
    for (std::size_t k = 0; k < mission_.vary.size(); ++k) {
        const VaryConfig& rule = mission_.vary[k];
        const auto of =
            rule.per == VaryPer::dataset ? all_variants : static_cast<std::uint32_t>(index);
        values.push_back(is_of_variants(rule)
                             ? draw_value(rule, mission_.seed, static_cast<std::uint32_t>(k), of)
                             : "");
    }
    return values;
}

DrawnValues Variants::drawn_of(const std::vector<std::string>& values) const {
    DrawnValues drawn;
    for (const bool scales : {false, true}) {
        std::optional<YamlNode> changed;
        for (std::size_t k = 0; k < values.size(); ++k) {
            const VaryConfig& rule = mission_.vary[k];
            if (!is_of_variants(rule) || has_scale(rule) != scales) continue;
            if (scales && !own_ && !changed) changed = own_values(values);
            drawn.emplace_back(
                rule.key, scales ? scaled(rule, values[k], own_ ? *own_ : *changed) : values[k]);
        }
    }
    return drawn;
}

/// The resolved values of the mission with the values of the rules without `scale`.
YamlNode Variants::own_values(const std::vector<std::string>& values) const {
    YamlNode root = whole_;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const VaryConfig& rule = mission_.vary[k];
        if (is_of_variants(rule) && !has_scale(rule))
            set_text(root, rule.key, values[k], rule.place);
    }
    return read_document(resolved_yaml(parsed(root), sonars_), "");
}

Mission Variants::make(int index, const std::vector<std::string>& values) const {
    YamlNode root = whole_;
    set_text(root, "seed", std::to_string(seed(index)), {source_.file.string()});
    Variant variant{index, drawn_of(values), objects_};
    auto drawn = variant.drawn.begin();
    for (const bool scales : {false, true}) {
        for (const VaryConfig& rule : mission_.vary) {
            if (is_of_variants(rule) && has_scale(rule) == scales)
                set_text(root, rule.key, (drawn++)->second, rule.place);
        }
    }
    Mission made = parsed(root);
    made.output.folder = mission_.output.folder / variant_folder(index);
    made.variant = std::move(variant);
    return made;
}

Mission Variants::parsed(const YamlNode& root) const {
    return parse_mission(root, source_.file.string(), source_.base_folder, sonars_);
}

}  // namespace sonarsim
