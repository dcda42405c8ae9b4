#include "simulate/labels/labels.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "simulate/labels/patch_labels.h"
#include "simulate/labels/ping_shadows.h"
#include "simulate/labels/top_two.h"
#include "simulate/visibility/coverage.h"

namespace sonarsim {

namespace {

/// Echoes are summed by object and material.
struct Surface {
    bool multipath;
    std::uint32_t object, material;

    auto operator<=>(const Surface&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// The sums of a ping's echoes by surface.
class SurfaceSums {
  public:
    SurfaceSums(const View& view, const SceneObjects& objects)
        : sums_(range_bins(view), view.beams), objects_(objects) {}

    void add(const EchoBlock& echoes) {
        std::array<std::uint32_t, EchoBlock::most> sources;
        const Sample* last = nullptr;
        for (int k = 0; k < echoes.count; ++k) {
            const Sample* const sample = echoes.sample[k];
            if (sample != last) {
                last = sample;
                find_source(
                    {echoes.multipath, objects_.object_of(sample->instance), sample->material});
            }
            sources[k] = source_;
        }
        sums_.add(echoes, sources);
    }

    const EchoSums& sums() const { return sums_; }
    const std::map<Surface, std::uint32_t>& sources() const { return source_of_; }

    /// `key_of(surface)`: what its echoes count for.
    template <class KeyOf>
    TopTwoFinder finder_by(KeyOf key_of) const {
        std::vector<KeyedSource> sources;
        for (const auto& [surface, source] : source_of_)
            sources.push_back({key_of(surface), source});
        return TopTwoFinder(std::move(sources));
    }

    /// A finder of the objects that are no background, by their direct echoes.
    TopTwoFinder finder_of_direct() const {
        std::vector<KeyedSource> sources;
        for (const auto& [surface, source] : source_of_) {
            if (!surface.multipath && !objects_.is_background(surface.object))
                sources.push_back({surface.object, source});
        }
        return TopTwoFinder(std::move(sources));
    }

  private:
    void find_source(const Surface& surface) {
        if (!source_of_.empty() && surface == surface_) return;
        surface_ = surface;
        const auto next = static_cast<std::uint32_t>(source_of_.size());
        source_ = source_of_.try_emplace(surface, next).first->second;
    }

    EchoSums sums_;
    const SceneObjects& objects_;
    std::map<Surface, std::uint32_t> source_of_;
    Surface surface_{};  ///< the last one, and its source
    std::uint32_t source_ = 0;
};

/// The bins of beam j; empty if `all` is.
template <class T>
std::span<T> own(std::vector<T>& all, const PingLabels& labels, int j) {
    if (all.empty()) return {};
    return std::span(all).subspan(static_cast<std::size_t>(j) * labels.range_bins,
                                  labels.range_bins);
}

/// Turns the echoes of objects into shares, and finds the share of multipath.
void find_shares(const SurfaceSums& surfaces, PingLabels& labels) {
    const auto bins = static_cast<std::size_t>(labels.range_bins);
    std::vector<float> direct(bins), total(bins);
    for (int j = 0; j < labels.beams; ++j) {
        const std::span<float> multipath = own(labels.multipath, labels, j);
        std::ranges::fill(direct, 0.0F);
        for (const auto& [surface, source] : surfaces.sources()) {
            if (!surface.multipath) surfaces.sums().add_to(source, j, direct);
        }
        total = direct;
        for (const auto& [surface, source] : surfaces.sources()) {
            if (surface.multipath) surfaces.sums().add_to(source, j, total);
        }
        const std::span<float> share = own(labels.share, labels, j);
        const std::span<float> second_share = own(labels.second_share, labels, j);
        for (std::size_t i = 0; i < bins; ++i) {
            const float whole = total[i] > 0.0F ? total[i] : 1.0F;
            share[i] = std::min(share[i] / whole, 1.0F);
            second_share[i] = std::min(second_share[i] / whole, 1.0F);
            multipath[i] = std::clamp((total[i] - direct[i]) / whole, 0.0F, 1.0F);
        }
    }
}

/// Finds the surfaces that give most of the echo of each bin.
void label_surfaces(const SurfaceSums& surfaces, const SceneObjects& objects,
                    const LabelRequest& request, PingLabels& out) {
    TopTwoFinder by_object = surfaces.finder_by([](const Surface& of) { return of.object; });
    TopTwoFinder by_class =
        surfaces.finder_by([&](const Surface& of) { return objects.class_of(of.object); });
    TopTwoFinder by_material = surfaces.finder_by([](const Surface& of) { return of.material; });
    TopTwoFinder direct = surfaces.finder_of_direct();
    for (int j = 0; j < out.beams; ++j) {
        if (request.objects) {
            by_object.find(surfaces.sums(), j,
                           {own(out.object, out, j), own(out.second, out, j),
                            own(out.share, out, j), own(out.second_share, out, j)});
        }
        if (request.direct_echoes) {
            direct.find(surfaces.sums(), j,
                        {own(out.direct_object, out, j), {}, own(out.direct_echo, out, j)});
            for (std::uint32_t source = 0; source < surfaces.sums().sources(); ++source)
                surfaces.sums().add_to(source, j, own(out.whole_echo, out, j));
        }
        if (request.classes) by_class.find(surfaces.sums(), j, {own(out.class_id, out, j), {}});
        if (request.materials)
            by_material.find(surfaces.sums(), j, {own(out.material, out, j), {}});
    }
    if (request.shares) find_shares(surfaces, out);
}

PingLabels blank_labels(const View& view, const LabelRequest& request) {
    PingLabels labels;
    labels.range_bins = view.range_bins;
    labels.beams = view.beams;
    const std::size_t n = labels.size();
    if (request.objects) labels.object.resize(n);
    if (request.direct_echoes) {
        labels.direct_object.resize(n);
        labels.direct_echo.resize(n);
        labels.whole_echo.resize(n);
    }
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
    SurfaceSums surfaces(view, objects);
    const SurfaceEchoes echoes =
        settings.model->surface_echoes(traced, view, scene,
                                       {.patches = request.elevation || request.height,
                                        .objects = request.only_objects ? &objects : nullptr},
                                       [&](const EchoBlock& block) { surfaces.add(block); });
    label_surfaces(surfaces, objects, request, labels);
    std::optional<PingShadows> shadows =
        find_shadows(traced, echoes, view, scene, objects, engine, request);
    if (shadows) labels.visible_share = shadows->visible_shares();
    for (int j = 0; shadows && j < view.beams; ++j) {
        const std::span<const std::uint8_t> occupied = surfaces.sums().occupied(j);
        if (request.shadow) shadows->find_of_all(j, occupied, own(labels.shadow, labels, j));
        if (request.annotations)
            shadows->find_of_objects(j, occupied, own(labels.object_shadow, labels, j));
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
    for (const auto member : {&PingLabels::object, &PingLabels::direct_object, &PingLabels::second,
                              &PingLabels::class_id, &PingLabels::material, &PingLabels::shadow,
                              &PingLabels::object_shadow})
        copy(member);
    for (const auto member :
         {&PingLabels::direct_echo, &PingLabels::whole_echo, &PingLabels::share,
          &PingLabels::second_share, &PingLabels::multipath, &PingLabels::elevation_rad,
          &PingLabels::elevation_spread_rad, &PingLabels::height_m})
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
