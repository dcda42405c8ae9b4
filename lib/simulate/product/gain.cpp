#include "simulate/product/gain.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sonarsim {

namespace {

// The leading bits of a positive float (its exponent and five more) grow with it. They index a
// histogram whose cells are at most 3 % wide.
constexpr int dropped_bits = 18;
constexpr std::size_t cells = 0x80000000U >> dropped_bits;

}  // namespace

Gain::Gain() : counts_(cells, 0) {}

void Gain::add(std::span<const float> intensity) {
    for (const float value : intensity) {
        if (value > 0.0F) ++counts_[std::bit_cast<std::uint32_t>(value) >> dropped_bits];
    }
}

double Gain::white() const {
    std::uint64_t occupied = 0;
    for (const std::uint64_t count : counts_)
        occupied += count;
    if (occupied == 0) return 1.0;
    std::uint64_t above = 0;
    for (std::size_t cell = cells; cell-- > 0;) {
        above += counts_[cell];
        const auto upper = static_cast<std::uint32_t>(cell + 1) << dropped_bits;
        if (100 * above >= occupied) return std::bit_cast<float>(upper);
    }
    return 1.0;
}

float shade(float intensity, float white) {
    return std::sqrt(std::clamp(intensity / white, 0.0F, 1.0F));
}

std::vector<std::uint16_t> grey_16(std::span<const float> intensity, double full_scale) {
    const float scale = static_cast<float>(65535.0 / full_scale);
    std::vector<std::uint16_t> grey(intensity.size());
    for (std::size_t i = 0; i < grey.size(); ++i) {
        const float value = std::min(65535.0F, std::max(0.0F, intensity[i] * scale));
        grey[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(value + 0.5F));
    }
    return grey;
}

}  // namespace sonarsim
