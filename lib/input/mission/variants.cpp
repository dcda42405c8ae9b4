#include "input/mission/variants.h"

#include <algorithm>
#include <optional>

#include "core/random.h"
#include "core/text.h"
#include "input/mission/parse.h"
#include "input/mission/ping_draws.h"
#include "input/mission/preset.h"
#include "input/mission/resolved.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t all_variants = 0xFFFFFFFFU;
constexpr std::uint32_t no_sensor = 0xFFFFFFFFU;

std::uint64_t seed_of(std::uint64_t seed, std::uint32_t variant) {
    const PhiloxKey key = stream_key(seed, no_sensor, variant, Stream::variation);
    return (std::uint64_t{key.k1} << 32) | key.k0;
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

/// The values of a variant by the rules of `vary`; "" for rules that are drawn for every ping.
std::vector<std::string> draw_values(const Mission& mission, std::uint32_t index) {
    std::vector<std::string> values;
    for (std::size_t k = 0; k < mission.vary.size(); ++k) {
        const VaryConfig& rule = mission.vary[k];
        values.push_back(rule.per == VaryPer::ping
                             ? ""
                             : draw_value(rule, mission.seed, static_cast<std::uint32_t>(k),
                                          rule.per == VaryPer::dataset ? all_variants : index));
    }
    return values;
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

/// Makes missions of values that are drawn.
class VariantMaker {
  public:
    VariantMaker(const Mission& mission, const MissionSource& source, SonarKeyTable sonars)
        : mission_(mission),
          source_(source),
          sonars_(sonars),
          whole_(read_mission_document(source)) {
        fill_in_rules(whole_, source.base_folder);
        erase_key(whole_, "variants");
        keep_rules_of_pings(whole_, mission.vary);
    }

    Mission make(int index, const std::vector<std::string>& values) const {
        YamlNode root = whole_;
        set_text(root, "seed",
                 std::to_string(seed_of(mission_.seed, static_cast<std::uint32_t>(index))),
                 {source_.file.string()});
        Variant variant;
        variant.index = index;
        const auto set = [&](const VaryConfig& rule, const std::string& value) {
            set_text(root, rule.key, value, rule.place);
            variant.drawn.emplace_back(rule.key, value);
        };
        for (std::size_t k = 0; k < values.size(); ++k) {
            const VaryConfig& rule = mission_.vary[k];
            if (rule.per != VaryPer::ping && !rule.scale) set(rule, values[k]);
        }
        if (std::ranges::any_of(mission_.vary, has_scale)) {
            // After the other rules, one of which may draw a preset.
            const YamlNode own = read_document(resolved_yaml(parsed(root), sonars_), "");
            for (std::size_t k = 0; k < values.size(); ++k) {
                const VaryConfig& rule = mission_.vary[k];
                if (rule.scale) set(rule, scaled(rule, values[k], own));
            }
        }
        Mission drawn = parsed(root);
        drawn.output.folder = mission_.output.folder / variant_folder(index);
        drawn.variant = std::move(variant);
        return drawn;
    }

  private:
    Mission parsed(const YamlNode& root) const {
        return parse_mission(root, source_.file.string(), source_.base_folder, sonars_);
    }

    const Mission& mission_;
    const MissionSource& source_;
    SonarKeyTable sonars_;
    YamlNode whole_;
};

/// The values of a rule that show all objects that it may bring.
std::vector<std::string> choices_of_objects(const VaryConfig& rule) {
    const bool is_of_objects = rule.key.starts_with("scene") || rule.key.starts_with("classes");
    if (!is_of_objects || rule.per != VaryPer::variant) return {};
    if (!rule.whole) return rule.choice.items;
    return {std::to_string(static_cast<std::int64_t>((*rule.whole)[1]))};
}

}  // namespace

std::string variant_folder(int index) {
    const std::string number = std::to_string(index);
    constexpr std::size_t digits = 4;
    return "variant_" + std::string(digits - std::min(digits, number.size()), '0') + number;
}

std::vector<Mission> draw_variants(const Mission& mission, const MissionSource& source,
                                   SonarKeyTable sonars) {
    const VariantMaker maker(mission, source, sonars);
    std::vector<Mission> variants;
    variants.reserve(static_cast<std::size_t>(mission.variants));
    for (int i = 0; i < mission.variants; ++i)
        variants.push_back(maker.make(i, draw_values(mission, static_cast<std::uint32_t>(i))));
    return variants;
}

std::vector<Mission> extreme_variants(const Mission& mission, const MissionSource& source,
                                      SonarKeyTable sonars) {
    const VariantMaker maker(mission, source, sonars);
    std::vector<Mission> extremes;
    for (std::size_t k = 0; k < mission.vary.size(); ++k) {
        for (const std::string& value : choices_of_objects(mission.vary[k])) {
            std::vector<std::string> values = draw_values(mission, 0);
            values[k] = value;
            extremes.push_back(maker.make(0, values));
        }
    }
    return extremes;
}

}  // namespace sonarsim
