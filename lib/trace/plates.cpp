#include "trace/plates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "core/groups.h"

namespace sonarsim {

namespace {

constexpr float one_plane = 0.999998F;     // cosine of 0.1 degrees
constexpr float least_crease = 0.866025F;  // cosine of 30 degrees

/// Triangles whose materials reflect coherently.
struct Triangles {
    std::vector<Eigen::Vector3f> corners;  ///< three of each triangle
    std::vector<std::uint32_t> materials;
    std::vector<Eigen::Vector3f> normals;

    void add(const std::vector<Eigen::Vector3f>& vertices,
             const std::array<std::uint32_t, 3>& triangle, std::uint32_t material) {
        for (const std::uint32_t corner : triangle)
            corners.push_back(vertices[corner]);
        const Eigen::Vector3f* const p = corners.data() + corners.size() - 3;
        normals.emplace_back((p[1] - p[0]).cross(p[2] - p[0]).normalized());
        materials.push_back(material);
    }
};

/// A side of a triangle, from its corner `corner` on. Corners of one position have one number.
struct TriangleSide {
    std::uint32_t triangle, corner;
    std::uint32_t from, to;
};
using SidesByEdge = std::map<std::array<std::uint32_t, 2>, std::vector<TriangleSide>>;

SidesByEdge sides_by_edge(const Triangles& triangles) {
    std::map<std::array<float, 3>, std::uint32_t> numbers;
    std::vector<std::uint32_t> number_of;
    for (const Eigen::Vector3f& p : triangles.corners) {
        const auto next = static_cast<std::uint32_t>(numbers.size());
        number_of.push_back(numbers.try_emplace({p.x(), p.y(), p.z()}, next).first->second);
    }
    SidesByEdge out;
    for (std::uint32_t t = 0; t < triangles.materials.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleSide side{t, k, number_of[3 * t + k], number_of[3 * t + (k + 1) % 3]};
            out[{std::min(side.from, side.to), std::max(side.from, side.to)}].push_back(side);
        }
    }
    return out;
}

/// Numbers that are joined into sets.
struct JoinedSets {
    std::vector<std::uint32_t> parent;

    explicit JoinedSets(std::size_t count) : parent(count) {
        std::iota(parent.begin(), parent.end(), 0U);
    }
    std::uint32_t of(std::uint32_t k) {
        while (parent[k] != k)
            k = parent[k] = parent[parent[k]];
        return k;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent[of(a)] = of(b); }
};

/// The cosine of the turn from one triangle to the other one of an edge, whatever way round their
/// corners go.
float turn_at(const Triangles& triangles, const TriangleSide& a, const TriangleSide& b) {
    const float cosine = triangles.normals[a.triangle].dot(triangles.normals[b.triangle]);
    return a.from == b.to ? cosine : -cosine;
}

std::vector<ScenePlate> plates_of(const Triangles& triangles, std::uint32_t instance) {
    const SidesByEdge edges = sides_by_edge(triangles);
    const auto count = static_cast<std::uint32_t>(triangles.materials.size());
    JoinedSets sets(count);
    for (const auto& [corners, sides] : edges) {
        if (sides.size() != 2) continue;
        const bool alike =
            triangles.materials[sides[0].triangle] == triangles.materials[sides[1].triangle];
        if (alike && turn_at(triangles, sides[0], sides[1]) > one_plane)
            sets.join(sides[0].triangle, sides[1].triangle);
    }
    std::vector<char> flat(count, 1);
    for (std::uint32_t t = 0; t < count; ++t) {
        const std::uint32_t set = sets.of(t);
        if (!(std::fabs(triangles.normals[t].dot(triangles.normals[set])) > one_plane))
            flat[set] = 0;
    }
    std::map<std::uint32_t, ScenePlate> plates;
    for (const auto& [corners, sides] : edges) {
        const bool pair = sides.size() == 2;
        if (pair && sets.of(sides[0].triangle) == sets.of(sides[1].triangle)) continue;
        const bool smooth = pair && turn_at(triangles, sides[0], sides[1]) > least_crease;
        for (const TriangleSide& side : sides) {
            const std::uint32_t set = sets.of(side.triangle);
            if (smooth) flat[set] = 0;
            const Eigen::Vector3f* const p = triangles.corners.data() + 3 * side.triangle;
            const Eigen::Vector3f from = p[side.corner];
            const Eigen::Vector3f to = p[(side.corner + 1) % 3];
            ScenePlate& plate = plates[set];
            plate.normal = triangles.normals[set];
            plate.material = triangles.materials[set];
            plate.instance = instance;
            const bool along = triangles.normals[side.triangle].dot(plate.normal) > 0.0F;
            plate.border.push_back({along ? from : to, along ? to : from});
        }
    }
    std::vector<ScenePlate> out;
    for (auto& [set, plate] : plates) {
        if (flat[set] != 0) out.push_back(std::move(plate));
    }
    return out;
}

void add_copied_plates(const Scene& scene, const std::vector<char>& coherent,
                       std::vector<ScenePlate>& out) {
    std::map<std::uint32_t, std::vector<ScenePlate>> of_mesh;
    for (const MeshCopy& copy : scene.copies) {
        const auto [place, is_new] = of_mesh.try_emplace(copy.mesh);
        if (is_new) {
            const SharedMesh& mesh = scene.shared_meshes[copy.mesh];
            Triangles triangles;
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                if (coherent[mesh.triangle_material[t]] != 0)
                    triangles.add(mesh.vertices, mesh.triangles[t], mesh.triangle_material[t]);
            }
            place->second = plates_of(triangles, 0);
        }
        Eigen::Affine3d T_local_mesh = copy.T_world_mesh;
        T_local_mesh.translation() -= scene.origin;
        for (ScenePlate plate : place->second) {
            for (auto& side : plate.border) {
                for (Eigen::Vector3f& end : side)
                    end = (T_local_mesh * end.cast<double>()).cast<float>();
            }
            plate.normal =
                (T_local_mesh.linear() * plate.normal.cast<double>()).normalized().cast<float>();
            plate.instance = copy.instance;
            out.push_back(std::move(plate));
        }
    }
}

}  // namespace

std::shared_ptr<const CoherentFaces> find_coherent_faces(const Scene& scene) {
    std::vector<char> coherent;
    for (const Material& material : scene.materials)
        coherent.push_back(material.roughness_m ? 1 : 0);
    if (std::ranges::find(coherent, 1) == coherent.end()) return nullptr;
    auto out = std::make_shared<CoherentFaces>();
    const Groups groups = sort_into_groups(scene.triangle_instance, scene.instances.size());
    for (std::uint32_t instance = 0; instance < scene.instances.size(); ++instance) {
        Triangles triangles;
        for (std::uint32_t k = groups.begin[instance]; k < groups.begin[instance + 1]; ++k) {
            const std::uint32_t t = groups.items[k];
            if (coherent[scene.triangle_material[t]] != 0)
                triangles.add(scene.vertices, scene.triangles[t], scene.triangle_material[t]);
        }
        std::ranges::move(plates_of(triangles, instance), std::back_inserter(out->plates));
    }
    add_copied_plates(scene, coherent, out->plates);
    std::ranges::stable_sort(out->plates, {}, &ScenePlate::instance);
    return out;
}

}  // namespace sonarsim
