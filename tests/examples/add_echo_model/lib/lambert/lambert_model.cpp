#include "lambert/lambert_model.h"

#include <cmath>

#include "trace/arrivals.h"

namespace sonarsim {

void LambertModel::form(const TracedPing& traced, const FormContext& context, Ping& ping) const {
    if (!context.terms.direct) return;
    const View& view = context.view;
    for (int beam = 0; beam < ping.beams; ++beam) {
        for (const Sample& sample : traced.samples.beam(beam)) {
            const float range = arrival_range(sample.position);
            const auto bin =
                static_cast<int>(std::floor((range - view.range_min_m) / view.bin_m()));
            if (bin < 0 || bin >= ping.range_bins) continue;
            const float cosine = sample.height_m / range;
            const float reflection = context.scene.materials[sample.material].reflection;
            ping.intensity[static_cast<std::size_t>(bin) * ping.beams + beam] +=
                reflection * cosine * cosine * sample.area_m2 / (range * range * range * range);
            ++ping.counts.echoes;
        }
    }
}

}  // namespace sonarsim
