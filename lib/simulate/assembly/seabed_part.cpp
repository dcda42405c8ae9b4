#include "simulate/assembly/seabed_part.h"

#include <spdlog/fmt/fmt.h>

#include <memory>

#include "core/units.h"

namespace sonarsim {

namespace {

BedRipples ripples_of(const BedRippleConfig& config) {
    return {.height_m = config.height_m,
            .length_m = config.length_m,
            .direction_rad = radians(config.direction_deg)};
}

BedRocks rocks_of(const BedRockConfig& config) {
    return {.density_per_m2 = config.density_per_m2,
            .diameter_m = config.diameter_m,
            .exponent = config.exponent,
            .buried = config.buried,
            .material = config.material};
}

void announce_large(const BedGrid& grid, const std::function<void(const std::string&)>& announce) {
    // Measured with 5,000 x 5,000 heights, until the first ping.
    constexpr double seconds = 1e-6;
    constexpr double bytes = 125.0;
    constexpr double min_seconds = 4.0;
    const auto heights = static_cast<double>(grid.size());
    if (seconds * heights < min_seconds) return;
    announce(
        fmt::format("scene.seabed: {} x {} heights take about {:.0f} s and {:.1f} GB before "
                    "the first ping; a larger cell_m takes less",
                    grid.columns, grid.rows, seconds * heights, 1e-9 * bytes * heights));
}

}  // namespace

SeabedRule rule_of(const SeabedConfig& config, std::uint64_t seed) {
    SeabedRule rule;
    rule.seed = seed;
    rule.cell_m = config.cell_m;
    rule.size_m = config.size_m;
    rule.z_m = config.z_m;
    if (config.roughness) {
        const BedRoughnessConfig& roughness = *config.roughness;
        rule.roughness = BedRoughness{
            roughness_strength(roughness.spectral_strength_cm4, roughness.spectral_exponent),
            roughness.spectral_exponent, roughness.corner_m};
    }
    if (config.ripples) rule.ripples = ripples_of(*config.ripples);
    if (config.rocks) rule.rocks = rocks_of(*config.rocks);
    for (const auto& [material, share] : config.sediments)
        rule.sediments.push_back({material, share});
    rule.patch_m = config.patch_m;
    rule.material = config.material;
    rule.class_name = config.class_name;
    rule.place = config.place;
    return rule;
}

PlacedFile seabed_of(const SeabedConfig& config, std::uint64_t seed,
                     const Eigen::AlignedBox2d& needed,
                     const std::function<void(const std::string&)>& announce) {
    SeabedRule rule = rule_of(config, seed);
    // A rock beyond the ranges may reach into them.
    const double margin_m = rule.rocks ? 0.5 * rule.rocks->diameter_m[1] : 0.0;
    const Eigen::Vector2d low = needed.min() - Eigen::Vector2d::Constant(margin_m);
    const Eigen::Vector2d high = needed.max() + Eigen::Vector2d::Constant(margin_m);
    rule.window = {low.x(), low.y(), high.x(), high.y()};
    if (announce) announce_large(grid_of(rule), announce);
    PlacedFile file{.file = "scene.seabed", .z_up = true, .place = config.place};
    file.seabed = std::make_shared<const Seabed>(make_seabed(rule));
    return file;
}

}  // namespace sonarsim
