#include "scene/seabed/seabed.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/units.h"
#include "scene/gltf/surface_of.h"
#include "support/bed_spectrum.h"

using namespace sonarsim;
using sonarsim::test::spectrum_at;

namespace {

SeabedRule rule_of_size(double half_m, double cell_m = 0.05) {
    SeabedRule rule;
    rule.cell_m = cell_m;
    rule.window = {-half_m, -half_m, half_m, half_m};
    return rule;
}

SeabedRule everything() {
    SeabedRule rule = rule_of_size(3.0);
    rule.seed = 11;
    rule.z_m = -20.0;
    rule.roughness = BedRoughness{1e-4, 3.25, 2.0};
    rule.ripples = BedRipples{0.03, 0.2, 0.5};
    return rule;
}

Surface surface_of_bed(const Seabed& bed) {
    PlacedFile placed;
    placed.z_up = true;
    placed.seabed = std::make_shared<const Seabed>(bed);
    SceneFiles files;
    return surface_of(placed, files);
}

}  // namespace

TEST_CASE("the spectrum of a bed has its strength and exponent") {
    // 28 beds, 6 wavelengths from 1 m to 4 cells, 8 directions each, which lie more than the
    // window's width apart: each mean of a wavelength has the deviation 1 / sqrt(28 * 8) = 6.7 %.
    constexpr int beds = 28;
    constexpr int wavelengths = 6;
    constexpr int directions = 8;
    SeabedRule rule = rule_of_size(4.0);
    rule.roughness = BedRoughness{roughness_strength(0.004, 3.0), 3.0, 2.0};
    std::vector<double> ratios(wavelengths, 0.0);
    std::vector<double> logs(wavelengths, 0.0);
    const double corner = 2.0 * pi / rule.roughness->corner_m;
    for (int b = 0; b < beds; ++b) {
        rule.seed = static_cast<std::uint64_t>(b);
        const Seabed bed = make_seabed(rule);
        for (int n = 0; n < wavelengths; ++n) {
            const double k = 2.0 * pi / std::pow(0.2, n / (wavelengths - 1.0));
            const double expected =
                rule.roughness->strength * std::pow(k * k + corner * corner, -1.5);
            for (int d = 0; d < directions; ++d) {
                const double angle = pi * (d + 0.3) / directions;
                const double found = spectrum_at(bed, k * std::cos(angle), k * std::sin(angle));
                ratios[static_cast<std::size_t>(n)] += found / expected / (beds * directions);
            }
            logs[static_cast<std::size_t>(n)] = std::log(k);
        }
    }
    double strength = 0.0;
    double mean_log = 0.0;
    for (int n = 0; n < wavelengths; ++n) {
        CAPTURE(n);
        const double ratio = ratios[static_cast<std::size_t>(n)];
        CAPTURE(ratio);
        // 4 deviations (p = 6e-5), and 4 % for the steps of the octaves.
        CHECK(std::abs(ratio - 1.0) < 0.31);
        strength += ratio / wavelengths;
        mean_log += logs[static_cast<std::size_t>(n)] / wavelengths;
    }
    // The mean of all has 2.7 %.
    CHECK(std::abs(strength - 1.0) < 0.15);
    // The slope of the ratios, of deviation 0.067 / sqrt(sum of squares of log k).
    double slope = 0.0;
    double squares = 0.0;
    for (std::size_t n = 0; n < wavelengths; ++n) {
        slope += (logs[n] - mean_log) * std::log(ratios[n]);
        squares += (logs[n] - mean_log) * (logs[n] - mean_log);
    }
    CHECK(std::abs(slope / squares) < 4.0 * 0.067 / std::sqrt(squares) + 0.05);
}

TEST_CASE("ripples have their length, direction and height") {
    for (const double angle : {0.4, 2.0}) {
        SeabedRule rule = rule_of_size(6.0);
        rule.seed = 3;
        rule.ripples = BedRipples{0.03, 0.25, angle};
        const Seabed bed = make_seabed(rule);
        const double k = 2.0 * pi / 0.25;
        double power = 0.0;
        double sum_x = 0.0;
        double sum_y = 0.0;
        for (int i = -7; i <= 7; ++i) {
            for (int j = -7; j <= 7; ++j) {
                const double kx = k * (std::cos(angle) + 0.025 * i);
                const double ky = k * (std::sin(angle) + 0.025 * j);
                const double found = spectrum_at(bed, kx, ky);
                power += found;
                sum_x += found * kx;
                sum_y += found * ky;
            }
        }
        // The bed has 144 m^2 (0.05 k)^2 / pi = 72 independent patches of wave vectors that deviate
        // by 5 %: 0.6 % and 0.006 rad, and limits of 4 deviations.
        const double found_k = std::hypot(sum_x, sum_y) / power;
        CHECK(std::abs(2.0 * pi / found_k / 0.25 - 1.0) < 0.024);
        CHECK(std::abs(std::atan2(sum_y, sum_x) - angle) < 0.024);
        const auto [low, high] = std::ranges::minmax(bed.heights);
        CHECK(high - low > 0.0285);
        CHECK(high - low <= 0.03);
    }
}

TEST_CASE("a part of a bed is the same bed, bit by bit, and another seed makes another") {
    const SeabedRule rule = everything();
    const Seabed whole = make_seabed(rule);
    CHECK(make_seabed(rule).heights == whole.heights);
    SeabedRule part_rule = rule;
    part_rule.window = {-1.03, 0.2, 0.7, 1.4};
    const Seabed part = make_seabed(part_rule);
    CHECK(part.heights.size() < whole.heights.size() / 4);
    bool same = true;
    for (int row = 0; row < part.grid.rows; ++row) {
        for (int column = 0; column < part.grid.columns; ++column) {
            const auto r = static_cast<std::size_t>(whole.grid.north - part.grid.north + row);
            const auto c = static_cast<std::size_t>(part.grid.west - whole.grid.west + column);
            same = same && whole.heights[r * static_cast<std::size_t>(whole.grid.columns) + c] ==
                               part.heights[static_cast<std::size_t>(row) *
                                                static_cast<std::size_t>(part.grid.columns) +
                                            static_cast<std::size_t>(column)];
        }
    }
    CHECK(same);
    part_rule = rule;
    part_rule.seed = 12;
    CHECK(make_seabed(part_rule).heights != whole.heights);
}

TEST_CASE("a bed of a size ends there") {
    SeabedRule rule = rule_of_size(100.0, 0.5);
    rule.size_m = {8.0, 5.0};
    rule.z_m = -7.0;
    const Surface surface = surface_of_bed(make_seabed(rule));
    const Eigen::AlignedBox3d box = box_of(surface);
    CHECK((box.min() - Eigen::Vector3d(0.25, 0.25, -7.0)).norm() < 1e-6);
    CHECK((box.max() - Eigen::Vector3d(7.75, 4.75, -7.0)).norm() < 1e-6);
    CHECK(surface.triangles.size() == 2 * 15 * 9);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto c = corners_of(surface, t);
        CHECK((c[1] - c[0]).cross(c[2] - c[0]).z() > 0.0);
    }
}
