#include "run/checks/find_warnings.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <variant>

#include "core/text.h"
#include "core/units.h"
#include "input/scene/materials.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

namespace {

// docs/warnings.md says why these are the limits.
constexpr double huge_m = 10e3;
constexpr double tiny_m = 0.1;
constexpr double tiny_of_range = 0.01;
constexpr double out_of_scale = 20.0;

double path_m(const Trajectory& trajectory) {
    Eigen::AlignedBox3d box;
    for (const TimedPose& pose : trajectory)
        box.extend(pose.T_world_vehicle.translation);
    return box.diagonal().norm();
}

void judge_extent(const Mission& mission, const Assembly& assembly,
                  std::span<const SonarSurvey> sonars, std::vector<Warning>& out) {
    const Eigen::Vector3d extent = assembly.scene.bounds_max - assembly.scene.bounds_min;
    const double length = extent.maxCoeff();
    const double range = farthest_range_m(mission);
    std::size_t pings = 0;
    std::size_t blind = 0;
    for (const SonarSurvey& sonar : sonars) {
        pings += sonar.pings;
        blind += sonar.blind;
    }
    const double ratio = length / (path_m(assembly.trajectory) + 2.0 * range);
    const bool is_odd = length > huge_m || length < tiny_m || length < tiny_of_range * range ||
                        (ratio > out_of_scale && 2 * blind > pings);
    if (!is_odd) return;
    out.push_back(make_warning(WarningCode::scene_out_of_scale, "scene", extent.x(), extent.y(),
                               extent.z(), range, path_m(assembly.trajectory)));
}

/// The distance between two heights of the scene's heightmap, m; 0: it has none.
double cell_of_heightmap_m(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    for (std::size_t k = 0; k < scene.triangles.size(); ++k) {
        if (scene.instances[scene.triangle_instance[k]] != heightmap_instance) continue;
        const auto& [a, b, c] = scene.triangles[k];
        const auto side = [&](std::uint32_t from, std::uint32_t to) {
            return (scene.vertices[to] - scene.vertices[from]).head<2>().norm();
        };
        return std::min({side(a, b), side(b, c), side(c, a)});
    }
    return 0.0;
}

/// W37 for the finest bins of all sonars.
void judge_heightmap(const Assembly& assembly, std::vector<Warning>& out) {
    constexpr double max_bins = 8.0;
    double bin_m = std::numeric_limits<double>::infinity();
    for (const Sonar& sonar : assembly.sonars)
        bin_m = std::min(bin_m, sonar.settings.view.bin_m());
    const double cell_m = cell_of_heightmap_m(assembly);
    if (cell_m <= max_bins * bin_m) return;
    out.push_back(make_warning(WarningCode::heightmap_facets, "scene.heightmap", cell_m, bin_m,
                               cell_m / bin_m, 0.5 * max_bins * bin_m));
}

/// The number of triangles of a scene; a mesh with copies counts once.
std::size_t triangles_of(const Scene& scene) {
    std::size_t count = scene.triangles.size();
    for (const SharedMesh& mesh : scene.shared_meshes)
        count += mesh.triangles.size();
    for (const Body& body : scene.bodies)
        count += body.triangles.size();
    return count;
}

/// W09: materials that reflect no sound in this water.
void judge_materials(const WaterConfig& water, const Scene& scene, std::vector<Warning>& out) {
    constexpr float faintest = 1.0F / 65535;  // reflected power: impedances within 0.8 %
    for (const Material& material : scene.materials) {
        const std::string about = "material '" + printable(material.name) + "'";
        // A material without a density is for targets in the water, which have no surface.
        if (material.density_kg_m3 > 0.0 && material.reflection < faintest) {
            out.push_back(make_warning(WarningCode::material_silent, about, material.density_kg_m3,
                                       material.sound_speed_m_s, material.reflection,
                                       water.density_kg_m3, water.sound_speed_m_s));
        }
    }
}

/// W38: a kind of sonar whose usual sector is wide has one of few degrees, as by radians.
void judge_azimuth(const SonarConfig& config, std::vector<Warning>& out) {
    constexpr double min_rad = 0.3;
    constexpr double max_rad = 2.0 * pi;
    const SonarKeys& keys = kind_of(config.kind).keys;
    if (!keys.azimuth || keys.defaults.azimuth_deg <= max_rad) return;
    if (config.azimuth_deg < min_rad || config.azimuth_deg > max_rad) return;
    out.push_back(make_warning(WarningCode::azimuth_in_radians, about_sensor(config.name),
                               config.azimuth_deg, degrees(config.azimuth_deg)));
}

/// W39: pings before the sound of the ping before is back. Poses of look_at have no times.
void judge_ping_rate(const Mission& mission, const Trajectory& trajectory, const Sonar& sonar,
                     std::vector<Warning>& out) {
    if (std::holds_alternative<LookAtTrajectoryConfig>(mission.trajectory)) return;
    constexpr double rounding = 1e-6;
    const double sound_speed_m_s = mission.water.sound_speed_m_s;
    const double needed_s =
        (sonar.config.shutter.groups - 1) * group_period_s(sonar, sound_speed_m_s) +
        2.0 * sonar.config.range_max_m / sound_speed_m_s;
    const auto every = static_cast<std::size_t>(sonar.config.every);
    std::size_t early = 0;
    double min_s = needed_s;
    for (std::size_t i = every; i < trajectory.size(); i += every) {
        const double interval_s = trajectory[i].t_s - trajectory[i - every].t_s;
        if (interval_s >= needed_s * (1.0 - rounding)) continue;
        ++early;
        min_s = std::min(min_s, interval_s);
    }
    if (early == 0) return;
    out.push_back(make_warning(WarningCode::ping_too_early, about_sensor(sonar.config.name), early,
                               (trajectory.size() - 1) / every, 1.0 / min_s,
                               sonar.config.range_max_m, 1.0 / needed_s,
                               static_cast<double>(every) * std::ceil(needed_s / min_s)));
}

// An estimate, not a measurement: surface in every bin, at an error goal of 1 %.
constexpr double samples_per_bin = 4.0;
// Also an estimate: the image, all labels and the encoded files.
constexpr double bytes_per_bin = 64.0;

}  // namespace

std::vector<Warning> reading_warnings(const Scene& scene) {
    std::vector<Warning> out;
    const auto add = [&](const std::string& what) {
        out.push_back(make_warning(WarningCode::reading, "scene", what));
    };
    const auto left_out = [&](std::uint64_t count, const char* what) {
        if (count > 0) add(fmt::format("the scene has {} {}; they are left out", count, what));
    };
    // Many meshes have a few triangles without area, as at poles; leaving them out changes nothing.
    if (scene.rejects.degenerate_triangles > triangles_of(scene))
        left_out(scene.rejects.degenerate_triangles, "triangles without area, most of all");
    left_out(scene.rejects.non_finite_triangles, "triangles with a vertex that is NaN or infinite");
    left_out(scene.rejects.skipped_primitives, "primitives of points or lines");
    for (const std::string& warning : scene.warnings)
        add(warning);
    for (const std::string& warning : unit_warnings(scene.materials))
        add(warning);
    if (has_coarse_vertices(scene)) {
        add(
            fmt::format("the scene's vertices may be off by {:.2g} m: its file holds large "
                        "coordinates as floats; put them into the translation of a node instead",
                        scene.vertex_rounding_m));
    }
    return out;
}

std::vector<Warning> warnings_before_pings(const Mission& mission, const Assembly& assembly) {
    std::vector<Warning> out = reading_warnings(assembly.scene);
    judge_materials(mission.water, assembly.scene, out);
    for (const Sonar& sonar : assembly.sonars) {
        judge_azimuth(sonar.config, out);
        judge_ping_rate(mission, assembly.trajectory, sonar, out);
    }
    return out;
}

std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays) {
    std::vector<Warning> out = warnings_before_pings(mission, assembly);
    if (!assembly.scene.triangles.empty() || !assembly.scene.copies.empty()) {
        judge_extent(mission, assembly, sonars, out);
        if (mission.scene.heightmap) judge_heightmap(assembly, out);
    }
    for (std::size_t i = 0; i < sonars.size(); ++i) {
        append(out, sonar_warnings(mission.output, assembly.sonars[i], assembly.full_scales[i],
                                   sonars[i]));
    }
    append(out, hidden_objects(mission, assembly, sonars, rays));
    return out;
}

PingMemory ping_memory(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const double bins = view.range_bins;
    const double visible_per_beam = bins * samples_per_bin * sizeof(Sample);
    const double image = view.beams * (visible_per_beam + bins * bytes_per_bin);
    const double guards = 2.0 * view.guards.count * visible_per_beam;
    const EchoModelInfo& model = sonar.settings.model->info;
    const double working =
        model.working_bytes + (sonar.settings.multipath.on ? model.multipath_bytes : 0.0);
    PingMemory out{.bytes = image + guards + working, .key = "range_bins"};
    if (guards > std::max(image, working))
        out.key = "instrument.beam.view_azimuth_deg";
    else if (image > working && view.beams > view.range_bins)
        out.key = "azimuth_bins";
    return out;
}

std::vector<Warning> memory_warnings(const std::vector<Sonar>& sonars, int threads,
                                     double available) {
    constexpr double giga = 1e9;
    std::vector<Warning> out;
    for (const Sonar& sonar : sonars) {
        const PingMemory ping = ping_memory(sonar);
        if (threads * ping.bytes <= available) continue;
        out.push_back(make_warning(WarningCode::memory, about_sensor(sonar.config.name),
                                   ping.bytes / giga, threads, threads * ping.bytes / giga,
                                   available / giga, ping.key));
    }
    return out;
}

}  // namespace sonarsim
