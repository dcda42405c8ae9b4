#include "input/mission/draw_value.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/text.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t max_tries = 1000;

/// Draws two numbers in [0, 1).
std::array<double, 2> unit_pair(PhiloxKey key, std::uint32_t attempt) {
    const PhiloxBlock block = philox({attempt, 0, 0, 0}, key);
    return {unit_double(block.x0, block.x1), unit_double(block.x2, block.x3)};
}

double part_of(const std::array<double, 2>& range, double share) {
    return range[0] + share * (range[1] - range[0]);
}

/// Draws a normal number by the method of Box and Muller.
double standard_normal(const std::array<double, 2>& u) {
    constexpr double turn = 6.283185307179586;
    return std::sqrt(-2.0 * logarithm(1.0 - u[0])) * sincos(turn * u[1]).cos;
}

double draw_normal(const VaryConfig& rule, PhiloxKey key) {
    const auto [mean, sigma] = *rule.normal;
    for (std::uint32_t attempt = 0; attempt < max_tries; ++attempt) {
        const double value = mean + sigma * standard_normal(unit_pair(key, attempt));
        if (!rule.within || ((*rule.within)[0] <= value && value <= (*rule.within)[1]))
            return value;
    }
    throw InputError(rule.place,
                     "a thousand normal draws of '" + printable(rule.key) +
                         "' lie outside of 'within'; make it wider or the deviation larger");
}

std::size_t one_of(double count, double share) {
    return static_cast<std::size_t>(std::min(std::floor(share * count), count - 1.0));
}

/// The normal distribution function at x.
double normal_below(double mean, double sigma, double x) {
    return 0.5 * std::erfc((mean - x) / (std::sqrt(2.0) * sigma));
}

}  // namespace

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
    const double share = unit_pair(key, 0)[0];
    if (rule.normal) return number_text(draw_normal(rule, key));
    if (rule.uniform) return number_text(part_of(*rule.uniform, share));
    if (rule.log_uniform || rule.scale) {
        const auto [low, high] = rule.scale ? *rule.scale : *rule.log_uniform;
        return number_text(std::min(high, low * exponential(share * logarithm(high / low))));
    }
    if (rule.whole) {
        const double low = std::ceil((*rule.whole)[0]);
        const double count = std::floor((*rule.whole)[1]) - low + 1.0;
        if (count < 1.0) throw InputError(rule.place, "there is no whole number in 'whole'");
        // No exponent, which keys of whole numbers refuse.
        return std::to_string(static_cast<std::int64_t>(low) +
                              static_cast<std::int64_t>(one_of(count, share)));
    }
    return rule.choice.items[one_of(static_cast<double>(rule.choice.items.size()), share)];
}

}  // namespace sonarsim
