#include "visibility/make_engine.h"

#include <cmath>

#include "core/text.h"
#include "core/units.h"
#include "visibility/octree/leaf_size.h"
#include "visibility/octree/tree.h"
#include "visibility/rays/rays_engine.h"

namespace sonarsim {

namespace {

/// Rows of the octree's depth buffer have equal steps of the tangent of elevation, which is
/// infinite at 90 degrees.
constexpr double widest_octree_deg = 160.0;

/// The error of the slices in cones, for the calibrated model.
constexpr double least_error_in_cones = 0.01;

}  // namespace

std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings) {
    if (settings.type == EngineKind::octree) return make_octree_engine(scene, settings.octree);
    const Caster caster = settings.caster ? *settings.caster : Caster(scene);
    if (settings.type == EngineKind::slices)
        return make_slices_engine(scene, caster, settings.slices);
    if (settings.type == EngineKind::automatic && !scene.sound_profile) {
        return make_auto_engine(scene, caster, settings.slices, settings.probes);
    }
    return make_rays_engine(scene, caster);
}

std::string unsupported(const EngineSettings& settings, const Scene& scene) {
    const bool is_octree = settings.type == EngineKind::octree;
    if (scene.sound_profile && (is_octree || settings.type == EngineKind::slices)) {
        return std::string(is_octree ? "engine: octree" : "engine: slices") +
               " needs straight paths of sound, and water.profile bends them; use engine: auto or "
               "engine: rays";
    }
    if (!scene.bodies.empty() && (is_octree || settings.type == EngineKind::slices)) {
        return std::string(is_octree ? "engine: octree" : "engine: slices") +
               " does not support moving objects; use engine: auto or engine: rays";
    }
    if (!scene.copies.empty() && (is_octree || settings.type == EngineKind::slices)) {
        return std::string(is_octree ? "engine: octree" : "engine: slices") +
               " does not support copies of shared meshes; use engine: auto or engine: rays, or "
               "scene.repeats: copied";
    }
    if (settings.type != EngineKind::octree) return "";
    const double length_m = (scene.bounds_max - scene.bounds_min).maxCoeff();
    const double longest_m = longest_octree_scene_m(settings.octree);
    if (length_m <= longest_m) return "";
    const double leaf_m = settings.octree.leaf_m;
    return (leaf_m > 0.0 ? "octree.leaf_m of " + number_text(leaf_m)
                         : std::string("engine: octree")) +
           " takes scenes up to " + number_text(std::floor(longest_m)) + " m long, not " +
           number_text(std::ceil(length_m)) + "; use engine: rays" +
           (leaf_m > 0.0 ? " or larger leaves" : "");
}

std::string unsupported(const EngineSettings& settings, const View& view) {
    if (settings.type != EngineKind::octree) return "";
    const double width_deg = std::round(1e9 * degrees(view.elevation_rad)) / 1e9;
    if (width_deg <= widest_octree_deg) return "";
    return std::string("engine: octree takes ") +
           (view.shape == ViewShape::cone ? "opening_deg" : "elevation_deg") + " up to " +
           number_text(widest_octree_deg) + ", not " + number_text(width_deg) +
           "; use engine: rays";
}

std::string accuracy_warning(const EngineSettings& settings, const View& view, bool multipath,
                             bool energies_add) {
    // With a box under a water surface, rays found 669 echoes over both, slices none.
    if (settings.type == EngineKind::slices && multipath) {
        return "engine: slices misses most multipath: reflections start at the middle of each "
               "patch "
               "of surface, and a patch of the slices may span the whole elevation of a beam; use "
               "engine: auto or engine: rays";
    }
    if (settings.type == EngineKind::slices && energies_add &&
        view.shape == ViewShape::port_starboard) {
        return "engine: slices is off by up to 18 % in the narrow beam of a side-scan with the "
               "calibrated model; use engine: auto or engine: rays";
    }
    if (settings.type == EngineKind::slices && energies_add && view.shape == ViewShape::cone &&
        view.relative_l1 < least_error_in_cones) {
        return "engine: slices is off by up to 1 % in a cone with the calibrated model, more than "
               "accuracy.relative_l1; use engine: auto or engine: rays";
    }
    if (settings.type != EngineKind::octree || settings.octree.literal) return "";
    const double error = estimated_octree_error(view, settings.octree.leaf_m);
    if (error <= view.relative_l1) return "";
    const auto percent = [](double x) { return number_text(std::ceil(1e3 * x) / 10.0) + " %"; };
    return "engine: octree will be off by about " + percent(error) +
           " in this view, more than accuracy.relative_l1 (" + percent(view.relative_l1) +
           "); use engine: rays" +
           (settings.octree.leaf_m > 0.0 ? " or a smaller octree.leaf_m" : "");
}

}  // namespace sonarsim
