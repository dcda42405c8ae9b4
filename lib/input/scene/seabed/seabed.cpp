#include "input/scene/seabed/seabed.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// With two triangles each, a scene then takes about 12 GB.
constexpr double max_cells_of_bed = 33554432.0;

/// The cells from `low` to `high` along one axis, with a margin: the first, and the one after the
/// last. A bed with a size has no cells outside it; if fewer than two remain, all are taken.
std::array<double, 2> cells_within(double low, double high, double cell_m, double size_m) {
    constexpr double margin = 2.0;
    const double first = std::floor(low / cell_m) - margin;
    const double last = std::ceil(high / cell_m) + margin;
    if (size_m == 0.0) return {first, last};
    const double count = std::floor(size_m / cell_m + 1e-9);
    const double from = std::max(first, 0.0);
    const double to = std::min(last, count);
    if (to - from < 2.0) return {0.0, count};
    return {from, to};
}

/// The height of the bed between the heights of the grid, on its triangles.
double height_at(const Seabed& bed, double x_m, double y_m) {
    const BedGrid& grid = bed.grid;
    // Counted from the bed's (0, 0), so that the rounding is the same in every part.
    const double across = x_m / grid.cell_m - 0.5;
    const double up = y_m / grid.cell_m - 0.5;
    const double west = std::floor(across);
    const double north = std::ceil(up);
    const double u = across - west;
    const double v = north - up;
    const int column =
        std::clamp(static_cast<int>(west - static_cast<double>(grid.west)), 0, grid.columns - 2);
    const int row =
        std::clamp(static_cast<int>(static_cast<double>(grid.north) - north), 0, grid.rows - 2);
    const auto z = [&](int r, int c) {
        return static_cast<double>(
            bed.heights[static_cast<std::size_t>(row + r) * static_cast<std::size_t>(grid.columns) +
                        static_cast<std::size_t>(column + c)]);
    };
    // The diagonal runs from the north-west to the south-east.
    if (u > v) return z(0, 0) + u * (z(0, 1) - z(0, 0)) + v * (z(1, 1) - z(0, 1));
    return z(0, 0) + v * (z(1, 0) - z(0, 0)) + u * (z(1, 1) - z(1, 0));
}

void add_rocks(const SeabedConfig& config, std::uint64_t seed, Seabed& bed) {
    constexpr double max_rocks = 50000.0;
    const BedGrid& grid = bed.grid;
    // Within the outer heights, where every point has a height.
    const Eigen::AlignedBox2d area(Eigen::Vector2d(grid.x_m(0), grid.y_m(grid.rows - 1)),
                                   Eigen::Vector2d(grid.x_m(grid.columns - 1), grid.y_m(0)));
    const double count = area.volume() * config.rocks->density_per_m2;
    if (count > max_rocks) {
        refuse(config.place,
               "the part of the seabed that the mission needs has some {:.0f} rocks, and at most "
               "{:.0f} have room; lower their density_per_m2",
               count, max_rocks);
    }
    bed.rock_shapes = rock_shapes(seed);
    bed.rocks = rocks_in(area, *config.rocks, config.cell_m, seed);
    bed.rock_material = config.rocks->material;
    for (Rock& rock : bed.rocks) {
        auto at = rock.T_world_shape.translation();
        const Eigen::AlignedBox3d box = box_of(bed.rock_shapes[rock.shape]);
        const double z = height_at(bed, at.x(), at.y());
        at.z() = z - rock.diameter_m * (box.min().z() + rock.buried * box.sizes().z());
    }
}

/// The longest waves of the sediments' field, in patches. A rule.
constexpr double longest_wave = 8.0;

/// The quantile of the normal(0, 1) distribution, within 4.5e-4 (Abramowitz and Stegun 26.2.23).
double normal_quantile(double probability) {
    const double tail = std::max(std::min(probability, 1.0 - probability), 1e-300);
    const double t = std::sqrt(-2.0 * logarithm(tail));
    const double quantile = t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                                    (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    return std::copysign(quantile, probability - 0.5);
}

/// The `length_m` of a smooth_field() that crosses its mean upwards once in `patch_m`, on average
/// along a line. Rice: a process of unit variance crosses 0 upwards sqrt(-C''(0)) / (2 pi) times
/// per metre, and here C''(0) = -1 / (2 length^2).
double length_of_patches(double patch_m) {
    return patch_m / (2.0 * pi * std::sqrt(2.0));
}

/// Cuts a random field into as many bands as there are sediments: each has its share of the bed,
/// and borders on those before and after it in the list. The field has octaves of waves, down to 4
/// cells. They have equal variance down to `patch_m`, so that patches join to large ones. Below,
/// amplitudes fall as wavelength^0.75: then borders have the dimension 1.25, as the coast of
/// Britain has it (Mandelbrot, Science 156 (1967), 636). Sediments mix over 0.1 to 0.6 `patch_m`,
/// by the seed (rule).
BedSediments sediments_of(const BedGrid& grid, const std::vector<BedSedimentConfig>& list,
                          double patch_m, std::uint64_t seed) {
    BedSediments out{std::vector<std::uint8_t>(grid.size(), 0), {}, {}, 0.0F};
    if (list.size() < 2) return out;
    constexpr double fall = 0.5946035575013605;  // 0.5^0.75
    out.values.resize(grid.size(), 0.0F);
    double amplitude = 1.0;
    double variance = 0.0;
    std::uint32_t octave = 0;
    for (double wave_m = longest_wave * patch_m; octave == 0 || wave_m >= 4.0 * grid.cell_m;
         wave_m *= 0.5) {
        const std::vector<float> waves = smooth_field(grid, length_of_patches(wave_m),
                                                      bed_key(seed, BedDraw::sediments, octave++));
        for (std::size_t i = 0; i < waves.size(); ++i)
            out.values[i] += static_cast<float>(amplitude) * waves[i];
        variance += amplitude * amplitude;
        if (wave_m <= patch_m) amplitude *= fall;
    }
    // The slope of waves of one variance with lengths patch_m, 2 patch_m, ... is 2 pi / patch_m
    // times the root of 1 + 1/4 + ..., 7 / patch_m, so that a border is 0.1 to 0.6 patch_m wide.
    const PhiloxKey key = bed_key(seed, BedDraw::sediments, 255);
    out.mixed = 0.3F + 1.9F * unit_float(philox({0, 0, 0, 0}, key).x0);
    double sum = 0.0;
    for (const BedSedimentConfig& sediment : list)
        sum += sediment.share;
    double below = 0.0;
    for (const BedSedimentConfig& sediment : list) {
        below += sediment.share;
        out.limits.push_back(
            static_cast<float>(std::sqrt(variance) * normal_quantile(below / sum)));
    }
    out.limits.pop_back();
    for (std::size_t i = 0; i < out.cells.size(); ++i) {
        for (const float limit : out.limits)
            out.cells[i] =
                static_cast<std::uint8_t>(out.cells[i] + (out.values[i] > limit ? 1 : 0));
    }
    return out;
}

}  // namespace

std::string rock_name(std::size_t index) {
    return "rock_" + std::to_string(index + 1);
}

std::vector<BedMixture> mixtures_of(const Seabed& bed) {
    constexpr std::size_t count = 2 * border_mixtures;
    std::vector<BedMixture> out;
    for (std::size_t first = 0; first < bed.sediments.limits.size(); ++first) {
        for (std::size_t step = 1; step <= count; ++step) {
            const std::size_t beyond = step / (border_mixtures + 1);
            const std::size_t min_share = beyond ? count + 1 - step : step;
            out.push_back(
                {fmt::format("{} + {} % {}", bed.materials[first + beyond],
                             100 * min_share / (count + 1), bed.materials[first + 1 - beyond]),
                 first, static_cast<double>(step) / static_cast<double>(count + 1)});
        }
    }
    return out;
}

std::vector<std::string> materials_of(const Seabed& bed) {
    std::vector<std::string> names = bed.materials;
    names.push_back(bed.rock_material);
    std::erase(names, "");
    return names;
}

BedGrid grid_of(const SeabedConfig& config, const Eigen::AlignedBox2d& window) {
    const std::array<double, 2> size = config.size_m.value_or(std::array{0.0, 0.0});
    const auto x = cells_within(window.min().x(), window.max().x(), config.cell_m, size[0]);
    const auto y = cells_within(window.min().y(), window.max().y(), config.cell_m, size[1]);
    const double columns = x[1] - x[0];
    const double rows = y[1] - y[0];
    if (columns < 2.0 || rows < 2.0)
        refuse(config.place, "size_m has fewer than 2 x 2 cells of cell_m; make it larger");
    if (columns * rows > max_cells_of_bed) {
        refuse(config.place,
               "the mission needs {:.0f} x {:.0f} heights of the seabed, and at most 2^25 have "
               "room; raise cell_m, or shorten the trajectory or the ranges",
               columns, rows);
    }
    return {config.cell_m, static_cast<std::int64_t>(x[0]), static_cast<std::int64_t>(y[1]) - 1,
            static_cast<int>(columns), static_cast<int>(rows)};
}

Seabed make_seabed(const SeabedConfig& config, std::uint64_t seed,
                   const Eigen::AlignedBox2d& window) {
    Seabed bed;
    bed.grid = grid_of(config, window);
    bed.class_name = config.class_name;
    std::vector<double> heights(bed.grid.size(), config.z_m);
    if (config.ripples) add_ripples(bed.grid, *config.ripples, seed, heights);
    if (config.roughness) add_roughness(bed.grid, *config.roughness, seed, heights);
    bed.heights.reserve(heights.size());
    for (const double z : heights)
        bed.heights.push_back(static_cast<float>(z));
    bed.materials = {config.material};
    if (!config.sediments.empty()) bed.materials.clear();
    for (const BedSedimentConfig& sediment : config.sediments)
        bed.materials.push_back(sediment.material);
    bed.sediments = sediments_of(bed.grid, config.sediments, config.patch_m, seed);
    if (config.rocks) add_rocks(config, seed, bed);
    return bed;
}

}  // namespace sonarsim
