#include "paper/range_noise.h"

#include <algorithm>
#include <array>

#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr std::size_t block = 128;

}  // namespace

ScattererLattice scatterer_lattice(const RangeNoise& noise, const Scene& scene,
                                   const Pose& T_world_sensor) {
    if (noise.lambda_m <= 0.0F) return {};
    return {.edge_m = noise.scatterer_m,
            .R_world_sensor = T_world_sensor.rotation.toRotationMatrix().cast<float>(),
            .sensor = (T_world_sensor.translation - scene.origin).cast<float>()};
}

void add_range_noise(Echoes& echoes, const RangeNoise& noise, PhiloxKey key) {
    if (noise.lambda_m <= 0.0F) return;
    std::array<std::uint32_t, block> low{};
    std::array<std::uint32_t, block> high{};
    const float keep = noise.fades ? 0.0F : 1.0F;
    for (std::size_t begin = 0; begin < echoes.size(); begin += block) {
        const std::size_t count = std::min(block, echoes.size() - begin);
        std::copy_n(echoes.cell_low.begin() + begin, count, low.begin());
        std::copy_n(echoes.cell_high.begin() + begin, count, high.begin());
        philox_pairs(low.data(), high.data(), (count + 7) / 8 * 8, key);
        float* const __restrict range = echoes.range_m.data() + begin;
        float* const __restrict intensity = echoes.intensity.data() + begin;
        for (std::size_t k = 0; k < count; ++k) {
            // w = -lambda ln u, so that exp(-w / lambda) is u itself.
            const float u = unit_float(low[k]);
            range[k] -= noise.lambda_m * natural_log(u);
            intensity[k] *= keep + (1.0F - keep) * u;
        }
    }
}

}  // namespace sonarsim
