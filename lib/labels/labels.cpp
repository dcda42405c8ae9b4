#include "labels/labels.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "labels/patch_labels.h"
#include "labels/ping_shadows.h"
#include "labels/shares.h"
#include "visibility/coverage.h"

namespace sonarsim {

namespace {

/// The echoes of a beam are separated by object and material.
struct Surface {
    std::uint32_t object, material;

    auto operator<=>(const Surface&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// Successive echoes of one surface.
struct Stretch {
    Surface surface;
    std::uint32_t begin, end;

    auto operator<=>(const Stretch&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// The echoes of a beam surface by surface. Engines return neighbours in space in sequence, so
/// stretches are few and long.
void find_stretches(const BeamEchoes& echoes, int beam, const SceneObjects& objects,
                    std::vector<Stretch>& stretches) {
    stretches.clear();
    const Sample* last = nullptr;
    for (std::uint32_t k = echoes.beam_begin[beam]; k < echoes.beam_begin[beam + 1]; ++k) {
        const Sample* const sample = echoes.sample[k];
        if (sample != last) {
            last = sample;
            const Surface surface{objects.object_of(sample->instance), sample->material};
            if (stretches.empty() || stretches.back().surface != surface)
                stretches.push_back({surface, k, k});
        }
        stretches.back().end = k + 1;
    }
    std::ranges::sort(stretches);
}

std::uint16_t id_16(std::uint32_t id) {
    return static_cast<std::uint16_t>(id);
}

/// Labels one beam after the other. Holds buffers, so that beams after the first allocate nothing.
class BeamLabeller {
  public:
    BeamLabeller(const SurfaceEchoes& echoes, const View& view, const SceneObjects& objects,
                 const LabelRequest& request)
        : echoes_(echoes), objects_(objects), request_(request), bins_(range_bins(view)) {}

    /// The shares of beam j, into `out`.
    void label(int j, PingLabels& out) {
        shares_.clear(bins_.count);
        surfaces_.clear();
        add(echoes_.direct, j);
        direct_ = shares_.total;
        add(echoes_.multipath, j);
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
    /// this beam. Without label() this takes half of its time.
    std::span<const std::uint8_t> occupied(int j, bool labelled) {
        occupied_.assign(bins_.count + 1, 0);
        if (labelled) {
            for (int i = shares_.first; i < shares_.last; ++i)
                occupied_[i] = shares_.weight[i] > 0.0F ? 1 : 0;
            return occupied_;
        }
        for (const BeamEchoes* const of : {&echoes_.direct, &echoes_.multipath})
            mark_occupied(of->boxes, of->beam_begin[j], of->beam_begin[j + 1], bins_, occupied_);
        return occupied_;
    }

  private:
    /// Adds the echoes of beam j.
    void add(const BeamEchoes& echoes, int j) {
        find_stretches(echoes, j, objects_, stretches_);
        for (std::size_t a = 0, b = 0; a < stretches_.size(); a = b) {
            const Surface surface = stretches_[a].surface;
            ranges_.clear();
            for (; b < stretches_.size() && stretches_[b].surface == surface; ++b)
                ranges_.push_back({stretches_[b].begin, stretches_[b].end});
            shares_.add(static_cast<std::uint32_t>(surfaces_.size()), echoes.boxes, ranges_, bins_);
            surfaces_.push_back(surface);
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

    const SurfaceEchoes& echoes_;
    const SceneObjects& objects_;
    const LabelRequest& request_;
    RangeBins bins_;
    BeamShares shares_;
    std::vector<Surface> surfaces_;  ///< indexed by the keys of shares_
    std::vector<float> direct_;      ///< echo of the visible surface, by bin
    std::vector<Stretch> stretches_;
    std::vector<EchoRange> ranges_;  ///< the stretches of one surface
    TopTwoFinder finder_;
    TopTwo strongest_;
    std::vector<std::uint8_t> occupied_;
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
    if (request.annotations) labels.object_shadow.resize(n);
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    if (request.height) labels.height_m.resize(n, none);
    if (request.elevation) {
        labels.elevation_rad.resize(n, none);
        labels.elevation_spread_rad.resize(n, none);
    }
    return labels;
}

/// The shadows that a request needs; empty without any.
std::optional<PingShadows> find_shadows(const TracedPing& traced, const SurfaceEchoes& echoes,
                                        const View& view, const Scene& scene,
                                        const SceneObjects& objects, const VisibilityEngine& engine,
                                        const LabelRequest& request) {
    if (!request.shadow && !request.annotations) return std::nullopt;
    const bool is_bent = scene.sound_profile || !traced.motion.is_still();
    const ObjectDirections directions =
        is_bent ? ObjectDirections()
                : ObjectDirections(request.annotated, request.surface, traced.T_world_sensor,
                                   view.range_min_m, view.range_max_m);
    const PingShadows::Wanted wanted{.of_all = request.shadow, .of_objects = request.annotations};
    std::vector<std::uint8_t> covered;
    if (request.shadow && !echoes.cones.exist() && !scene.sound_profile) {
        covered = covered_bins(request.triangles ? *request.triangles : TriangleRuns(scene), view,
                               traced.T_world_sensor, engine.body_poses());
    }
    return std::optional<PingShadows>(std::in_place, wanted, traced, echoes, view, objects, engine,
                                      directions, std::move(covered));
}

PingLabels label_group(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                       const SceneObjects& objects, const VisibilityEngine& engine,
                       const LabelRequest& request) {
    const View& view = settings.view;
    PingLabels labels = blank_labels(view, request);
    const SurfaceEchoes echoes =
        settings.model->surface_echoes(traced, view, scene, request.elevation || request.height);
    BeamLabeller labeller(echoes, view, objects, request);
    std::optional<PingShadows> shadows =
        find_shadows(traced, echoes, view, scene, objects, engine, request);
    if (shadows) labels.visible_share = shadows->visible_shares();
    const bool shares = request.objects || request.classes || request.materials;
    for (int j = 0; j < view.beams; ++j) {
        const auto own = [&](auto& all) {
            return std::span(all).subspan(static_cast<std::size_t>(j) * view.range_bins,
                                          view.range_bins);
        };
        if (shares) labeller.label(j, labels);
        if (!shadows) continue;
        const std::span<const std::uint8_t> occupied = labeller.occupied(j, shares);
        if (request.shadow) shadows->find_of_all(j, occupied, own(labels.shadow));
        if (request.annotations) shadows->find_of_objects(j, occupied, own(labels.object_shadow));
    }
    if (request.elevation || request.height) {
        const TruePlaces places{traced.T_world_sensor, scene.sound_profile.get(), traced.motion,
                                view.shape};
        label_patches(echoes, view, places, request.bottom, scene.is_bottom,
                      {labels.elevation_rad, labels.elevation_spread_rad, labels.height_m});
    }
    return labels;
}

/// Takes the labels of a beam.
void copy_beam(const PingLabels& from, int beam, PingLabels& to) {
    const auto copy = [&](auto member) {
        const std::size_t first = static_cast<std::size_t>(beam) * from.range_bins;
        if ((from.*member).empty()) return;
        std::copy_n((from.*member).begin() + static_cast<std::ptrdiff_t>(first), from.range_bins,
                    (to.*member).begin() + static_cast<std::ptrdiff_t>(first));
    };
    for (const auto member :
         {&PingLabels::object, &PingLabels::second, &PingLabels::class_id, &PingLabels::material,
          &PingLabels::shadow, &PingLabels::object_shadow})
        copy(member);
    for (const auto member :
         {&PingLabels::share, &PingLabels::second_share, &PingLabels::multipath,
          &PingLabels::elevation_rad, &PingLabels::elevation_spread_rad, &PingLabels::height_m})
        copy(member);
}

}  // namespace

PingLabels label_ping(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                      const SceneObjects& objects, const VisibilityEngine& engine,
                      const LabelRequest& request) {
    PingLabels labels = label_group(traced, settings, scene, objects, engine, request);
    for (std::size_t k = 0; k < traced.later_groups.size(); ++k) {
        const PingLabels later =
            label_group(traced.later_groups[k], settings, scene, objects, engine, request);
        for (int beam = 0; beam < labels.beams; ++beam) {
            if (traced.group_of_beam[beam] == static_cast<int>(k) + 1)
                copy_beam(later, beam, labels);
        }
    }
    return labels;
}

}  // namespace sonarsim
