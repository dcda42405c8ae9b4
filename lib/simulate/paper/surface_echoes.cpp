#include "simulate/trace/surface_echoes.h"

#include <utility>

#include "simulate/paper/echoes.h"
#include "simulate/paper/paper_model.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// Area times intensity of a sample, the numerator of Eq. 9.
double echo_of(const Sample& sample, const Material& material) {
    const double range_m = arrival_range(sample.position);
    const double reflection = material.reflection * sample.strength;
    return sample.area_m2 * reflection * std::min(sample.height_m / range_m, 1.0);
}

/// Hands on echoes that are sorted by beam. `surface_of(k)`: sample and second surface of echo k.
template <class SurfaceOf>
void add_all(const RangeBoxes& echoes, std::span<const std::uint32_t> beam_begin,
             SurfaceOf surface_of, EchoBlocks& blocks) {
    for (std::uint32_t j = 0; j + 1 < beam_begin.size(); ++j) {
        for (std::uint32_t k = beam_begin[j]; k < beam_begin[j + 1]; ++k) {
            const auto [sample, second] = surface_of(k);
            blocks.add(j, echoes.range_m[k], echoes.half_m[k], echoes.weight[k],
                       echoes.intensity[k], sample, second);
        }
    }
}

void add_direct(const Samples& samples, const View& view, const Scene& scene, EchoBlocks& blocks) {
    // Room for most pings, since arrays that grow are copied.
    constexpr std::size_t pieces_per_sample = 8;
    Echoes echoes;
    const std::span<const Sample> surface = samples.in_beams();
    echoes.resize(pieces_per_sample * surface.size(), false);
    std::vector<std::uint32_t> ends;
    ends.reserve(surface.size());
    direct_echoes(surface, scene.materials, static_cast<float>(view.bin_m()), ScattererLattice{},
                  echoes, &ends);
    std::vector<std::uint32_t> beam_begin;
    for (const std::uint32_t begin : samples.beam_begin)
        beam_begin.push_back(begin > 0 ? ends[begin - 1] : 0);
    std::size_t sample = 0;
    const auto surface_of = [&](std::uint32_t k) {
        while (ends[sample] <= k)
            ++sample;
        return std::pair(&surface[sample], no_instance);
    };
    add_all(echoes, beam_begin, surface_of, blocks);
}

}  // namespace

SurfaceEchoes PaperModel::surface_echoes(const TracedPing& traced, const View& view,
                                         const Scene& scene, const EchoRequest& request,
                                         const UseEchoes& use) const {
    const Samples& samples = traced.samples;
    SurfaceEchoes out;
    EchoBlocks blocks(use);
    add_direct(samples, view, scene, blocks);
    blocks.begin_multipath();
    const MultipathEchoes bounced =
        multipath_echoes(traced.bounces, traced.starts(), view, ScattererLattice{});
    const auto surface_of = [&](std::uint32_t k) {
        const BouncePath& path = traced.bounces[bounced.path[k]];
        return std::pair(&traced.starts().items[path.sample], path.instance);
    };
    add_all(bounced.echoes, bounced.beam_begin, surface_of, blocks);
    blocks.flush();
    if (!request.patches) return out;
    out.patch_begin = samples.beam_begin;
    out.patches.reserve(samples.items.size());
    out.patch_echoes.reserve(samples.items.size());
    for (std::uint32_t j = 0; j + 1 < samples.beam_begin.size(); ++j) {
        for (const Sample& sample : samples.beam(static_cast<int>(j))) {
            const auto at = static_cast<std::uint32_t>(out.patch_echoes.size());
            out.patch_echoes.push_back({j, echo_of(sample, scene.materials[sample.material])});
            out.patches.push_back(
                {sample.position, sample.edge_u, sample.edge_v, at, at + 1, &sample});
        }
    }
    return out;
}

}  // namespace sonarsim
