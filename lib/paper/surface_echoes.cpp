#include "trace/surface_echoes.h"

#include <algorithm>
#include <utility>

#include "paper/echoes.h"
#include "paper/multipath_echoes.h"
#include "paper/paper_model.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

/// Area times intensity of a sample, the numerator of Eq. 9.
double echo_of(const Sample& sample, const Material& material) {
    const double range_m = arrival_range(sample.position);
    const double reflection = material.reflection * sample.strength;
    return sample.area_m2 * reflection * std::min(sample.height_m / range_m, 1.0);
}

BeamEchoes direct_by_beam(const Samples& samples, const View& view, const Scene& scene) {
    // Room for most pings, since arrays that grow are copied.
    constexpr std::size_t pieces_per_sample = 8;
    Echoes echoes;
    echoes.resize(pieces_per_sample * samples.items.size(), false);
    std::vector<std::uint32_t> ends;
    ends.reserve(samples.items.size());
    direct_echoes(samples.items, scene.materials, static_cast<float>(view.bin_m()),
                  ScattererLattice{}, echoes, ends);
    BeamEchoes out;
    out.sample.reserve(echoes.size());
    for (std::size_t k = 0; k < ends.size(); ++k)
        out.sample.resize(ends[k], &samples.items[k]);
    for (const std::uint32_t begin : samples.beam_begin)
        out.beam_begin.push_back(begin > 0 ? ends[begin - 1] : 0);
    out.boxes = std::move(echoes);
    return out;
}

}  // namespace

SurfaceEchoes PaperModel::surface_echoes(const TracedPing& traced, const View& view,
                                         const Scene& scene, bool patches) const {
    const Samples& samples = traced.samples;
    SurfaceEchoes out;
    out.direct = direct_by_beam(samples, view, scene);
    MultipathEchoes bounced = multipath_echoes(traced.bounces, samples, view, ScattererLattice{});
    for (const std::uint32_t sample : bounced.sample)
        out.multipath.sample.push_back(&samples.items[sample]);
    out.multipath.boxes = std::move(bounced.echoes);
    out.multipath.beam_begin = std::move(bounced.beam_begin);
    if (!patches) return out;
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
