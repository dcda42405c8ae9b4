#include "product/panels.h"

#include <algorithm>

namespace sonarsim {

std::vector<std::uint8_t> render_panels(const FanMap& map, std::span<const Ping> pings,
                                        double full_scale) {
    const auto width = static_cast<std::size_t>(map.frame.width);
    const auto height = static_cast<std::size_t>(map.frame.height);
    std::vector<std::uint8_t> picture(height * width * pings.size());
    for (std::size_t k = 0; k < pings.size(); ++k) {
        const std::vector<std::uint8_t> fan = render_fan(map, pings[k], full_scale);
        for (std::size_t row = 0; row < height; ++row) {
            std::copy_n(fan.data() + row * width, width,
                        picture.data() + (row * pings.size() + k) * width);
        }
    }
    return picture;
}

}  // namespace sonarsim
