#include "trace/target_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/mesh_topology.h"

namespace sonarsim {

namespace {

// The cosine of 30 degrees, between the normals of two triangles that meet.
constexpr float crease_cosine = 0.8660254F;
// Meshes of curved surfaces have neighbours of about equal size.
constexpr float max_height_ratio = 5.0F;
// Vertices closer than this share of the object's size are one.
constexpr float weld_share = 1e-5F;

/// Gives corners at one place one number. Files repeat vertices at seams of their textures.
void weld(std::span<const Eigen::Vector3f> vertices, std::vector<TriangleCorners>& triangles,
          TargetShape& shape) {
    const float per_cell = 1.0F / (weld_share * std::max(shape.radius_m, 1e-6F));
    std::vector<Eigen::Vector3f> cells;
    for (const TriangleCorners& triangle : triangles) {
        for (const std::uint32_t corner : triangle)
            cells.emplace_back(((vertices[corner] - shape.centre) * per_cell).array().round());
    }
    const std::vector<std::uint32_t> first = first_at_place(cells);
    std::vector<std::uint32_t> number(first.size());
    for (std::uint32_t k = 0; k < first.size(); ++k) {
        std::uint32_t& corner = triangles[k / 3][k % 3];
        if (first[k] == k) {
            number[k] = static_cast<std::uint32_t>(shape.vertices.size());
            shape.vertices.push_back(vertices[corner]);
        }
        corner = number[first[k]];
    }
}

/// Adds the triangles to the shape: each once, none without area. A triangle that occurs twice,
/// once for each side, is one surface and has one echo.
void add_triangles(const std::vector<TriangleCorners>& triangles,
                   std::span<const std::uint32_t> materials, TargetShape& shape) {
    std::vector<std::pair<TriangleCorners, std::size_t>> sorted;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        TriangleCorners c = triangles[t];
        std::ranges::sort(c);
        sorted.emplace_back(c, t);
    }
    std::ranges::sort(sorted);
    std::vector<bool> kept(triangles.size(), true);
    for (std::size_t k = 1; k < sorted.size(); ++k) {
        if (sorted[k].first == sorted[k - 1].first) kept[sorted[k].second] = false;
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const TriangleCorners& corners = triangles[t];
        const Eigen::Vector3d cross = cross_of(shape.vertices, corners);
        if (!kept[t] || !(cross.norm() > 0.0)) continue;
        const Eigen::Vector3f normal = cross.normalized().cast<float>();
        shape.triangles.push_back({.corners = corners,
                                   .normals = {normal, normal, normal},
                                   .normal = normal,
                                   .curvature_m = 0.0F,
                                   .material = materials[t],
                                   .region = 0});
    }
}

/// The distance of a triangle's third corner from one of its sides.
float height_over(const TargetShape& shape, const MeshSide& edge) {
    const TriangleCorners& c = shape.triangles[edge.triangle].corners;
    const Eigen::Vector3f along =
        (shape.vertices[edge.high] - shape.vertices[edge.low]).normalized();
    const Eigen::Vector3f to = shape.vertices[c[(edge.side + 2) % 3]] - shape.vertices[edge.low];
    return (to - to.dot(along) * along).norm();
}

bool is_smooth(const TargetShape& shape, const MeshSide& a, const MeshSide& b) {
    const float cosine = shape.triangles[a.triangle].normal.dot(shape.triangles[b.triangle].normal);
    const float of_a = height_over(shape, a);
    const float of_b = height_over(shape, b);
    return cosine >= crease_cosine && of_a < max_height_ratio * of_b &&
           of_b < max_height_ratio * of_a;
}

/// Calls use(a, b) for the two sides of each edge that two triangles share, from sorted edges.
/// Skips edges of one triangle or of three and more, and edges whose triangles differ in winding.
/// Returns true if no edge was skipped.
template <class Use>
bool each_shared_edge(const std::vector<MeshSide>& edges, Use use) {
    bool all = true;
    for (std::size_t k = 0; k < edges.size();) {
        std::size_t end = k + 1;
        while (end < edges.size() && edges[end].low == edges[k].low &&
               edges[end].high == edges[k].high)
            ++end;
        const bool pair = end == k + 2 && edges[k].forward != edges[k + 1].forward;
        if (pair) use(edges[k], edges[k + 1]);
        all = all && pair;
        k = end;
    }
    return all;
}

/// Turns the normals of each closed part of a closed mesh outwards: its volume is positive then.
void turn_outwards(TargetShape& shape, const std::vector<MeshSide>& edges) {
    JoinedSets parts(shape.triangles.size());
    each_shared_edge(
        edges, [&](const MeshSide& a, const MeshSide& b) { parts.join(a.triangle, b.triangle); });
    std::vector<double> volume(shape.triangles.size(), 0.0);
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        const TriangleCorners& c = shape.triangles[t].corners;
        volume[parts.of(t)] +=
            cross_of(shape.vertices, c).dot((shape.vertices[c[0]] - shape.centre).cast<double>());
    }
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        TargetTriangle& triangle = shape.triangles[t];
        if (volume[parts.of(t)] >= 0.0) continue;
        triangle.normal = -triangle.normal;
        for (Eigen::Vector3f& normal : triangle.normals)
            normal = -normal;
    }
}

/// The normal of a triangle times its weight at a corner with the edges a and b: a x b / (|a|^2
/// |b|^2). On a sphere the sum over the triangles around a vertex has exactly the sphere's
/// direction, however the sphere is cut (N. Max, "Weights for computing vertex normals from facet
/// normals", Journal of Graphics Tools 4 (1999), 1-6).
Eigen::Vector3f weighted_normal(const TargetShape& shape, const TargetTriangle& triangle,
                                int corner) {
    const TriangleCorners& c = triangle.corners;
    const Eigen::Vector3f p = shape.vertices[c[corner]];
    const Eigen::Vector3f a = shape.vertices[c[(corner + 1) % 3]] - p;
    const Eigen::Vector3f b = shape.vertices[c[(corner + 2) % 3]] - p;
    const float least = 1e-30F;
    const float edges2 = std::max(a.squaredNorm() * b.squaredNorm(), least);
    return a.cross(b).norm() / edges2 * triangle.normal;
}

/// The radius R of the sphere or cylinder that fits best: along an edge the normal turns by the
/// edge over R.
float curvature_of(const TargetShape& shape, const TargetTriangle& triangle) {
    float along = 0.0F;
    float turned2 = 0.0F;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const Eigen::Vector3f turn = triangle.normals[next] - triangle.normals[k];
        along +=
            turn.dot(shape.vertices[triangle.corners[next]] - shape.vertices[triangle.corners[k]]);
        turned2 += turn.squaredNorm();
    }
    return turned2 > 1e-8F ? along / turned2 : 0.0F;
}

/// Sets the normals at corners: weighted means over the triangles that join smoothly there.
void set_smooth_normals(TargetShape& shape, const std::vector<MeshSide>& edges) {
    JoinedSets regions(shape.triangles.size());
    JoinedSets corners(3 * shape.triangles.size());
    each_shared_edge(edges, [&](const MeshSide& a, const MeshSide& b) {
        if (!is_smooth(shape, a, b)) return;
        regions.join(a.triangle, b.triangle);
        const auto corner = [](const MeshSide& edge, bool low) {
            const bool first = edge.forward == low;
            return 3 * edge.triangle + (first ? edge.side : (edge.side + 1) % 3);
        };
        corners.join(corner(a, true), corner(b, true));
        corners.join(corner(a, false), corner(b, false));
    });
    std::vector<Eigen::Vector3f> sum(3 * shape.triangles.size(), Eigen::Vector3f::Zero());
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k)
            sum[corners.of(3 * t + k)] += weighted_normal(shape, shape.triangles[t], k);
    }
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        TargetTriangle& triangle = shape.triangles[t];
        triangle.region = regions.of(t);
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f mean = sum[corners.of(3 * t + k)].normalized();
            // The sides of a cone have no common normal at its tip.
            if (mean.dot(triangle.normal) >= crease_cosine) triangle.normals[k] = mean;
        }
        triangle.curvature_m = curvature_of(shape, triangle);
    }
}

}  // namespace

TargetShape target_shape(const TargetMesh& mesh) {
    TargetShape shape;
    std::vector<TriangleCorners> triangles = mesh.triangles;
    const Ball ball = ball_around(mesh.vertices, triangles);
    shape.centre = ball.centre;
    shape.radius_m = ball.radius_m;
    weld(mesh.vertices, triangles, shape);
    add_triangles(triangles, mesh.materials, shape);
    std::vector<TriangleCorners> kept;
    for (const TargetTriangle& triangle : shape.triangles)
        kept.push_back(triangle.corners);
    const std::vector<MeshSide> edges = sides_by_edge(kept, shape.vertices.size());
    shape.closed = each_shared_edge(edges, [](const MeshSide&, const MeshSide&) {});
    if (shape.closed) turn_outwards(shape, edges);
    set_smooth_normals(shape, edges);
    std::ranges::stable_sort(shape.triangles, {}, &TargetTriangle::region);
    for (const TargetTriangle& triangle : shape.triangles) {
        shape.curvature_m = std::max(shape.curvature_m, std::fabs(triangle.curvature_m));
        for (const Eigen::Vector3f& normal : triangle.normals)
            shape.turn = std::max(shape.turn, (normal - triangle.normal).norm());
    }
    shape.curvature_m = std::min(shape.curvature_m, shape.radius_m);
    return shape;
}

}  // namespace sonarsim
