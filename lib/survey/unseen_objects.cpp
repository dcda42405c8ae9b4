#include "survey/unseen_objects.h"

#include <algorithm>
#include <memory>
#include <string>

#include "core/text.h"
#include "sonar/sonar.h"
#include "visibility/view.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_objects = 200;  // that are looked for
constexpr std::size_t most_poses = 2000;   // that may have one in view
constexpr std::size_t most_corners = 24;   // of an object that are looked at
constexpr std::size_t most_tries = 4;      // pings of a sonar for an object
constexpr std::size_t most_named = 5;

/// Some of an object's vertices; of a body in its own frame.
struct Corners {
    std::vector<Eigen::Vector3d> points;
    std::ptrdiff_t body = -1;  ///< index into Scene::bodies; -1: it stands still
};

bool is_wanted(const Mission& mission, const Scene& scene, std::size_t instance) {
    if (instance < scene.instance_classes.size() && !scene.instance_classes[instance].empty())
        return true;
    return std::ranges::any_of(mission.scene.objects, [&](const ObjectConfig& object) {
        return object.name == scene.instances[instance];
    });
}

/// Every n-th of the vertices of `triangles`, so that there are few.
template <class Wanted>
std::vector<Eigen::Vector3d> some_vertices(
    const std::vector<Eigen::Vector3f>& vertices,
    const std::vector<std::array<std::uint32_t, 3>>& triangles, const Eigen::Vector3d& origin,
    const Wanted& wanted) {
    std::vector<std::uint32_t> all;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (wanted(t)) all.push_back(triangles[t][0]);
    }
    std::vector<Eigen::Vector3d> some;
    const std::size_t step = std::max<std::size_t>(1, all.size() / most_corners);
    for (std::size_t i = 0; i < all.size(); i += step)
        some.emplace_back(origin + vertices[all[i]].cast<double>());
    return some;
}

Corners corners_of(const Scene& scene, std::uint32_t instance) {
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        const Body& body = scene.bodies[k];
        if (body.instance != instance) continue;
        return {some_vertices(body.vertices, body.triangles, Eigen::Vector3d::Zero(),
                              [](std::size_t) { return true; }),
                static_cast<std::ptrdiff_t>(k)};
    }
    return {some_vertices(scene.vertices, scene.triangles, scene.origin,
                          [&](std::size_t t) { return scene.triangle_instance[t] == instance; }),
            -1};
}

/// The poses at which one of the corners is in the view of a sonar and within its range.
std::vector<std::uint32_t> poses_in_view(const Assembly& assembly, const Sonar& sonar,
                                         const Corners& corners) {
    const View& view = sonar.settings.view;
    const auto every = static_cast<std::size_t>(sonar.config.every);
    const std::size_t pings = (assembly.trajectory.size() + every - 1) / every;
    const std::size_t step = every * std::max<std::size_t>(1, pings / most_poses);
    std::vector<std::uint32_t> poses;
    for (std::size_t i = 0; i < assembly.trajectory.size(); i += step) {
        const TimedPose& at = assembly.trajectory[i];
        const auto pose = static_cast<std::uint32_t>(i);
        const Pose T_world_sensor = sensor_pose(sonar, at.T_world_vehicle, pose);
        Pose T_world_corner;
        if (corners.body >= 0) T_world_corner = body_poses(assembly, at.t_s)[corners.body];
        const bool in_view = std::ranges::any_of(corners.points, [&](const Eigen::Vector3d& p) {
            const Eigen::Vector3d world = T_world_corner.rotation * p + T_world_corner.translation;
            const Eigen::Vector3d seen =
                T_world_sensor.rotation.conjugate() * (world - T_world_sensor.translation);
            const double range = seen.norm();
            return range >= view.range_min_m && range < view.range_max_m &&
                   beam_of(view, seen.cast<float>()) >= 0;
        });
        if (in_view) poses.push_back(pose);
    }
    return poses;
}

/// Whether a sonar sees the instance in one of a few of these poses.
bool sees(const Assembly& assembly, const Sonar& sonar, const std::vector<std::uint32_t>& poses,
          std::uint32_t instance, const VisibilityEngine& rays) {
    const std::size_t tries = std::min(poses.size(), most_tries);
    for (std::size_t k = 0; k < tries; ++k) {
        const std::uint32_t pose = poses[(2 * k + 1) * poses.size() / (2 * tries)];
        const TimedPose& at = assembly.trajectory[pose];
        const std::unique_ptr<VisibilityEngine> moment =
            assembly.motions.empty() ? nullptr : rays.at(body_poses(assembly, at.t_s));
        const TracedPing traced =
            trace(sonar, assembly.scene, moment ? *moment : rays, at.T_world_vehicle, pose);
        const auto is_it = [&](const Sample& sample) {
            const double range = sample.position.norm();
            return sample.instance == instance && range >= sonar.settings.view.range_min_m &&
                   range < sonar.settings.view.range_max_m;
        };
        if (std::ranges::any_of(traced.samples.items, is_it)) return true;
    }
    return false;
}

/// "no ping has them in view: a, b and 3 more".
struct Names {
    std::vector<std::string> names;

    std::string text() const {
        std::string out;
        for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i)
            out += (i > 0 ? ", '" : "'") + printable(names[i]) + "'";
        if (names.size() > most_named)
            out += " and " + std::to_string(names.size() - most_named) + " more";
        return out;
    }
};

std::string objects_text(std::size_t count) {
    return count == 1 ? "1 object is" : std::to_string(count) + " objects are";
}

}  // namespace

std::vector<Warning> unseen_objects(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars,
                                    const VisibilityEngine& rays) {
    const Scene& scene = assembly.scene;
    Names never_in_view;
    Names hidden;
    std::size_t looked_for = 0;
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        const auto has_seen = [&](const SonarSurvey& sonar) {
            return sonar.seen_m2[instance] > 0.0;
        };
        if (!is_wanted(mission, scene, instance) || std::ranges::any_of(sonars, has_seen)) continue;
        if (++looked_for > most_objects) break;
        const Corners corners = corners_of(scene, instance);
        bool in_view = false;
        bool seen = false;
        for (std::size_t i = 0; i < assembly.sonars.size() && !seen; ++i) {
            const std::vector<std::uint32_t> poses =
                poses_in_view(assembly, assembly.sonars[i], corners);
            in_view = in_view || !poses.empty();
            seen = sees(assembly, assembly.sonars[i], poses, instance, rays);
        }
        if (!seen) (in_view ? hidden : never_in_view).names.push_back(scene.instances[instance]);
    }
    std::vector<Warning> out;
    if (!never_in_view.names.empty()) {
        out.push_back(make_warning(Doubt::unseen_object, "scene",
                                   objects_text(never_in_view.names.size()) + " not in view",
                                   never_in_view.text()));
    }
    if (!hidden.names.empty()) {
        out.push_back(make_warning(Doubt::unseen_object, "scene",
                                   objects_text(hidden.names.size()) + " in view but not seen",
                                   hidden.text()));
    }
    return out;
}

}  // namespace sonarsim
