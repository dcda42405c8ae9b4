#include "simulate/trace/target_shapes.h"

#include <cmath>
#include <map>
#include <set>

#include "core/groups.h"
#include "input/scene/maps/ground_maps.h"
#include "input/scene/materials.h"
#include "input/scene/mesh_topology.h"

namespace sonarsim {

namespace {

// With more triangles an object would take longer than the rest of a ping.
constexpr std::size_t max_target_triangles = 20'000;
constexpr float max_target_radius_m = 5.0F;
// The cosine of 30 degrees, between the normals of two triangles that meet.
constexpr float crease_cosine = 0.8660254F;
// Meshes of curved surfaces have neighbours of about equal size.
constexpr double max_height_ratio = 5.0;
// Vertices closer than this share of the object's size are one.
constexpr float weld_share = 1e-5F;

/// Adds the triangles to the shape: each once, none without area. Corners at one place have one
/// number, since files repeat vertices at seams of their textures. A triangle that occurs twice,
/// once for each side, is one surface and has one echo.
void add_triangles(const TargetMesh& mesh, TargetShape& shape) {
    const float per_cell = 1.0F / (weld_share * std::max(shape.radius_m, 1e-6F));
    std::vector<Eigen::Vector3f> cells;
    for (const TriangleCorners& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            const Eigen::Vector3f& vertex = shape.vertices.emplace_back(mesh.vertices[corner]);
            cells.emplace_back(((vertex - shape.centre) * per_cell).array().round());
        }
    }
    const std::vector<std::uint32_t> first = first_at_place(cells);
    std::set<TriangleCorners> known;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const TriangleCorners corners{first[3 * t], first[3 * t + 1], first[3 * t + 2]};
        TriangleCorners in_order = corners;
        std::ranges::sort(in_order);
        const Eigen::Vector3d cross = cross_of(shape.vertices, corners);
        if (!known.insert(in_order).second || !(cross.norm() > 0.0)) continue;
        const Eigen::Vector3f normal = cross.normalized().cast<float>();
        shape.triangles.push_back({.corners = corners,
                                   .normals = {normal, normal, normal},
                                   .normal = normal,
                                   .curvature_m = 0.0F,
                                   .material = mesh.materials[t],
                                   .region = 0});
    }
}

/// True if two triangles that share an edge are parts of one curved surface. Their areas are in the
/// ratio of their heights over the edge. `same`: they run along it in one direction.
bool is_smooth(const TargetShape& shape, const TargetTriangle& a, const TargetTriangle& b,
               bool same) {
    const double area_a = cross_of(shape.vertices, a.corners).norm();
    const double area_b = cross_of(shape.vertices, b.corners).norm();
    const float cosine = (same ? -1.0F : 1.0F) * a.normal.dot(b.normal);
    return cosine >= crease_cosine && area_a < max_height_ratio * area_b &&
           area_b < max_height_ratio * area_a;
}

/// Triangles that share edges, triangles that join smoothly, and the corners at which they do.
struct JoinedTriangles {
    JoinedSets parts, regions, corners;
    bool closed = true;  ///< no edge has one triangle, three or more, or two that differ in winding
    bool one_winding = true;  ///< edges of two triangles have them on both sides with one winding

    explicit JoinedTriangles(const TargetShape& shape)
        : parts(shape.triangles.size()),
          regions(shape.triangles.size()),
          corners(3 * shape.triangles.size()) {
        std::vector<TriangleCorners> triangles;
        for (const TargetTriangle& triangle : shape.triangles)
            triangles.push_back(triangle.corners);
        const std::vector<MeshSide> sides = sides_by_edge(triangles, shape.vertices.size());
        for (std::size_t k = 0, end = 0; k < sides.size(); k = end) {
            while (end < sides.size() && sides[end].low == sides[k].low &&
                   sides[end].high == sides[k].high)
                ++end;
            const bool is_pair = end - k == 2;
            if (is_pair) join(shape, sides[k], sides[k + 1]);
            const bool differ = is_pair && sides[k].forward == sides[k + 1].forward;
            one_winding = one_winding && !differ;
            closed = closed && is_pair && !differ;
        }
    }

  private:
    void join(const TargetShape& shape, const MeshSide& a, const MeshSide& b) {
        parts.join(a.triangle, b.triangle);
        const bool same = a.forward == b.forward;
        if (!is_smooth(shape, shape.triangles[a.triangle], shape.triangles[b.triangle], same))
            return;
        regions.join(a.triangle, b.triangle);
        corners.join(3 * a.triangle + a.side, 3 * b.triangle + (b.side + (same ? 0 : 1)) % 3);
        corners.join(3 * a.triangle + (a.side + 1) % 3,
                     3 * b.triangle + (b.side + (same ? 1 : 0)) % 3);
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
    const float edges2 = std::max(a.squaredNorm() * b.squaredNorm(), 1e-30F);
    return a.cross(b).norm() / edges2 * triangle.normal;
}

/// The radius R of the best sphere or cylinder: along an edge the normal turns by the edge over R.
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

/// Sets the normals at corners: weighted means over the triangles that join smoothly there. Without
/// `one_winding` each counts on the side of those before it.
void set_smooth_normals(TargetShape& shape, JoinedSets& corners, bool one_winding) {
    std::vector<Eigen::Vector3f> sum(3 * shape.triangles.size(), Eigen::Vector3f::Zero());
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            Eigen::Vector3f& at = sum[corners.of(3 * t + k)];
            const Eigen::Vector3f one = weighted_normal(shape, shape.triangles[t], k);
            at += (!one_winding && at.dot(one) < 0.0F ? -1.0F : 1.0F) * one;
        }
    }
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        TargetTriangle& triangle = shape.triangles[t];
        for (int k = 0; k < 3; ++k) {
            Eigen::Vector3f mean = sum[corners.of(3 * t + k)].normalized();
            if (!one_winding && mean.dot(triangle.normal) < 0.0F) mean *= -1.0F;
            // The sides of a cone have no common normal at its tip.
            const bool has_mean = mean.dot(triangle.normal) >= crease_cosine;
            triangle.normals[k] = has_mean ? mean : triangle.normal;
            shape.turn = std::max(shape.turn, (triangle.normals[k] - triangle.normal).norm());
        }
        triangle.curvature_m = curvature_of(shape, triangle);
        shape.curvature_m = std::max(shape.curvature_m, std::fabs(triangle.curvature_m));
    }
    shape.curvature_m = std::min(shape.curvature_m, shape.radius_m);
}

/// `slope`, or that of a material that has facets, if less.
float lesser_slope(float slope, const Material& material) {
    const auto material_slope = static_cast<float>(facet_slope(material));
    return material_slope > 0.0F ? std::min(slope, material_slope) : slope;
}

/// Finds the shapes of a scene's objects, and where they are.
class TargetFinder {
  public:
    TargetFinder(const Scene& scene, TargetShapes& out) : scene_(scene), out_(out) {}

    void add_instances() {
        const Groups groups = sort_into_groups(scene_.triangle_instance, scene_.instances.size());
        for (std::uint32_t instance = 0; instance < scene_.instances.size(); ++instance) {
            const std::uint32_t begin = groups.begin[instance];
            const std::uint32_t end = groups.begin[instance + 1];
            if (end - begin > max_target_triangles) continue;
            TargetMesh mesh{.vertices = scene_.vertices, .triangles = {}, .materials = {}};
            for (std::uint32_t k = begin; k < end; ++k) {
                mesh.triangles.push_back(scene_.triangles[groups.items[k]]);
                mesh.materials.push_back(scene_.triangle_material[groups.items[k]]);
            }
            const auto shape = shape_of(mesh, 1.0F);
            // Engines give surface that files hold twice to the first instance.
            if (shape && !is_repeated(out_.shapes[*shape]))
                place(shape, instance, {}, Eigen::Affine3f::Identity());
        }
    }

    void add_bodies() {
        for (std::uint32_t k = 0; k < scene_.bodies.size(); ++k) {
            const Body& body = scene_.bodies[k];
            place(shape_of({body.vertices, body.triangles, body.triangle_material}, 1.0F),
                  body.instance, k, Eigen::Affine3f::Identity());
        }
    }

    void add_copies() {
        std::map<std::uint32_t, std::optional<std::uint32_t>> shape_of_mesh;
        for (const MeshCopy& copy : scene_.copies) {
            const auto [known, is_new] = shape_of_mesh.try_emplace(copy.mesh);
            const SharedMesh& mesh = scene_.shared_meshes[copy.mesh];
            if (is_new)
                known->second =
                    shape_of({mesh.vertices, mesh.triangles, mesh.triangle_material}, 0.0F);
            Eigen::Affine3d T_local_mesh = copy.T_world_mesh;
            T_local_mesh.translation() -= scene_.origin;
            place(known->second, copy.instance, {}, T_local_mesh.cast<float>());
        }
    }

  private:
    /// Adds the shape of a mesh, if at this scale it may be a target, and returns its index.
    std::optional<std::uint32_t> shape_of(const TargetMesh& mesh, float scale) {
        const std::size_t count = mesh.triangles.size();
        if (count == 0 || count > max_target_triangles ||
            scale * ball_around(mesh.vertices, mesh.triangles).radius_m > max_target_radius_m)
            return std::nullopt;
        TargetShape& shape = out_.shapes.emplace_back(target_shape(mesh));
        for (const TargetTriangle& triangle : shape.triangles)
            shape.min_slope = lesser_slope(shape.min_slope, scene_.materials[triangle.material]);
        return static_cast<std::uint32_t>(out_.shapes.size() - 1);
    }

    void place(std::optional<std::uint32_t> number, std::uint32_t instance,
               std::optional<std::uint32_t> body, const Eigen::Affine3f& T_local_shape) {
        if (!number) return;
        const TargetShape& shape = out_.shapes[*number];
        if (T_local_shape.linear().col(0).norm() * shape.radius_m > max_target_radius_m) return;
        float slope = shape.min_slope;
        if (scene_.maps && scene_.maps->lie_on(instance)) {
            for (const std::uint32_t material : scene_.maps->materials())
                slope = lesser_slope(slope, scene_.materials[material]);
        }
        out_.placed.push_back({*number, instance, body, T_local_shape, slope});
    }

    bool is_repeated(const TargetShape& shape) const {
        return std::ranges::any_of(out_.shapes, [&](const TargetShape& other) {
            return &other != &shape && other.vertices == shape.vertices;
        });
    }

    const Scene& scene_;
    TargetShapes& out_;
};

}  // namespace

TargetShape target_shape(const TargetMesh& mesh) {
    TargetShape shape;
    const Ball ball = ball_around(mesh.vertices, mesh.triangles);
    shape.centre = ball.centre;
    shape.radius_m = ball.radius_m;
    add_triangles(mesh, shape);
    JoinedTriangles joined(shape);
    shape.closed = joined.closed;
    if (shape.closed) turn_outwards(shape, joined.parts);
    set_smooth_normals(shape, joined.corners, joined.one_winding);
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t)
        shape.triangles[t].region = joined.regions.of(t);
    return shape;
}

std::shared_ptr<const TargetShapes> find_target_shapes(const Scene& scene) {
    auto out = std::make_shared<TargetShapes>();
    TargetFinder finder(scene, *out);
    finder.add_instances();
    finder.add_bodies();
    finder.add_copies();
    return out->placed.empty() ? nullptr : out;
}

}  // namespace sonarsim
