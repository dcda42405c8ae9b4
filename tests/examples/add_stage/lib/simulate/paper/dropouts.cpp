#include "simulate/paper/dropouts.h"

namespace sonarsim {

int drop_beams(std::span<float> image, int beams, const Dropouts& dropouts, PhiloxKey key) {
    int lost = 0;
    for (int j = 0; j < beams; ++j) {
        const PhiloxBlock draw = philox({static_cast<std::uint32_t>(j), 0, 0, 0}, key);
        if (unit_float(draw.x0) >= dropouts.share) continue;
        ++lost;
        for (std::size_t k = j; k < image.size(); k += beams)
            image[k] = 0.0F;
    }
    return lost;
}

}  // namespace sonarsim
