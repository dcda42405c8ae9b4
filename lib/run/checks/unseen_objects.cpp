#include "core/text.h"
#include "core/units.h"
#include "input/scene/copies.h"
#include "input/scene/seabed/seabed.h"
#include "output/dataset/writer.h"
#include "run/checks/find_warnings.h"
#include "simulate/assembly/poses.h"
#include "simulate/sonar/sonar.h"
#include "simulate/trace/arrivals.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_objects = 200;  // the most objects to look for
constexpr std::size_t max_poses = 20000;  // about the most poses to test for an object
constexpr std::size_t max_tries = 4;      // the most pings of a sonar to trace for an object
constexpr std::size_t max_named = 5;
// A smaller object, which no range bin resolves, is one in metres that was read as millimetres.
constexpr double min_object_m = 0.005;

/// An object and the sphere around it; the frame is the world, or its own if it moves.
struct Extent {
    Eigen::AlignedBox3d box;   ///< empty: it has no surface
    std::ptrdiff_t body = -1;  ///< index into Scene::bodies; -1: it stands still

    double radius() const { return 0.5 * box.diagonal().norm(); }
};

/// True for objects with a class or a name of the mission, but not for the rocks of a bed.
bool is_wanted(const Mission& mission, const Scene& scene, std::size_t instance) {
    const std::string& name = scene.instances[instance];
    const std::string class_name =
        instance < scene.instance_classes.size() ? scene.instance_classes[instance] : "";
    const bool is_object = std::ranges::any_of(
        mission.scene.objects, [&](const ObjectConfig& object) { return object.name == name; });
    const bool is_scattered = std::ranges::any_of(
        mission.scene.scatter,
        [&](const ScatterConfig& rule) { return name.starts_with(rule.name + "_"); });
    const bool has_rocks = mission.scene.seabed && mission.scene.seabed->rocks;
    if (has_rocks && class_name == rock_class && name.starts_with("rock_"))
        return is_object || is_scattered;
    return is_object || !class_name.empty();
}

/// One for each instance, wherever its triangles are kept; empty if it has none.
std::vector<Extent> extents_of(const Scene& scene) {
    std::vector<Extent> extents;
    for (const Eigen::AlignedBox3d& box : boxes_of_instances(scene))
        extents.push_back({box});
    for (std::ptrdiff_t k = 0; const Body& body : scene.bodies)
        extents[body.instance] = {box_of(body.vertices), k++};
    return extents;
}

/// The angle off the field of view, in a fan to the nearest azimuth and elevation; 0 within.
double angle_off_view(const View& view, const Eigen::Vector3d& point) {
    const double half = 0.5 * view.azimuth_rad;
    if (view.shape == ViewShape::cone)
        return std::max(0.0, std::atan2(point.tail<2>().norm(), point.x()) - half);
    const double azimuth = std::atan2(point.y(), point.x());
    const double elevation = std::atan2(point.z(), point.head<2>().norm());
    const double half_elevation = 0.5 * view.elevation_rad;
    const double a = std::clamp(azimuth, -half, half);
    const double e = std::clamp(elevation, -half_elevation, half_elevation);
    if (a == azimuth && e == elevation) return 0.0;
    const Eigen::Vector3d nearest = direction_of(a, e);
    return std::atan2(nearest.cross(point).norm(), nearest.dot(point));
}

/// A pose, and the angle from the field of view to the object's middle at this pose.
struct PoseInView {
    std::uint32_t pose = 0;
    double angle_off = 0.0;
};

/// The poses with a part of the sphere around an object in view and range, least angle off first.
std::vector<PoseInView> poses_in_view(const Mission& mission, const Assembly& assembly,
                                      const Sonar& sonar, const Extent& extent) {
    const View& view = sonar.settings.view;
    const auto every = static_cast<std::size_t>(sonar.config.every);
    const std::size_t pings = count_pings(sonar.config, assembly.trajectory.size());
    const std::size_t step = every * ((pings + max_poses - 1) / max_poses);
    const double radius = extent.radius();
    std::vector<PoseInView> poses;
    for (std::size_t i = 0; i < assembly.trajectory.size(); i += step) {
        const TimedPose& at = assembly.trajectory[i];
        const auto pose = static_cast<std::uint32_t>(i);
        const Pose T_world_sensor =
            sensor_pose(*SonarAtPose(mission, sonar, pose), at.T_world_vehicle, pose);
        Pose T_world_object;
        if (extent.body >= 0) T_world_object = body_poses(assembly, at.t_s)[extent.body];
        const Eigen::Vector3d world =
            T_world_object.rotation * extent.box.center() + T_world_object.translation;
        const Eigen::Vector3d visible =
            T_world_sensor.rotation.conjugate() * (world - T_world_sensor.translation);
        const double range = visible.norm();
        if (range + radius < view.range_min_m || range - radius >= view.range_max_m) continue;
        const double angle_off = angle_off_view(view, visible);
        const double half_width = range > radius ? std::asin(radius / range) : pi;
        if (angle_off <= half_width) poses.push_back({pose, angle_off});
    }
    std::ranges::stable_sort(poses, {}, &PoseInView::angle_off);
    return poses;
}

/// True if a sonar sees the instance in a few of `poses`, sorted by the angle off the view.
bool sees(const Mission& mission, const Assembly& assembly, const Sonar& sonar,
          const std::vector<PoseInView>& poses, std::uint32_t instance,
          const VisibilityEngine& rays) {
    const std::size_t straight =
        static_cast<std::size_t>(std::ranges::count(poses, 0.0, &PoseInView::angle_off));
    const std::size_t tries = std::min(poses.size(), max_tries);
    const std::size_t among = std::max(straight, tries);
    for (std::size_t k = 0; k < tries; ++k) {
        const std::uint32_t pose = poses[(2 * k + 1) * among / (2 * tries)].pose;
        const TimedPose& at = assembly.trajectory[pose];
        const TracedPing traced =
            trace(*SonarAtPose(mission, sonar, pose), assembly.scene,
                  *engine_at(rays, assembly.motions, at.t_s), at.T_world_vehicle, pose);
        const auto is_it = [&](const Sample& sample) {
            const double range = arrival_range(sample.position);
            return sample.instance == instance && range >= sonar.settings.view.range_min_m &&
                   range < sonar.settings.view.range_max_m;
        };
        const auto is_behind_wall = [&](const Sample& sample) {
            return sample.kind == SampleKind::behind_wall && is_it(sample);
        };
        if (std::ranges::any_of(traced.samples.in_beams(), is_it) ||
            std::ranges::any_of(traced.samples.in_no_beam(), is_behind_wall))
            return true;
    }
    return false;
}

/// "'a', 'b' and 3 more".
std::string names_text(const std::vector<std::string>& names) {
    std::string out;
    for (std::size_t i = 0; i < std::min(names.size(), max_named); ++i)
        out += (i > 0 ? ", '" : "'") + printable(names[i]) + "'";
    if (names.size() > max_named)
        out += " and " + std::to_string(names.size() - max_named) + " more";
    return out;
}

}  // namespace

std::vector<Warning> hidden_objects(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars,
                                    const VisibilityEngine& rays) {
    const Scene& scene = assembly.scene;
    const std::vector<Extent> extents = extents_of(scene);
    std::vector<std::string> never_in_view;
    std::vector<std::string> hidden;
    std::vector<std::string> tiny;
    std::size_t looked_for = 0;
    double resolved_m = min_object_m;
    for (const Sonar& sonar : assembly.sonars)
        resolved_m = std::min(resolved_m, sonar.settings.view.bin_m());
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        const auto is_visible_to = [&](const SonarSurvey& sonar) {
            return sonar.visible_m2[instance] > 0.0;
        };
        const Extent& extent = extents[instance];
        if (extent.box.isEmpty() || !is_wanted(mission, scene, instance)) continue;
        if (2.0 * extent.radius() < resolved_m) {
            tiny.push_back(scene.instances[instance]);
            continue;
        }
        if (std::ranges::any_of(sonars, is_visible_to)) continue;
        if (++looked_for > max_objects) continue;
        bool in_view = false;
        bool visible = false;
        for (std::size_t i = 0; i < assembly.sonars.size() && !visible; ++i) {
            const std::vector<PoseInView> poses =
                poses_in_view(mission, assembly, assembly.sonars[i], extent);
            in_view = in_view || !poses.empty();
            visible = sees(mission, assembly, assembly.sonars[i], poses, instance, rays);
        }
        if (!visible) (in_view ? hidden : never_in_view).push_back(scene.instances[instance]);
    }
    const std::string not_looked_for =
        looked_for > max_objects
            ? fmt::format(" ({} more were not tested)", looked_for - max_objects)
            : "";
    std::vector<Warning> out;
    const auto warn = [&](const std::vector<std::string>& names, const char* what,
                          const char* cure) {
        if (names.empty()) return;
        const std::string count =
            names.size() == 1 ? "1 object is" : std::to_string(names.size()) + " objects are";
        out.push_back(make_warning(WarningCode::hidden_object, "scene", count + what,
                                   names_text(names) + not_looked_for, cure));
    };
    warn(never_in_view, " not in view",
         "move these into the view of a sonar, or the trajectory towards them");
    warn(hidden, " in view but not seen",
         "these may lie behind, below or within other surface, or be smaller than a beam");
    warn(tiny, " not resolved",
         "these are smaller than 5 mm and a range bin; check their units and scale");
    return out;
}

}  // namespace sonarsim
