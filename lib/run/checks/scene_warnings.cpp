#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/text.h"
#include "input/scene/materials.h"
#include "run/checks/find_warnings.h"
#include "simulate/assembly/placed_files.h"

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
    if (assembly.sonars.empty()) return;
    double bin_m = std::numeric_limits<double>::infinity();
    for (const Sonar& sonar : assembly.sonars) {
        const View& view = sonar.settings.view;
        bin_m = std::min<double>(bin_m, (view.range_max_m - view.range_min_m) / view.range_bins);
    }
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

}  // namespace

std::vector<Warning> reading_warnings(const Scene& scene) {
    std::vector<Warning> out;
    const auto add = [&](const std::string& what) {
        out.push_back(make_warning(WarningCode::reading, "scene", what));
    };
    const auto left_out = [&](std::uint64_t count, const char* what) {
        if (count > 0) add(fmt::format("the scene has {} {}; they are left out", count, what));
    };
    // Many meshes have a few triangles without area, at the poles of spheres and where parts meet.
    // Leaving them out changes nothing.
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

std::vector<Warning> material_warnings(const WaterConfig& water, const Scene& scene) {
    std::vector<Warning> out;
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
    return out;
}

std::vector<Warning> scene_warnings(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars) {
    std::vector<Warning> out;
    if (!assembly.scene.triangles.empty() || !assembly.scene.copies.empty()) {
        judge_extent(mission, assembly, sonars, out);
        if (mission.scene.heightmap) judge_heightmap(assembly, out);
    }
    return out;
}

}  // namespace sonarsim
