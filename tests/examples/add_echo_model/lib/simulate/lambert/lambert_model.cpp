#include "simulate/lambert/lambert_model.h"

#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

float echo_of(const Sample& sample, const Scene& scene) {
    const float range = arrival_range(sample.position);
    const float cosine = sample.height_m / range;
    const float reflection = scene.materials[sample.material].reflection * sample.strength;
    return reflection * cosine * cosine * sample.area_m2 / (range * range * range * range);
}

}  // namespace

void LambertModel::form(const TracedPing& traced, const FormContext& context, Ping& ping) const {
    if (!context.terms.direct) return;
    const View& view = context.view;
    for (int beam = 0; beam < ping.beams; ++beam) {
        for (const Sample& sample : traced.samples.beam(beam)) {
            const float range = arrival_range(sample.position);
            const auto bin =
                static_cast<int>(std::floor((range - view.range_min_m) / view.bin_m()));
            if (bin < 0 || bin >= ping.range_bins) continue;
            ping.intensity[static_cast<std::size_t>(bin) * ping.beams + beam] +=
                echo_of(sample, context.scene);
            ++ping.counts.echoes;
        }
    }
}

SurfaceEchoes LambertModel::surface_echoes(const TracedPing& traced, const View& view,
                                           const Scene& scene, const EchoRequest& request,
                                           const UseEchoes& use) const {
    SurfaceEchoes out;
    EchoBlocks blocks(use);
    for (int beam = 0; beam < view.beams; ++beam) {
        for (const Sample& sample : traced.samples.beam(beam)) {
            const float echo = echo_of(sample, scene);
            blocks.add(static_cast<std::uint32_t>(beam), arrival_range(sample.position), 0.0F, echo,
                       1.0F, &sample);
            if (!request.patches) continue;
            const auto at = static_cast<std::uint32_t>(out.patch_echoes.size());
            out.patch_echoes.push_back({static_cast<std::uint32_t>(beam), echo});
            out.patches.push_back(
                {sample.position, sample.edge_u, sample.edge_v, at, at + 1, &sample});
        }
    }
    blocks.flush();
    out.patch_begin = traced.samples.beam_begin;
    return out;
}

}  // namespace sonarsim
