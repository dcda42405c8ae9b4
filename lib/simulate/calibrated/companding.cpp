#include "simulate/calibrated/companding.h"

#include <algorithm>
#include <cmath>

#include "simulate/calibrated/bottom.h"
#include "simulate/calibrated/decibel.h"

namespace sonarsim {

namespace {

// The smallest power for the logarithm: it is a normal float, and every companding makes it 0.
constexpr float min_power = 1e-37F;

/// The function from the natural logarithm of the power, at most 0, to a value in [0, 1].
struct Law {
    bool logarithmic;
    float factor;
};

Law law_of(const ReceiverConfig& receiver) {
    switch (receiver.companding) {
        case Companding::log:
            return {true, static_cast<float>(10.0 / (ln_10 * receiver.dynamic_range_db))};
        case Companding::linear:
            return {false, 0.5F};
        default:
            return {false, static_cast<float>(0.5 * receiver.gamma)};
    }
}

}  // namespace

std::vector<std::uint16_t> companded(std::span<const float> powers,
                                     const ReceiverConfig& receiver) {
    const Law law = law_of(receiver);
    const auto greatest = static_cast<float>((1 << receiver.bits) - 1);
    const auto offset = static_cast<float>(receiver.offset);
    std::vector<std::uint16_t> out(powers.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float power = std::min(std::max(powers[i], min_power), 1.0F);
        const float logarithm_of_power = std::min(natural_log(power), 0.0F);
        const float value = law.logarithmic ? std::max(1.0F + law.factor * logarithm_of_power, 0.0F)
                                            : exp_neg(-law.factor * logarithm_of_power);
        const float above = std::max(value - offset, 0.0F);
        out[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(greatest * above + 0.5F));
    }
    return out;
}

}  // namespace sonarsim
