#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "assembly/placed_files.h"
#include "checks/doubled_triangles.h"
#include "checks/find_warnings.h"
#include "core/text.h"
#include "scene/copies.h"
#include "scene/materials.h"

namespace sonarsim {

namespace {

// docs/warnings.md says why these are the limits.
constexpr double huge_m = 10e3;
constexpr double tiny_m = 0.1;
constexpr double tiny_of_range = 0.01;
constexpr double out_of_scale = 20.0;
// In percent of the scene's surface.
constexpr double upright_of_an_edge = 50.0;
constexpr double flat_of_an_edge = 10.0;

double way_m(const Trajectory& trajectory) {
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
    const double ratio = length / (way_m(assembly.trajectory) + 2.0 * range);
    if (length > huge_m) {
        out.push_back(
            make_warning(WarningCode::scene_huge, "scene", extent.x(), extent.y(), extent.z()));
    } else if (length < tiny_m || length < tiny_of_range * range) {
        out.push_back(make_warning(WarningCode::scene_tiny, "scene", extent.x(), extent.y(),
                                   extent.z(), range));
    } else if (ratio > out_of_scale && 2 * blind > pings) {
        out.push_back(
            make_warning(WarningCode::scene_out_of_scale, "scene", length, ratio, blind, pings));
    }
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
    constexpr double most_bins = 8.0;
    if (assembly.sonars.empty()) return;
    double bin_m = std::numeric_limits<double>::infinity();
    for (const Sonar& sonar : assembly.sonars) {
        const View& view = sonar.settings.view;
        bin_m = std::min<double>(bin_m, (view.range_max_m - view.range_min_m) / view.range_bins);
    }
    const double cell_m = cell_of_heightmap_m(assembly);
    if (cell_m <= most_bins * bin_m) return;
    out.push_back(make_warning(WarningCode::heightmap_facets, "scene.heightmap", cell_m, bin_m,
                               cell_m / bin_m));
}

/// Twice the area of all surface, and of the surface whose normal lies along each axis of the
/// world, m^2.
struct Facing {
    double all = 0.0;
    std::array<double, 3> along{};

    /// The length of `normal` is twice the area of the surface.
    void add(const Eigen::Vector3d& normal) {
        const double area = normal.norm();
        all += area;
        for (int axis = 0; axis < 3; ++axis) {
            if (std::fabs(normal[axis]) > 0.9 * area) along[axis] += area;
        }
    }
};

/// The normal of a triangle; its length is twice the area.
template <class Mesh>
Eigen::Vector3d normal_of(const Mesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    const Eigen::Vector3f& corner = mesh.vertices[a];
    return (mesh.vertices[b] - corner).cross(mesh.vertices[c] - corner).template cast<double>();
}

/// The share of the surface whose normal lies along each axis of the world, in percent. If there
/// are many copies, every n-th of their triangles counts n times: a few million triangles are
/// enough.
std::array<double, 3> facing(const Scene& scene) {
    constexpr std::size_t most_of_copies = 2'000'000;
    Facing facing;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t)
        facing.add(normal_of(scene, t));
    const std::size_t step = 1 + triangles_of_copies(scene) / most_of_copies;
    std::size_t next = 0;  // counts on from copy to copy, so that all triangles of a mesh count
    for (const MeshCopy& copy : scene.copies) {
        const SharedMesh& mesh = scene.shared_meshes[copy.mesh];
        // The scale is uniform, so areas grow by its square.
        const Eigen::Matrix3d linear = copy.T_world_mesh.linear();
        const double factor = linear.col(0).norm() * static_cast<double>(step);
        for (; next < mesh.triangles.size(); next += step)
            facing.add(factor * linear * normal_of(mesh, next));
        next -= mesh.triangles.size();
    }
    for (double& area : facing.along)
        area *= facing.all > 0.0 ? 100.0 / facing.all : 0.0;
    return facing.along;
}

/// A sea floor with z up that was read as y up has its normals along the world's y.
void judge_axes(const Scene& scene, std::vector<Warning>& out) {
    const std::array<double, 3> share = facing(scene);
    const Eigen::Vector3d extent = scene.bounds_max - scene.bounds_min;
    const bool thin = extent.y() < 0.5 * extent.x() && extent.y() < 0.5 * extent.z();
    if (!thin || share[1] < upright_of_an_edge || share[2] > flat_of_an_edge) return;
    out.push_back(make_warning(WarningCode::scene_on_edge, "scene", share[1], share[2]));
}

/// Two bodies that touch may share a few triangles; a part that was written twice shares all.
void judge_doubles(const Scene& scene, std::vector<Warning>& out) {
    constexpr std::size_t share = 100;
    const DoubledTriangles doubled = find_doubled(scene);
    if (doubled.count * share <= scene.triangles.size()) return;
    out.push_back(make_warning(WarningCode::doubled_triangles, "scene",
                               printable(scene.instances[doubled.first_instance]),
                               printable(scene.instances[doubled.second_instance]),
                               doubled.shared_triangles, doubled.count, scene.triangles.size()));
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
    if (water.density_kg_m3 < 950.0 || water.density_kg_m3 > 1200.0)
        out.push_back(make_warning(WarningCode::water_density, "water", water.density_kg_m3));
    if (water.sound_speed_m_s < 1350.0 || water.sound_speed_m_s > 1700.0)
        out.push_back(make_warning(WarningCode::water_speed, "water", water.sound_speed_m_s));
    constexpr double densest = 25e3;          // kg/m^3; osmium has 22,600
    constexpr double fastest = 20e3;          // m/s; diamond has 18,000
    constexpr float faintest = 1.0F / 65535;  // reflected power: impedances within 0.8 %
    for (const Material& material : scene.materials) {
        const std::string about = "material '" + printable(material.name) + "'";
        if (material.density_kg_m3 > densest) {
            out.push_back(make_warning(WarningCode::material_units, about, "density",
                                       material.density_kg_m3));
        }
        if (material.sound_speed_m_s > fastest) {
            out.push_back(make_warning(WarningCode::material_units, about, "speed of sound",
                                       material.sound_speed_m_s));
        }
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
        judge_axes(assembly.scene, out);
        judge_doubles(assembly.scene, out);
        if (mission.scene.heightmap) judge_heightmap(assembly, out);
    }
    return out;
}

}  // namespace sonarsim
