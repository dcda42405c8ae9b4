#include "mission/variants.h"

#include <algorithm>
#include <memory>

#include "core/random.h"
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

/// A value that stands where `place` says, with all that is in it.
void put_at(YamlNode& node, const YamlPlace& place) {
    node.place = place;
    node.key_place = place;
    for (YamlNode& item : node.items)
        put_at(item, place);
}

void set(YamlNode& root, const std::string& key, const std::string& value,
         const Location& location) {
    YamlNode node = read_document(value, location.file, Lines::none);
    const auto name = std::make_shared<const std::string>(location.file);
    put_at(node, {name, location.line, location.column});
    set_key(root, key, std::move(node), location);
}

void erase(YamlNode& root, std::string_view key) {
    std::erase_if(root.items, [&](const YamlNode& item) { return item.key == key; });
}

}  // namespace

std::string variant_folder(int index) {
    const std::string number = std::to_string(index);
    constexpr std::size_t digits = 4;
    return "variant_" + std::string(digits - std::min(digits, number.size()), '0') + number;
}

std::vector<Mission> draw_variants(const Mission& mission, const MissionSource& source,
                                   SonarKeyTable sonars) {
    YamlNode whole = read_mission_document(source.file, source.overrides);
    erase(whole, "variants");
    erase(whole, "vary");
    std::vector<Mission> variants;
    for (int i = 0; i < mission.variants; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        YamlNode root = whole;
        set(root, "seed", std::to_string(seed_of(mission.seed, index)), {source.file.string()});
        Variant variant{.index = i, .of = mission.variants, .drawn = {}};
        for (std::size_t k = 0; k < mission.vary.size(); ++k) {
            const VaryConfig& rule = mission.vary[k];
            std::string value = draw_value(rule, mission.seed, static_cast<std::uint32_t>(k),
                                           rule.per == VaryPer::dataset ? all_variants : index);
            set(root, rule.key, value, rule.place.location);
            variant.drawn.emplace_back(rule.key, std::move(value));
        }
        Mission& drawn = variants.emplace_back(
            parse_mission(root, source.file.string(), source.base_folder, sonars));
        drawn.output.folder = mission.output.folder / variant_folder(i);
        drawn.output.split = {};  // which parts whole variants
        drawn.variant = std::move(variant);
    }
    return variants;
}

}  // namespace sonarsim
