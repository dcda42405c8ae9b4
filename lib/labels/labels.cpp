#include "labels/labels.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "labels/elevation.h"
#include "labels/height.h"
#include "labels/shadow.h"
#include "labels/shares.h"
#include "paper/multipath_echoes.h"

namespace sonarsim {

namespace {

/// The echoes of a beam are separated by object and material.
struct Surface {
    std::uint32_t object, material;

    auto operator<=>(const Surface&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// Successive samples of one surface.
struct Stretch {
    Surface surface;
    std::uint32_t begin, end;

    auto operator<=>(const Stretch&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

Surface surface_of(const Sample& sample, const SceneObjects& objects) {
    return {objects.object_of(sample.instance), sample.material};
}

/// The samples of a beam surface by surface. Engines return neighbours in space one after the
/// other, so that stretches are few and long.
void find_stretches(std::span<const Sample> samples, const SceneObjects& objects,
                    std::vector<Stretch>& stretches) {
    stretches.clear();
    for (std::uint32_t k = 0; k < samples.size(); ++k) {
        const Surface surface = surface_of(samples[k], objects);
        if (stretches.empty() || stretches.back().surface != surface)
            stretches.push_back({surface, k, k});
        stretches.back().end = k + 1;
    }
    std::ranges::sort(stretches);
}

/// The multipath echoes of one surface, all beams.
struct BouncedSurface {
    Surface surface;
    MultipathEchoes echoes;
};

std::vector<BouncedSurface> bounced_surfaces(const TracedPing& traced, const View& view,
                                             const SceneObjects& objects) {
    const auto surface_of_bounce = [&](const BouncePath& b) {
        return surface_of(traced.samples.items[b.sample], objects);
    };
    std::vector<BouncePath> bounces = traced.bounces;
    std::erase_if(bounces, [](const BouncePath& b) { return b.scattered; });
    std::ranges::stable_sort(bounces, {}, surface_of_bounce);
    std::vector<BouncedSurface> out;
    for (std::size_t a = 0, b = 0; a < bounces.size(); a = b) {
        const Surface surface = surface_of_bounce(bounces[a]);
        while (b < bounces.size() && surface_of_bounce(bounces[b]) == surface)
            ++b;
        out.push_back({surface, multipath_echoes(std::span(bounces).subspan(a, b - a),
                                                 traced.samples, view, ScattererLattice{})});
    }
    return out;
}

std::uint16_t id_16(std::uint32_t id) {
    return static_cast<std::uint16_t>(id);
}

/// Labels one beam after the other. Holds buffers, so that beams after the first allocate nothing.
class BeamLabeller {
  public:
    BeamLabeller(const TracedPing& traced, const View& view, const Scene& scene,
                 const SceneObjects& objects, const LabelRequest& request)
        : traced_(traced),
          scene_(scene),
          objects_(objects),
          request_(request),
          bins_(range_bins(view)),
          bounced_(bounced_surfaces(traced, view, objects)) {}

    /// The shares of beam j, into `out`.
    void label(int j, PingLabels& out) {
        shares_.clear(bins_.count);
        surfaces_.clear();
        add_visible(traced_.samples.beam(j));
        direct_ = shares_.total;
        for (const BouncedSurface& b : bounced_) {
            add(b.surface, b.echoes.echoes, b.echoes.beam_begin[j], b.echoes.beam_begin[j + 1]);
        }
        const std::size_t at = static_cast<std::size_t>(j) * bins_.count;
        const auto object_of = [&](std::uint32_t k) { return surfaces_[k].object; };
        if (request_.objects) {
            finder_.find(shares_, request_.shares ? Ranks::first_and_second : Ranks::first,
                         object_of, strongest_);
            write_ids(at, out.object);
            if (request_.shares) write_shares(at, out);
        }
        if (request_.classes) {
            finder_.find(
                shares_, Ranks::first,
                [&](std::uint32_t k) { return objects_.class_of(object_of(k)); }, strongest_);
            write_ids(at, out.class_id);
        }
        if (request_.materials) {
            finder_.find(
                shares_, Ranks::first, [&](std::uint32_t k) { return surfaces_[k].material; },
                strongest_);
            write_ids(at, out.material);
        }
    }

    /// 1 for the bins of beam j that show surface, 0 for others. `labelled`: label() was called for
    /// this beam. If not, this takes half of the time of label().
    std::span<const std::uint8_t> occupied(int j, bool labelled) {
        lit_.assign(bins_.count + 1, 0);
        if (labelled) {
            for (int i = shares_.first; i < shares_.last; ++i)
                lit_[i] = shares_.weight[i] > 0.0F ? 1 : 0;
            return lit_;
        }
        direct_echoes(traced_.samples.beam(j), scene_.materials, bins_.bin_m, ScattererLattice{},
                      echoes_);
        mark_lit(echoes_, 0, echoes_.size(), bins_, lit_);
        for (const BouncedSurface& b : bounced_)
            mark_lit(b.echoes.echoes, b.echoes.beam_begin[j], b.echoes.beam_begin[j + 1], bins_,
                     lit_);
        return lit_;
    }

  private:
    void add(const Surface& surface, const Echoes& echoes, std::size_t begin, std::size_t end) {
        if (begin == end) return;
        shares_.add(static_cast<std::uint32_t>(surfaces_.size()), echoes, begin, end, bins_);
        surfaces_.push_back(surface);
    }

    void add_visible(std::span<const Sample> samples) {
        find_stretches(samples, objects_, stretches_);
        for (std::size_t a = 0, b = 0; a < stretches_.size(); a = b) {
            const Surface surface = stretches_[a].surface;
            gathered_.clear();
            for (; b < stretches_.size() && stretches_[b].surface == surface; ++b) {
                const auto part =
                    samples.subspan(stretches_[b].begin, stretches_[b].end - stretches_[b].begin);
                gathered_.insert(gathered_.end(), part.begin(), part.end());
            }
            const std::span<const Sample> all =
                b - a == 1
                    ? samples.subspan(stretches_[a].begin, stretches_[a].end - stretches_[a].begin)
                    : std::span<const Sample>(gathered_);
            direct_echoes(all, scene_.materials, bins_.bin_m, ScattererLattice{}, echoes_);
            add(surface, echoes_, 0, echoes_.size());
        }
    }

    /// Bins that no echo reaches are blank already.
    void write_ids(std::size_t at, std::vector<std::uint16_t>& out) const {
        for (int i = strongest_.first; i < strongest_.last; ++i)
            out[at + i] = id_16(strongest_.key[i]);
    }

    void write_shares(std::size_t at, PingLabels& out) const {
        for (int i = strongest_.first; i < strongest_.last; ++i) {
            const float total = shares_.total[i];
            const float whole = total > 0.0F ? total : 1.0F;
            out.share[at + i] = std::min(strongest_.echo[i] / whole, 1.0F);
            out.second[at + i] = id_16(strongest_.second_key[i]);
            out.second_share[at + i] = std::min(strongest_.second_echo[i] / whole, 1.0F);
            out.multipath[at + i] = std::clamp((total - direct_[i]) / whole, 0.0F, 1.0F);
        }
    }

    const TracedPing& traced_;
    const Scene& scene_;
    const SceneObjects& objects_;
    const LabelRequest& request_;
    RangeBins bins_;
    std::vector<BouncedSurface> bounced_;
    BeamShares shares_;
    std::vector<Surface> surfaces_;  ///< indexed by the keys of shares_
    std::vector<float> direct_;      ///< echo of the visible surface, by bin
    std::vector<Stretch> stretches_;
    std::vector<Sample> gathered_;
    Echoes echoes_;
    StrongestFinder finder_;
    Strongest strongest_;
    std::vector<std::uint8_t> lit_;
};

PingLabels blank_labels(const View& view, const LabelRequest& request) {
    PingLabels labels;
    labels.range_bins = view.range_bins;
    labels.beams = view.beams;
    const std::size_t n = labels.size();
    if (request.objects) labels.object.resize(n);
    if (request.shares) {
        labels.share.resize(n);
        labels.second.resize(n);
        labels.second_share.resize(n);
        labels.multipath.resize(n);
    }
    if (request.classes) labels.class_id.resize(n);
    if (request.materials) labels.material.resize(n);
    if (request.shadow) labels.shadow.resize(n);
    if (request.height) labels.height_m.resize(n);
    if (request.elevation) {
        labels.elevation_rad.resize(n);
        labels.elevation_spread_rad.resize(n);
    }
    return labels;
}

}  // namespace

PingLabels label_ping(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                      const SceneObjects& objects, const VisibilityEngine& engine,
                      const LabelRequest& request) {
    const View& view = settings.view;
    PingLabels labels = blank_labels(view, request);
    BeamLabeller labeller(traced, view, scene, objects, request);
    ShadowFinder shadows(traced, view, objects, engine, request.shadow);
    if (request.shadow) labels.visible_share = shadows.visible_shares();
    const bool shares = request.objects || request.classes || request.materials;
    ElevationFinder elevations(scene.materials, range_bins(view));
    HeightFinder heights(scene.materials, range_bins(view), request.bottom, traced.T_world_sensor);
    for (int j = 0; j < view.beams; ++j) {
        const auto own = [&](auto& all) {
            return std::span(all).subspan(static_cast<std::size_t>(j) * view.range_bins,
                                          view.range_bins);
        };
        if (shares) labeller.label(j, labels);
        if (request.shadow) shadows.find(j, labeller.occupied(j, shares), own(labels.shadow));
        if (request.elevation) {
            elevations.find(traced.samples.beam(j), own(labels.elevation_rad),
                            own(labels.elevation_spread_rad));
        }
        if (request.height) heights.find(traced.samples.beam(j), own(labels.height_m));
    }
    return labels;
}

}  // namespace sonarsim
