#include "benchmark/scaling.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "benchmark/timed_pings.h"
#include "core/clock.h"
#include "scene/copies.h"
#include "sonar/engine_settings.h"
#include "validation/fit.h"

namespace sonarsim {

namespace {

/// Median milliseconds per ping over the poses; the first ping at each pose does not count.
double time_pings(const Mission& mission, const Assembly& assembly, const Scene& scene,
                  const Sonar& sonar, const VisibilityEngine& engine,
                  const ReportOptions& options) {
    std::vector<double> ms;
    const auto poses = sample_poses(assembly.trajectory.size(), options.poses);
    for (int round = 0; round <= options.rounds; ++round) {
        for (const std::size_t pose : poses) {
            const double start = seconds_now();
            const auto index = static_cast<std::uint32_t>(pose);
            const SonarAtPose then(mission, sonar, index);
            render_ping(*then, scene, engine, assembly.trajectory[pose].T_world_vehicle,
                        {mission.seed, index});
            if (round > 0) ms.push_back(1e3 * (seconds_now() - start));
        }
    }
    return median_summary(ms).centre;
}

/// The scenes of one kind of growth, starting with the original.
std::vector<Scene> grown(const Scene& scene, const std::string& along, std::size_t most) {
    std::vector<Scene> scenes{scene};
    if (along == "detail") {
        while (scenes.size() < 4 && 4 * all_triangles(scenes.back()) <= most)
            scenes.push_back(subdivide(scenes.back()));
    } else {
        for (const int n : {3, 5, 11}) {
            if (all_triangles(scene) * n * n <= most) scenes.push_back(tile(scene, n));
        }
    }
    return scenes;
}

/// Cuts every triangle of a mesh into four at the midpoints of its edges. Calls `piece_of(t)` for
/// each part of triangle t.
template <class Mesh, class PieceOf>
void cut(Mesh& mesh, const PieceOf& piece_of) {
    const auto whole = std::exchange(mesh.triangles, {});
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace(
            {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) {
            const Eigen::Vector3f point = 0.5F * (mesh.vertices[a] + mesh.vertices[b]);
            mesh.vertices.push_back(point);
        }
        return at->second;
    };
    for (std::size_t t = 0; t < whole.size(); ++t) {
        const auto [a, b, c] = whole[t];
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        for (const auto& piece : std::array<std::array<std::uint32_t, 3>, 4>{
                 {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}}) {
            mesh.triangles.push_back(piece);
            piece_of(t);
        }
    }
}

}  // namespace

Scene subdivide(const Scene& scene) {
    Scene out = scene;
    out.triangle_material.clear();
    out.triangle_instance.clear();
    cut(out, [&](std::size_t t) {
        out.triangle_material.push_back(scene.triangle_material[t]);
        out.triangle_instance.push_back(scene.triangle_instance[t]);
    });
    for (SharedMesh& mesh : out.shared_meshes) {
        const auto materials = std::exchange(mesh.triangle_material, {});
        cut(mesh, [&](std::size_t t) { mesh.triangle_material.push_back(materials[t]); });
    }
    return out;
}

Scene tile(const Scene& scene, int n) {
    Scene out = scene;
    const Eigen::Vector3d extent = scene.bounds_max - scene.bounds_min;
    const auto count = static_cast<std::uint32_t>(scene.vertices.size());
    const int reach = n / 2;
    for (int i = -reach; i <= reach; ++i) {
        for (int j = -reach; j <= reach; ++j) {
            if (i == 0 && j == 0) continue;
            const Eigen::Vector3f shift(static_cast<float>(i * extent.x()),
                                        static_cast<float>(j * extent.y()), 0.0F);
            const auto first = static_cast<std::uint32_t>(out.vertices.size());
            for (std::uint32_t v = 0; v < count; ++v)
                out.vertices.push_back(scene.vertices[v] + shift);
            for (const auto& corners : scene.triangles) {
                out.triangles.push_back(
                    {corners[0] + first, corners[1] + first, corners[2] + first});
            }
            out.triangle_material.insert(out.triangle_material.end(),
                                         scene.triangle_material.begin(),
                                         scene.triangle_material.end());
            out.triangle_instance.insert(out.triangle_instance.end(),
                                         scene.triangle_instance.begin(),
                                         scene.triangle_instance.end());
            for (MeshCopy copy : scene.copies) {
                copy.T_world_mesh.pretranslate(shift.cast<double>());
                out.copies.push_back(copy);
            }
        }
    }
    const Eigen::Vector3d grown(reach * extent.x(), reach * extent.y(), 0.0);
    out.bounds_min -= grown;
    out.bounds_max += grown;
    return out;
}

std::vector<Growth> measure_growth(const Mission& mission, const Assembly& assembly,
                                   std::size_t most_triangles, const ReportOptions& options,
                                   const ReportProgress& progress) {
    // The octree does not support copies of shared meshes.
    const bool octree_too = assembly.scene.copies.empty();
    const std::size_t engine_count = octree_too ? 2 : 1;
    std::vector<Growth> out;
    for (const std::string along : {"detail", "area"}) {
        const std::size_t first = out.size();
        for (const Sonar& sonar : assembly.sonars) {
            for (std::size_t e = 0; e < engine_count; ++e) {
                Growth& growth = out.emplace_back();
                growth.sensor = sonar.config.name;
                growth.engine = e == 0 ? "rays" : "octree";
                growth.along = along;
            }
        }
        for (const Scene& scene : grown(assembly.scene, along, most_triangles)) {
            const std::size_t triangles = all_triangles(scene);
            progress("growth in " + along + ": " + std::to_string(triangles) + " triangles");
            OctreeConfig octree = mission.octree;
            octree.literal = false;
            std::vector<std::unique_ptr<VisibilityEngine>> engines;
            engines.push_back(make_engine(scene, {EngineKind::rays, {}}));
            if (octree_too) {
                engines.push_back(make_engine(scene, engine_settings(EngineKind::octree, octree)));
            }
            for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
                for (std::size_t e = 0; e < engine_count; ++e) {
                    Growth& growth = out[first + engine_count * i + e];
                    growth.triangles.push_back(static_cast<double>(triangles));
                    growth.ms_per_ping.push_back(time_pings(
                        mission, assembly, scene, assembly.sonars[i], *engines[e], options));
                }
            }
        }
        for (std::size_t k = first; k < out.size(); ++k)
            out[k].exponent = fit_exponent(out[k].triangles, out[k].ms_per_ping);
    }
    return out;
}

}  // namespace sonarsim
