#include "trace/target_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "scene/mesh_topology.h"

namespace sonarsim {

namespace {

// The cosine of 30 degrees, between the normals of two triangles that meet.
constexpr float crease_cosine = 0.8660254F;
// Meshes of curved surfaces have neighbours of about equal size.
constexpr double max_height_ratio = 5.0;
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
    std::set<TriangleCorners> known;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const TriangleCorners& corners = triangles[t];
        TriangleCorners in_order = corners;
        std::ranges::sort(in_order);
        const Eigen::Vector3d cross = cross_of(shape.vertices, corners);
        if (!known.insert(in_order).second || !(cross.norm() > 0.0)) continue;
        const Eigen::Vector3f normal = cross.normalized().cast<float>();
        shape.triangles.push_back({.corners = corners,
                                   .normals = {normal, normal, normal},
                                   .normal = normal,
                                   .curvature_m = 0.0F,
                                   .material = materials[t],
                                   .region = 0});
    }
}

/// True if two triangles that share an edge are parts of one curved surface. Their areas are in the
/// ratio of their heights over the edge.
bool is_smooth(const TargetShape& shape, const TargetTriangle& a, const TargetTriangle& b) {
    const double of_a = cross_of(shape.vertices, a.corners).norm();
    const double of_b = cross_of(shape.vertices, b.corners).norm();
    return a.normal.dot(b.normal) >= crease_cosine && of_a < max_height_ratio * of_b &&
           of_b < max_height_ratio * of_a;
}

/// Triangles that share edges, triangles that join smoothly, and the corners at which they do.
struct JoinedTriangles {
    JoinedSets parts, regions, corners;
    bool closed = true;  ///< no edge has one triangle, three or more, or two that differ in winding

    explicit JoinedTriangles(const TargetShape& shape)
        : parts(shape.triangles.size()),
          regions(shape.triangles.size()),
          corners(3 * shape.triangles.size()) {
        std::vector<TriangleCorners> triangles;
        for (const TargetTriangle& triangle : shape.triangles)
            triangles.push_back(triangle.corners);
        const std::vector<MeshSide> sides = sides_by_edge(triangles, shape.vertices.size());
        const auto is_other_edge = [](const MeshSide& a, const MeshSide& b) {
            return a.low != b.low || a.high != b.high;
        };
        for (auto side = sides.begin(); side != sides.end();) {
            const auto end = std::find_if(side, sides.end(), [&](const MeshSide& other) {
                return is_other_edge(*side, other);
            });
            const bool is_pair = end - side == 2 && side[0].forward != side[1].forward;
            if (is_pair) join(shape, side[0], side[1]);
            closed = closed && is_pair;
            side = end;
        }
    }

  private:
    void join(const TargetShape& shape, const MeshSide& a, const MeshSide& b) {
        parts.join(a.triangle, b.triangle);
        if (!is_smooth(shape, shape.triangles[a.triangle], shape.triangles[b.triangle])) return;
        regions.join(a.triangle, b.triangle);
        const auto corner = [](const MeshSide& side, bool low) {
            const bool first = side.forward == low;
            return 3 * side.triangle + (first ? side.side : (side.side + 1) % 3);
        };
        corners.join(corner(a, true), corner(b, true));
        corners.join(corner(a, false), corner(b, false));
    }
};

/// Turns the normals of each part of a closed mesh outwards: its volume is positive then.
void turn_outwards(TargetShape& shape, JoinedSets& parts) {
    std::vector<double> volume(shape.triangles.size(), 0.0);
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        const TriangleCorners& c = shape.triangles[t].corners;
        volume[parts.of(t)] +=
            cross_of(shape.vertices, c).dot((shape.vertices[c[0]] - shape.centre).cast<double>());
    }
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        if (volume[parts.of(t)] < 0.0) shape.triangles[t].normal *= -1.0F;
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
void set_smooth_normals(TargetShape& shape, JoinedSets& corners) {
    std::vector<Eigen::Vector3f> sum(3 * shape.triangles.size(), Eigen::Vector3f::Zero());
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k)
            sum[corners.of(3 * t + k)] += weighted_normal(shape, shape.triangles[t], k);
    }
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        TargetTriangle& triangle = shape.triangles[t];
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f mean = sum[corners.of(3 * t + k)].normalized();
            // The sides of a cone have no common normal at its tip.
            const bool has_mean = mean.dot(triangle.normal) >= crease_cosine;
            triangle.normals[k] = has_mean ? mean : triangle.normal;
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
    JoinedTriangles joined(shape);
    shape.closed = joined.closed;
    if (shape.closed) turn_outwards(shape, joined.parts);
    set_smooth_normals(shape, joined.corners);
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t)
        shape.triangles[t].region = joined.regions.of(t);
    for (const TargetTriangle& triangle : shape.triangles) {
        shape.curvature_m = std::max(shape.curvature_m, std::fabs(triangle.curvature_m));
        for (const Eigen::Vector3f& normal : triangle.normals)
            shape.turn = std::max(shape.turn, (normal - triangle.normal).norm());
    }
    shape.curvature_m = std::min(shape.curvature_m, shape.radius_m);
    return shape;
}

}  // namespace sonarsim
