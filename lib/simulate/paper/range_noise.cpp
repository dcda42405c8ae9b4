#include "simulate/paper/range_noise.h"

#include <algorithm>
#include <array>

#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr std::size_t block = 128;
constexpr std::size_t lanes_of_philox = 8;

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
    const float keep = noise.fades ? 0.0F : 1.0F;
    const std::size_t whole = echoes.size() / lanes_of_philox * lanes_of_philox;
    for (std::size_t begin = 0; begin < echoes.size();) {
        // In place while whole vectors are left: the names of cells are not needed after this.
        const std::size_t count =
            begin < whole ? std::min(block, whole - begin) : echoes.size() - begin;
        std::array<std::uint32_t, lanes_of_philox> last_low{}, last_high{};
        std::uint32_t* low = echoes.cell_low.data() + begin;
        std::uint32_t* high = echoes.cell_high.data() + begin;
        if (begin == whole) {
            std::copy_n(low, count, last_low.begin());
            std::copy_n(high, count, last_high.begin());
            low = last_low.data();
            high = last_high.data();
        }
        philox_pairs(low, high, std::max(count, lanes_of_philox), key);
        float* const __restrict range = echoes.range_m.data() + begin;
        float* const __restrict intensity = echoes.intensity.data() + begin;
        for (std::size_t k = 0; k < count; ++k) {
            // w = -lambda ln u, so that exp(-w / lambda) is u itself.
            const float u = unit_float(low[k]);
            range[k] -= noise.lambda_m * natural_log(u);
            intensity[k] *= keep + (1.0F - keep) * u;
        }
        begin += count;
    }
}

}  // namespace sonarsim
