#include "simulate/labels/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "simulate/labels/coverage.h"
#include "simulate/labels/shadow.h"
#include "simulate/labels/top_two.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t no_object = 0xFFFFFFFFU;

/// Echoes are summed by object and material.
struct Surface {
    bool multipath;
    std::uint32_t object, material;
    std::uint32_t second;  ///< the object of the second surface of multipath, if it is needed

    auto operator<=>(const Surface&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

class SurfaceSums {
  public:
    SurfaceSums(const View& view, const SceneObjects& objects, bool by_second)
        : sums_(range_bins(view), view.beams), objects_(objects), by_second_(by_second) {}

    void add(const EchoBlock& echoes) {
        std::array<std::uint32_t, EchoBlock::capacity> sources;
        const Sample* last = nullptr;
        const bool has_second = by_second_ && echoes.multipath;
        std::uint32_t last_second = no_instance;
        for (int k = 0; k < echoes.count; ++k) {
            const Sample* const sample = echoes.sample[k];
            const std::uint32_t second = has_second ? echoes.second[k] : no_instance;
            if (k == 0 || sample != last || second != last_second) {
                last = sample;
                last_second = second;
                find_source({echoes.multipath, objects_.object_of(sample->instance),
                             sample->material,
                             second == no_instance ? no_object : objects_.object_of(second)});
            }
            sources[k] = source_;
        }
        sums_.add(echoes, sources);
    }

    const EchoSums& sums() const { return sums_; }
    const std::map<Surface, std::uint32_t>& sources() const { return source_of_; }

    /// The sources of background's direct echoes; of all direct echoes if there is none.
    std::vector<std::uint32_t> ground() const {
        std::vector<std::uint32_t> ground, all;
        for (const auto& [surface, source] : source_of_) {
            if (surface.multipath) continue;
            all.push_back(source);
            if (objects_.is_background(surface.object)) ground.push_back(source);
        }
        return ground.empty() ? all : ground;
    }

    /// `key_of(surface)`: what its echoes count for.
    template <class KeyOf>
    TopTwoFinder finder_by(KeyOf key_of) const {
        std::vector<KeyedSource> sources;
        for (const auto& [surface, source] : source_of_)
            sources.push_back({key_of(surface), source});
        return TopTwoFinder(std::move(sources));
    }

    /// A finder of the objects that are no background, by their direct echoes or all of their own.
    TopTwoFinder finder_of_own(bool direct_alone) const {
        std::vector<KeyedSource> sources;
        const auto add = [&](std::uint32_t object, std::uint32_t source) {
            if (!objects_.is_background(object)) sources.push_back({object, source});
        };
        for (const auto& [surface, source] : source_of_) {
            if (surface.multipath && direct_alone) continue;
            add(surface.object, source);
            if (surface.second != no_object && surface.second != surface.object)
                add(surface.second, source);
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
    bool by_second_;
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
                    std::span<const Material> materials, const LabelRequest& request,
                    PingLabels& out) {
    TopTwoFinder by_object = surfaces.finder_by([](const Surface& of) { return of.object; });
    TopTwoFinder by_class =
        surfaces.finder_by([&](const Surface& of) { return objects.class_of(of.object); });
    TopTwoFinder by_material = surfaces.finder_by([&](const Surface& of) {
        if (of.material >= materials.size()) return of.material;  // the water's surface
        const std::string& prevails = materials[of.material].prevails;
        const auto found = std::ranges::find(materials, prevails, &Material::name);
        return found == materials.end() ? of.material
                                        : static_cast<std::uint32_t>(found - materials.begin());
    });
    TopTwoFinder visible = surfaces.finder_of_own(true);
    TopTwoFinder own_echoes = surfaces.finder_of_own(false);
    for (int j = 0; j < out.beams; ++j) {
        if (request.objects) {
            by_object.find(surfaces.sums(), j,
                           {own(out.object, out, j), own(out.second, out, j),
                            own(out.share, out, j), own(out.second_share, out, j)});
        }
        if (request.outlines) {
            visible.find(surfaces.sums(), j,
                         {own(out.visible_object, out, j), {}, own(out.visible_echo, out, j)});
            own_echoes.find(surfaces.sums(), j,
                            {own(out.own_object, out, j), {}, own(out.own_echo, out, j)});
            for (std::uint32_t source = 0; source < surfaces.sums().sources(); ++source)
                surfaces.sums().add_to(source, j, own(out.whole_echo, out, j));
        }
        if (request.classes) by_class.find(surfaces.sums(), j, {own(out.class_id, out, j), {}});
        if (request.materials)
            by_material.find(surfaces.sums(), j, {own(out.material, out, j), {}});
    }
    if (request.shares) find_shares(surfaces, out);
}

/// Weakens echoes as the receiver does towards the edges of a fan.
void weaken(std::span<const float> beam_gain, PingLabels& labels) {
    if (beam_gain.empty()) return;
    for (std::vector<float>* const echoes :
         {&labels.visible_echo, &labels.own_echo, &labels.whole_echo}) {
        auto echo = echoes->begin();
        for (std::size_t j = 0; j < beam_gain.size() && echo != echoes->end(); ++j) {
            const auto end = echo + labels.range_bins;
            std::transform(echo, end, echo, [&](float power) { return power * beam_gain[j]; });
            echo = end;
        }
    }
}

/// Finds the shadows of all objects and those of objects that are no background, as far as a
/// request needs them, from one trace of the hidden surface. `sums`: the echoes of the ping.
void label_shadows(const TracedPing& traced, const SurfaceEchoes& echoes, const View& view,
                   const Scene& scene, const SceneObjects& objects, const VisibilityEngine& engine,
                   const LabelRequest& request, const SurfaceSums& surfaces, PingLabels& labels) {
    if (!request.shadow && !request.annotations) return;
    const RangeBins bins = range_bins(view);
    const bool is_bent = scene.sound_profile || !traced.motion.is_still();
    const ObjectDirections directions =
        is_bent ? ObjectDirections()
                : ObjectDirections(request.annotated, request.surface, traced.T_world_sensor,
                                   view.range_min_m, view.range_max_m);
    HiddenSurface hidden = find_hidden_surface(
        traced, echoes, {view, scene, engine, traced.T_world_sensor}, objects, directions,
        request.shadow ? HiddenSurface::By::all : HiddenSurface::By::objects);
    std::vector<HiddenPiece> by_objects;
    if (request.annotations) by_objects = hidden.pieces;
    std::erase_if(by_objects, [&](const HiddenPiece& piece) {
        return piece.behind_background || objects.is_background(piece.object);
    });
    drop_far_sides(by_objects, view.beams);
    const bool is_wide = view.energies_add && !echoes.cones.exist();
    const std::vector<std::uint32_t> ground = surfaces.ground();
    const auto find = [&](const std::vector<HiddenPiece>& by, bool by_triangles,
                          std::vector<std::uint16_t>& shadow) {
        std::vector<std::uint8_t> hidden_by = hidden_bins(by, bins, view.beams);
        std::vector<std::uint8_t> covered = hidden_by;
        if (by_triangles)
            covered = covered_bins(request.triangles ? *request.triangles : SceneClusters(scene),
                                   view, traced.T_world_sensor, engine.body_poses());
        ShadowFinder finder(by, view);
        for (int j = 0; j < view.beams; ++j) {
            finder.find(
                j, own(covered, labels, j),
                is_wide ? bins_above_shadow(surfaces.sums(), j, ground, own(hidden_by, labels, j))
                        : surfaces.sums().occupied(j),
                own(shadow, labels, j));
        }
    };
    if (request.shadow)
        find(hidden.pieces, !echoes.cones.exist() && !scene.sound_profile, labels.shadow);
    if (request.annotations) find(by_objects, false, labels.object_shadow);
    for (std::uint32_t k = 0; !request.shadow && k < hidden.visible_shares.size(); ++k) {
        if (objects.is_background(k))
            hidden.visible_shares[k] = std::numeric_limits<float>::quiet_NaN();
    }
    labels.visible_share = std::move(hidden.visible_shares);
}

PingLabels label_group(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                       const SceneObjects& objects, const VisibilityEngine& engine,
                       const LabelRequest& request) {
    const View& view = settings.view;
    PingLabels labels;
    labels.range_bins = view.range_bins;
    labels.beams = view.beams;
    for_each_label(request, [&](auto member, bool wanted, auto blank) {
        if (wanted) (labels.*member).assign(labels.size(), blank);
    });
    SurfaceSums surfaces(view, objects, request.outlines);
    const SurfaceEchoes echoes =
        settings.model->surface_echoes(traced, view, scene,
                                       {.patches = request.elevation || request.height,
                                        .objects = request.only_objects ? &objects : nullptr},
                                       [&](const EchoBlock& block) { surfaces.add(block); });
    label_surfaces(surfaces, objects, scene.materials, request, labels);
    weaken(settings.model->info.beam_gain, labels);
    label_shadows(traced, echoes, view, scene, objects, engine, request, surfaces, labels);
    if (request.elevation || request.height) {
        const TruePlaces places{traced.T_world_sensor, scene.sound_profile.get(), traced.motion,
                                view.shape};
        label_patches(echoes, view, places, request.bottom, scene.is_bottom, labels);
    }
    return labels;
}

void copy_beam(const PingLabels& from, int beam, const LabelRequest& request, PingLabels& to) {
    for_each_label(request, [&](auto member, bool wanted, auto) {
        if (!wanted) return;
        const auto first = static_cast<std::ptrdiff_t>(beam) * from.range_bins;
        std::copy_n((from.*member).begin() + first, from.range_bins, (to.*member).begin() + first);
    });
}

}  // namespace

PingLabels label_ping(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                      const SceneObjects& objects, const VisibilityEngine& engine,
                      const LabelRequest& request) {
    const auto label = [&](const TracedPing& group, int /*number*/) {
        return label_group(group, settings, scene, objects, engine, request);
    };
    const auto take_beam = [&](const PingLabels& from, int beam, PingLabels& to) {
        copy_beam(from, beam, request, to);
    };
    // The first group that sees an object counts.
    const auto take_shares = [](const PingLabels& from, PingLabels& to) {
        for (std::size_t k = 0; k < to.visible_share.size(); ++k) {
            if (std::isnan(to.visible_share[k])) to.visible_share[k] = from.visible_share[k];
        }
    };
    return by_groups(traced, label, take_beam, take_shares);
}

}  // namespace sonarsim
