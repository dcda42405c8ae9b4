#include "input/mission/variants.h"

#include "core/text.h"
#include "input/mission/ping_draws.h"
#include "mission/fixtures.h"
#include "support/statistics.h"

namespace {

constexpr std::uint32_t draws = 20'000;

double number(const VaryConfig& rule, std::uint32_t variant) {
    return *parse_number(draw_value(rule, 11, 2, variant));
}

/// Mean and standard deviation of f over the draws.
template <class Function>
std::pair<double, double> moments(const VaryConfig& rule, Function f) {
    std::vector<double> values;
    for (std::uint32_t k = 0; k < draws; ++k)
        values.push_back(f(number(rule, k)));
    return {mean(values), deviation(values)};
}

}  // namespace

// A mean of 20,000 draws lies within 4 sigma / sqrt(20000) = 0.0283 sigma of what it should be, but
// for 6 cases in 100,000; a standard deviation of a normal law within 0.02 of its own size.
TEST_CASE("draws: uniform, in the logarithm, and normal") {
    VaryConfig uniform;
    uniform.uniform = {2.0, 5.0};
    const double sigma = 3.0 / std::sqrt(12.0);
    const auto [mean, spread] = moments(uniform, [](double x) { return x; });
    CHECK(std::fabs(mean - 3.5) < 0.0283 * sigma);
    CHECK(std::fabs(spread / sigma - 1.0) < 0.02);

    VaryConfig decades;
    decades.log_uniform = {1e-3, 10.0};
    const double ends = std::log(10.0 / 1e-3);
    const auto [log_mean, log_spread] = moments(decades, [](double x) { return std::log(x); });
    CHECK(std::fabs(log_mean - 0.5 * std::log(1e-3 * 10.0)) < 0.0283 * ends / std::sqrt(12.0));
    CHECK(std::fabs(log_spread / (ends / std::sqrt(12.0)) - 1.0) < 0.02);

    VaryConfig scale;
    scale.scale = decades.log_uniform;
    CHECK(number(scale, 7) == number(decades, 7));

    VaryConfig normal;
    normal.normal = {-4.0, 0.5};
    const auto [middle, width] = moments(normal, [](double x) { return x; });
    CHECK(std::fabs(middle + 4.0) < 0.0283 * 0.5);
    CHECK(std::fabs(width / 0.5 - 1.0) < 0.02);
}

TEST_CASE("draws: they stay within their bounds") {
    VaryConfig rule;
    rule.normal = {0.0, 1.0};
    rule.within = {-0.5, 0.25};
    for (std::uint32_t k = 0; k < draws; ++k) {
        const double x = number(rule, k);
        REQUIRE((-0.5 <= x && x <= 0.25));
    }
}

TEST_CASE("draws: whole numbers and choices are equally likely, both ends included") {
    // The count of one of four has a standard deviation of sqrt(20000 0.25 0.75) = 61.
    VaryConfig whole;
    whole.whole = {-1.5, 2.0};
    VaryConfig choice;
    choice.choice.items = {"a", "b", "c", "d"};
    std::map<double, int> numbers;
    std::map<std::string, int> names;
    for (std::uint32_t k = 0; k < draws; ++k) {
        ++numbers[number(whole, k)];
        ++names[draw_value(choice, 11, 2, k)];
    }
    VaryConfig large;
    large.whole = {100000, 100000};
    CHECK(draw_value(large, 11, 2, 0) == "100000");  // no exponent
    CHECK(numbers.size() == 4);
    CHECK(numbers.begin()->first == -1.0);
    CHECK(names.size() == 4);
    for (const auto& [value, count] : numbers)
        CHECK(std::abs(count - 5000) < 250);
    for (const auto& [value, count] : names)
        CHECK(std::abs(count - 5000) < 250);
}

// Factors of 2 and 3 alone, so each value names what it was multiplied from.
TEST_CASE("variants: a scale multiplies what other rules drew, else the mission's own value") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "m.yaml";
    const std::string scale =
        "  - {key: sensors.fls.noise.add_sigma, scale: [2, 2]}\n"
        "  - {key: water.density_kg_m3, scale: [1.02, 1.02]}\n";
    const auto variants_of = [&](const std::string& rules) {
        write_file(file, smallest_mission + "    noise: {add_sigma: 0.1}\nvariants: 12\nvary:\n" +
                             rules + scale);
        const MissionSource source{file, folder.path, {}};
        return Variants(load_mission(source, sonar_keys()), source, sonar_keys());
    };
    const Variants own = variants_of("");
    CHECK(own[3].sensors[0].noise.add_sigma == 0.2);
    CHECK(own[3].water.density_kg_m3 == approx(1.02 * WaterConfig{}.density_kg_m3));
    const Variants drawn =
        variants_of("  - {key: sensors.fls.noise, choice: [{add_sigma: 0.3}, {add_sigma: 0.5}]}\n");
    std::set<double> found;
    for (int i = 0; i < drawn.size(); ++i) {
        found.insert(drawn[i].sensors[0].noise.add_sigma);
        CHECK(drawn.seed(i) == drawn[i].seed);
        CHECK(drawn.drawn(i) == drawn[i].variant.drawn);
    }
    CHECK(found == std::set<double>{0.6, 1.0});
}
