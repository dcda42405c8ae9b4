#include "run/checks/survey.h"

#include "core/units.h"
#include "input/scene/copies.h"
#include "input/scene/mesh_topology.h"
#include "simulate/assembly/poses.h"
#include "simulate/sonar/sonar.h"
#include "simulate/trace/arrivals.h"
#include "simulate/trace/sample_kinds.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_pings = 36;       // per sonar
constexpr std::size_t max_bins = 1U << 25;  // per sonar, all pings together
constexpr std::size_t max_slow = 9;         // per sonar with a slow echo model
constexpr std::size_t images_of_slow = 3;   // one in so many of these pings becomes an image
constexpr double coarse_l1 = 0.2;

/// The surface in one direction from a sonar.
struct Look {
    Eigen::Vector3f direction;
    Intersection met;

    bool meets() const { return std::isfinite(met.distance_m); }
};
using Surroundings = std::vector<Look>;

Surroundings look(const View& view, const VisibilityEngine& engine, const Pose& T_world_sensor) {
    std::vector<Ray> rays;
    for (const Eigen::Vector3f& direction : look_around(view))
        rays.push_back({Eigen::Vector3f::Zero(), direction});
    std::vector<Intersection> met(rays.size());
    engine.intersect(T_world_sensor, rays, met);
    Surroundings around;
    for (std::size_t i = 0; i < rays.size(); ++i)
        around.push_back({rays[i].direction, met[i]});
    return around;
}

/// Finds out why a ping saw nothing.
void explain(const View& view, const Surroundings& around, double to_scene_m,
             NoReturnReasons& why) {
    ValueRange in_view;
    bool somewhere = false;
    double flattest = std::numeric_limits<double>::infinity();  // off the view's middle, in degrees
    for (const Look& look : around) {
        if (!look.meets()) continue;
        const double distance = look.met.distance_m;
        const bool within = distance >= view.range_min_m && distance < view.range_max_m;
        somewhere = somewhere || within;
        if (beam_of(view, look.direction) >= 0) {
            in_view.take(distance);
        } else if (within && is_in_azimuth(view, look.direction)) {
            const double z = std::clamp<double>(look.direction.z(), -1.0, 1.0);
            const double x = std::clamp<double>(look.direction.x(), -1.0, 1.0);
            const double off = degrees(view.shape == ViewShape::cone ? std::acos(x) : std::asin(z));
            if (std::fabs(off) < std::fabs(flattest)) flattest = off;
        }
    }
    if (!in_view.empty() && in_view.low >= view.range_max_m) {
        ++why.too_far;
        why.in_view_m.take(in_view.low);
    } else if (!in_view.empty() && in_view.high < view.range_min_m) {
        ++why.too_near;
        why.ends_m.take(in_view.high);
    } else if (std::isfinite(flattest)) {
        ++why.elevation_too_narrow;
        why.elevation_deg.take(flattest);
    } else if (somewhere) {
        ++why.elsewhere;
    } else {
        ++why.nothing;
        if (std::isfinite(to_scene_m)) why.nearest_m.take(to_scene_m);
    }
}

/// The distance from a point to the box around the scene; infinite when there is no scene.
double distance_to(const Scene& scene, const Eigen::Vector3d& point) {
    if (scene.instances.empty()) return std::numeric_limits<double>::infinity();
    return Eigen::AlignedBox3d(scene.bounds_min, scene.bounds_max).exteriorDistance(point);
}

/// True if a height is out of range above the scene, but its negative, a depth, is not.
bool looks_like_depth(const Scene& scene, double z_m, double reach_m) {
    const double highest_m = scene.bounds_max.z() + reach_m;
    return z_m > highest_m && -z_m > scene.bounds_min.z() && -z_m < highest_m;
}

/// True for a box around the whole scene, such as that of a basin or of a lone hull.
bool holds_all(const Eigen::AlignedBox3d& box, const Scene& scene) {
    const Eigen::Vector3d extent = scene.bounds_max - scene.bounds_min;
    return !box.isEmpty() && (box.sizes().array() >= 0.9 * extent.array()).all();
}

/// True if the surface faces upwards, as a sea floor: both sides of a closed body cancel.
bool faces_up(const Scene& scene) {
    double up = 0.0;
    double either = 0.0;
    for (const std::array<std::uint32_t, 3>& corners : scene.triangles) {
        const double area = cross_of(scene.vertices, corners).z();
        up += area;
        either += std::fabs(area);
    }
    return up > 0.1 * either;
}

/// True if an instance surrounds a point with faces that look away from it, as a hull does: the
/// solid angle of its triangles sums to the whole sphere, of which it needs a share, and to 0 or
/// less in a basin. Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30 (1983), eq. 8.
bool is_inside_solid(const Scene& scene, std::size_t instance, const Eigen::Vector3d& point,
                     double share) {
    const Eigen::Vector3d at = point - scene.origin;
    double solid_angle = 0.0;
    for (std::size_t k = 0; k < scene.triangles.size(); ++k) {
        if (scene.triangle_instance[k] != instance) continue;
        const auto& corners = scene.triangles[k];
        const Eigen::Vector3d a = scene.vertices[corners[0]].cast<double>() - at;
        const Eigen::Vector3d b = scene.vertices[corners[1]].cast<double>() - at;
        const Eigen::Vector3d c = scene.vertices[corners[2]].cast<double>() - at;
        solid_angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                                        a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                            b.dot(c) * a.norm() + c.dot(a) * b.norm());
    }
    return solid_angle > 4.0 * pi * share;
}

/// Counts the pose if no vehicle can be there. docs/warnings.md gives the reasons for the limits.
void check_position(const Scene& scene, bool open_upwards,
                    std::span<const Eigen::AlignedBox3d> boxes, const Pose& T_world_sensor,
                    const Surroundings& around, SonarSurvey& out) {
    std::size_t above = 0;
    std::size_t below = 0;
    std::size_t met_above = 0;
    std::size_t met_below = 0;
    std::vector<std::size_t> met(scene.instances.size());
    for (const Look& look : around) {
        const bool up = (T_world_sensor.rotation * look.direction.cast<double>()).z() > 0.0;
        (up ? above : below) += 1;
        (up ? met_above : met_below) += look.meets();
        if (look.meets()) ++met[look.met.instance];
    }
    // Below a sea floor, and below a hull, there is surface everywhere above and none below.
    out.below_surface += open_upwards && 2 * met_above > above && 50 * met_below <= below;
    const auto largest = std::ranges::max_element(met);
    // The bottom below or within an object that rests on it is met in some directions.
    if (met.empty() || 100 * *largest < 60 * around.size()) return;
    const auto instance = static_cast<std::size_t>(largest - met.begin());
    if (boxes[instance].isEmpty()) return;
    const bool has_all = holds_all(boxes[instance], scene);
    const bool is_surrounded = 100 * *largest >= 98 * around.size();
    if (!is_surrounded && has_all) return;
    if ((!is_surrounded || has_all) &&
        !is_inside_solid(scene, instance, T_world_sensor.translation, is_surrounded ? 0.5 : 0.95))
        return;
    ++out.enclosed;
    out.enclosed_by = scene.instances[instance];
}

/// True if a direction in view meets nothing and gets below the scene in range: past the edge.
bool passes_edge(const View& view, const Scene& scene, const Pose& T_world_sensor,
                 const Surroundings& around) {
    for (const Look& look : around) {
        if (look.meets() || beam_of(view, look.direction) < 0) continue;
        const Eigen::Vector3d end =
            T_world_sensor.translation +
            T_world_sensor.rotation * (view.range_max_m * look.direction.cast<double>());
        if (end.z() < scene.bounds_min.z()) return true;
    }
    return false;
}

/// Adds surface, objects, and the range of the first and last echo of a ping; false without any.
bool take_samples(const View& view, const Samples& samples, const SceneObjects& objects,
                  SonarSurvey& out) {
    ValueRange echoes;
    std::vector<std::size_t> sees(objects.objects.size(), 0);
    for (const Sample& sample : samples.items) {
        const double range = arrival_range(sample.position);
        if (range < view.range_min_m || range >= view.range_max_m) continue;
        echoes.take(range);
        if (!kind_of(sample.kind).has_labels) continue;
        out.visible_m2[sample.instance] += sample.area_m2;
        if (!sees.empty()) sees[objects.object_of(sample.instance)] = 1;
    }
    for (std::size_t k = 0; k < sees.size(); ++k)
        out.visible[k] += sees[k];
    if (echoes.empty()) return false;
    out.first_echo_m.take(echoes.low);
    out.last_echo_m.take(echoes.high);
    return true;
}

/// Sums over the bins of a sonar's pings.
struct BinSums {
    std::size_t bins = 0;
    std::size_t with_surface = 0;
    std::size_t white = 0;
    std::size_t occupied = 0;
    double signal = 0.0;
    double noise = 0.0;
};

/// `clean` is the image without pixel noise.
void add_bins(const Sonar& sonar, double full_scale, const Ping& clean, const Ping& ping,
              BinSums& sums, SonarSurvey& out) {
    for (std::size_t i = 0; i < ping.intensity.size(); ++i) {
        const float value = ping.intensity[i];
        out.brightest = std::max(out.brightest, value);
        if (clean.intensity[i] <= 0.0F) continue;
        ++sums.with_surface;
        sums.white += value > full_scale;
        const auto [signal, noise] = sonar.settings.model->signal_and_noise(
            clean.intensity[i], value, static_cast<int>(i) / ping.beams,
            static_cast<int>(i) % ping.beams);
        // White counts once: the ringing after a pulse is no lost echo.
        sums.signal += std::min<double>(signal, full_scale);
        sums.noise += std::min<double>(noise, full_scale);
    }
    sums.bins += ping.intensity.size();
    sums.occupied += ping.counts.occupied_bins;
}

void finish(const BinSums& sums, SonarSurvey& out) {
    if (sums.bins == 0 || sums.with_surface == 0) return;
    const auto with_surface = static_cast<double>(sums.with_surface);
    out.occupied_share = static_cast<double>(sums.occupied) / static_cast<double>(sums.bins);
    out.white_share = static_cast<double>(sums.white) / with_surface;
    out.noise = sums.noise / with_surface;
    out.signal = sums.signal / with_surface;
}

SonarSurvey survey_sonar(const Mission& mission, const Assembly& assembly, Sonar sonar,
                         double full_scale, std::span<const Eigen::AlignedBox3d> boxes,
                         const VisibilityEngine& rays) {
    SonarSurvey out;
    out.visible_m2.resize(assembly.scene.instances.size());
    out.visible.resize(assembly.objects.objects.size());
    const bool open_upwards = faces_up(assembly.scene);
    View& view = sonar.settings.view;
    view.relative_l1 = std::max(view.relative_l1, coarse_l1);
    const auto bins = static_cast<std::size_t>(view.range_bins) * view.beams;
    const bool slow = sonar.settings.model->info.is_slow;
    const std::size_t max_probes = slow ? max_slow : max_pings;
    BinSums sums;
    for (const std::uint32_t pose :
         sample_pings(assembly.trajectory.size(), sonar.config.every,
                      std::clamp<std::size_t>(max_bins / bins, 3, max_probes))) {
        const TimedPose& at = assembly.trajectory[pose];
        const SonarAtPose then(mission, sonar, pose);
        const Pose T_world_sensor = sensor_pose(*then, at.T_world_vehicle, pose);
        const std::shared_ptr<const VisibilityEngine> now =
            engine_at(rays, assembly.motions, at.t_s);
        const TracedPing traced = trace(*then, assembly.scene, *now, at.T_world_vehicle, pose);
        const PingKey key{mission.seed, pose};
        const Surroundings around = look(view, *now, T_world_sensor);
        const bool in_turn = !slow || out.pings % images_of_slow == 0;
        ++out.pings;
        if (const auto altitude = altitude_m(*now, T_world_sensor)) out.altitude_m.take(*altitude);
        bool is_blind = !take_samples(view, traced.samples, assembly.objects, out);
        check_position(assembly.scene, open_upwards, boxes, T_world_sensor, around, out);
        out.beyond_edge +=
            open_upwards && !is_blind && passes_edge(view, assembly.scene, T_world_sensor, around);
        if (in_turn || is_blind) {  // water and targets in it have echoes without surface
            const Ping ping = form_image(traced, then->settings, assembly.scene, key);
            is_blind = ping.counts.occupied_bins == 0;
            add_bins(sonar, full_scale,
                     form_image(traced, then->settings, assembly.scene, key, {.random = 1}), ping,
                     sums, out);
        }
        if (is_blind) {
            ++out.blind;
            explain(view, around, distance_to(assembly.scene, T_world_sensor.translation),
                    out.no_return);
            out.no_return.depths +=
                looks_like_depth(assembly.scene, T_world_sensor.translation.z(), view.range_max_m);
        }
    }
    finish(sums, out);
    return out;
}

}  // namespace

std::vector<SonarSurvey> survey(const Mission& mission, const Assembly& assembly,
                                const VisibilityEngine& rays) {
    const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_instances(assembly.scene);
    std::vector<SonarSurvey> out;
    for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
        out.push_back(survey_sonar(mission, assembly, assembly.sonars[i], assembly.full_scales[i],
                                   boxes, rays));
    }
    return out;
}

}  // namespace sonarsim
