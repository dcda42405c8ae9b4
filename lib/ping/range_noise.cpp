#include "ping/range_noise.h"

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
    std::array<std::uint32_t, block> x{};
    std::array<std::uint32_t, block> y{};
    std::array<std::uint32_t, block> z{};
    std::array<std::uint32_t, block> last{};
    const float keep = noise.fades ? 0.0F : 1.0F;
    for (std::size_t begin = 0; begin < echoes.size(); begin += block) {
        const std::size_t count = std::min(block, echoes.size() - begin);
        std::copy_n(echoes.cell_x.begin() + begin, count, x.begin());
        std::copy_n(echoes.cell_y.begin() + begin, count, y.begin());
        std::copy_n(echoes.cell_z.begin() + begin, count, z.begin());
        last.fill(0);
        philox_batch(x.data(), y.data(), z.data(), last.data(), (count + 7) / 8 * 8, key);
        float* const range = echoes.range_m.data() + begin;
        float* const intensity = echoes.intensity.data() + begin;
        for (std::size_t k = 0; k < count; ++k) {
            // w = -lambda ln u, so that exp(-w / lambda) is u itself.
            const float u = unit_float(x[k]);
            range[k] -= noise.lambda_m * natural_log(u);
            intensity[k] *= keep + (1.0F - keep) * u;
        }
    }
}

}  // namespace sonarsim
