#include "mission/variants.h"

#include <algorithm>

#include "core/random.h"
#include "mission/draw_value.h"
#include "mission/override.h"
#include "mission/parse.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t all_variants = 0xFFFFFFFFU;
constexpr std::uint32_t of_the_seed = 0xFFFFFFFFU;

std::uint64_t seed_of(std::uint64_t seed, std::uint32_t variant) {
    const PhiloxKey key = stream_key(seed, of_the_seed, variant, Stream::variation);
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

}  // namespace

std::string variant_folder(int index) {
    const std::string number = std::to_string(index);
    constexpr std::size_t digits = 4;
    return "variant_" + std::string(digits - std::min(digits, number.size()), '0') + number;
}

std::vector<Mission> draw_variants(const Mission& mission, const MissionSource& source,
                                   SonarKeyTable sonars) {
    YamlNode whole = read_mission_document(source);
    erase_key(whole, "variants");
    keep_rules_of_pings(whole, mission.vary);
    std::vector<Mission> variants;
    for (int i = 0; i < mission.variants; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        YamlNode root = whole;
        set_text(root, "seed", std::to_string(seed_of(mission.seed, index)),
                 {source.file.string()});
        Variant variant{.index = i, .of = mission.variants, .drawn = {}};
        for (std::size_t k = 0; k < mission.vary.size(); ++k) {
            const VaryConfig& rule = mission.vary[k];
            if (rule.per == VaryPer::ping) continue;
            std::string value = draw_value(rule, mission.seed, static_cast<std::uint32_t>(k),
                                           rule.per == VaryPer::dataset ? all_variants : index);
            set_text(root, rule.key, value, rule.place.location);
            variant.drawn.emplace_back(rule.key, std::move(value));
        }
        Mission& drawn = variants.emplace_back(
            parse_mission(root, source.file.string(), source.base_folder, sonars));
        drawn.output.folder = mission.output.folder / variant_folder(i);
        drawn.variant = std::move(variant);
    }
    return variants;
}

}  // namespace sonarsim
