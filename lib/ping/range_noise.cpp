#include "ping/range_noise.h"

#include "core/elementary.h"

namespace sonarsim {

void add_range_noise(Echoes& echoes, float lambda_m, bool fades, PhiloxKey key) {
    const std::size_t count = echoes.size();
    const std::int32_t* const x = echoes.cell_x.data();
    const std::int32_t* const y = echoes.cell_y.data();
    const std::int32_t* const z = echoes.cell_z.data();
    float* const range = echoes.range_m.data();
    float* const intensity = echoes.intensity.data();
    const float keep = fades ? 0.0F : 1.0F;
#pragma GCC ivdep
    for (std::size_t k = 0; k < count; ++k) {
        const PhiloxBlock block =
            philox({static_cast<std::uint32_t>(x[k]), static_cast<std::uint32_t>(y[k]),
                    static_cast<std::uint32_t>(z[k]), 0},
                   key);
        const float u = unit_float(block.x0);
        range[k] -= lambda_m * natural_log(u);
        // w = -lambda ln u, so that exp(-w / lambda) is u itself.
        intensity[k] *= keep + (1.0F - keep) * u;
    }
}

}  // namespace sonarsim
