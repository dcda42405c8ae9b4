#include "input/mission/variants.h"

#include <spdlog/fmt/fmt.h>

#include "core/random.h"
#include "core/text.h"
#include "input/mission/ping_draws.h"
#include "input/mission/preset.h"
#include "input/mission/resolved.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t all_variants = 0xFFFFFFFFU;
constexpr std::uint32_t no_sensor = 0xFFFFFFFFU;

/// True if a setting of the command line fixes the key of a rule, or a section around it.
bool is_fixed(const VaryConfig& rule, const MissionSource& source) {
    return std::ranges::any_of(source.overrides, [&](const std::string& setting) {
        return is_fixed_by(rule.key, setting);
    });
}

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

/// The value of a rule with `scale`; `own` has the values without it.
std::string scaled(const VaryConfig& rule, const std::string& factor, const YamlNode& own) {
    if (const std::optional<double> value = number_at(own, rule.key))
        return number_text(*value * *parse_number(factor));
    refuse(rule.place, "'scale' needs a number to multiply, which '{}' is not",
           printable(rule.key));
}

/// True if a rule without `scale` may change the value that a rule with `scale` multiplies: by
/// drawing it, a section around it, or what its default follows from.
bool may_change(const VaryConfig& rule, const VaryConfig& scaled) {
    return scaled.key.starts_with(rule.key) || rule.key.ends_with("preset") ||
           rule.key.ends_with("kind") || rule.key.ends_with("model");
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
    for (std::size_t k = 0; k < rules.size(); ++k)
        if (rules[k].per != VaryPer::ping && !is_fixed(rules[k], source)) order_.push_back(k);
    const auto first_scaled = std::stable_partition(order_.begin(), order_.end(),
                                                    [&](std::size_t k) { return !rules[k].scale; });
    const bool is_changed = std::any_of(first_scaled, order_.end(), [&](std::size_t scaled) {
        return std::any_of(order_.begin(), first_scaled,
                           [&](std::size_t k) { return may_change(rules[k], rules[scaled]); });
    });
    if (first_scaled != order_.end() && !is_changed) own_ = resolved(whole_);
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
        if (is_fixed(mission_.vary[k], source_)) continue;
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
    std::vector<std::string> values(mission_.vary.size());
    for (const std::size_t k : order_) {
        const VaryConfig& rule = mission_.vary[k];
        const auto of =
            rule.per == VaryPer::dataset ? all_variants : static_cast<std::uint32_t>(index);
        values[k] = draw_value(rule, mission_.seed, static_cast<std::uint32_t>(k), of);
    }
    return values;
}

DrawnValues Variants::drawn_of(const std::vector<std::string>& values) const {
    DrawnValues drawn;
    std::optional<YamlNode> changed;  // the values that rules with `scale` multiply, without own_
    for (const std::size_t k : order_) {
        const VaryConfig& rule = mission_.vary[k];
        if (!rule.scale) {
            drawn.emplace_back(rule.key, values[k]);
            continue;
        }
        if (!own_ && !changed) {
            YamlNode root = whole_;
            set_drawn(root, drawn);
            changed = resolved(root);
        }
        drawn.emplace_back(rule.key, scaled(rule, values[k], own_ ? *own_ : *changed));
    }
    return drawn;
}

/// Sets values that drawn_of() gave, its first or all.
void Variants::set_drawn(YamlNode& root, const DrawnValues& drawn) const {
    for (std::size_t i = 0; i < drawn.size(); ++i)
        set_text(root, drawn[i].first, drawn[i].second, mission_.vary[order_[i]].place);
}

Mission Variants::make(int index, const std::vector<std::string>& values) const {
    YamlNode root = whole_;
    set_text(root, "seed", std::to_string(seed(index)), {source_.file.string()});
    Variant variant{index, drawn_of(values), objects_};
    set_drawn(root, variant.drawn);
    Mission made = parsed(root);
    made.output.folder = mission_.output.folder / variant_folder(index);
    made.variant = std::move(variant);
    return made;
}

Mission Variants::parsed(const YamlNode& root) const {
    return parse_mission(root, source_.file.string(), source_.base_folder, sonars_);
}

/// The document of a mission with all values.
YamlNode Variants::resolved(const YamlNode& root) const {
    return read_document(resolved_yaml(parsed(root), sonars_), "");
}

}  // namespace sonarsim
