#include "product/grey.h"

#include <algorithm>

namespace sonarsim {

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
