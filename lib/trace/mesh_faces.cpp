#include "trace/mesh_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "trace/joined_sets.h"

namespace sonarsim {

namespace {

constexpr double one_plane_rad = 0.0017;
// Vertices are floats: they are off by up to this share of their distance from the origin.
constexpr double rounding = 1.2e-7;
constexpr double min_crease = 0.866025;    // cosine of 30 degrees
constexpr float straight_on = 0.9999995F;  // cosine of 0.06 degrees
constexpr float max_reach_ratio = 5.0F;

/// A side of a triangle, from its corner `corner` on. Corners of one position have one number.
struct TriangleSide {
    std::uint32_t triangle, corner;
    std::uint32_t from, to;
};
using SidesByEdge = std::map<std::array<std::uint32_t, 2>, std::vector<TriangleSide>>;

SidesByEdge sides_by_edge(const FaceMesh& mesh) {
    std::map<std::array<float, 3>, std::uint32_t> numbers;
    std::vector<std::uint32_t> number_of;
    for (const Eigen::Vector3f& p : mesh.corners) {
        const auto next = static_cast<std::uint32_t>(numbers.size());
        number_of.push_back(numbers.try_emplace({p.x(), p.y(), p.z()}, next).first->second);
    }
    SidesByEdge out;
    for (std::uint32_t t = 0; t < mesh.materials.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const TriangleSide side{t, k, number_of[3 * t + k], number_of[3 * t + (k + 1) % 3]};
            out[{std::min(side.from, side.to), std::max(side.from, side.to)}].push_back(side);
        }
    }
    return out;
}

/// The distance that a face reaches from the line through two points of its plane.
float reach_from(const MeshFace& face, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    const Eigen::Vector3f across = face.normal.cross((to - from).normalized());
    float most = 0.0F;
    for (const auto& side : face.border)
        most = std::max(most, std::fabs(across.dot(side[0] - from)));
    return most;
}

using Side = std::array<Eigen::Vector3f, 2>;

/// Joins the sides of a border that continue each other straight on.
std::vector<Side> joined_sides(const std::vector<Side>& border) {
    using Key = std::array<float, 3>;
    const auto key = [](const Eigen::Vector3f& p) { return Key{p.x(), p.y(), p.z()}; };
    struct Meeting {
        std::vector<const Side*> in, out;
    };
    std::map<Key, Meeting> meetings;
    for (const Side& side : border) {
        meetings[key(side[0])].out.push_back(&side);
        meetings[key(side[1])].in.push_back(&side);
    }
    const auto direction = [](const Side& side) { return (side[1] - side[0]).normalized(); };
    // The side that continues straight on from a point; null: the border turns there.
    const auto next_at = [&](const Eigen::Vector3f& point) -> const Side* {
        const Meeting& at = meetings[key(point)];
        const bool straight = at.in.size() == 1 && at.out.size() == 1 &&
                              direction(*at.in[0]).dot(direction(*at.out[0])) > straight_on;
        return straight ? at.out[0] : nullptr;
    };
    std::vector<Side> out;
    for (const Side& side : border) {
        if (next_at(side[0])) continue;
        Side whole = side;
        while (const Side* const next = next_at(whole[1]))
            whole[1] = (*next)[1];
        out.push_back(whole);
    }
    return out;
}

class FaceFinder {
  public:
    explicit FaceFinder(const FaceMesh& mesh)
        : mesh_(mesh), edges_(sides_by_edge(mesh)), sets_(mesh.materials.size()) {
        for (std::uint32_t t = 0; t < mesh.materials.size(); ++t) {
            const Eigen::Vector3f* const p = mesh.corners.data() + std::size_t{3} * t;
            const Eigen::Vector3d u = (p[1] - p[0]).cast<double>();
            const Eigen::Vector3d v = (p[2] - p[0]).cast<double>();
            const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
            const Eigen::Vector3d cross = u.cross(v);
            normals_.emplace_back(cross.normalized());
            // An error of a vertex turns the triangle by the error over the triangle's height.
            const double error = rounding * p[0].cast<double>().norm();
            slack_.push_back(one_plane_rad + error * longest / std::max(cross.norm(), 1e-30));
        }
    }

    std::vector<MeshFace> find() {
        join_planes();
        add_borders();
        mark_facets();
        std::vector<MeshFace> out;
        for (auto& [set, face] : faces_) {
            if (planar_[set] == 0 || curved_.contains(set)) continue;
            face.border = joined_sides(face.border);
            out.push_back(std::move(face));
        }
        return out;
    }

  private:
    /// The cosine of the angle between the two triangles of an edge, whatever their winding.
    double turn_at(const TriangleSide& a, const TriangleSide& b) const {
        const double cosine = normals_[a.triangle].dot(normals_[b.triangle]);
        return a.from == b.to ? cosine : -cosine;
    }

    bool is_one_plane(std::uint32_t a, std::uint32_t b) const {
        return normals_[a].cross(normals_[b]).norm() < std::max(slack_[a], slack_[b]);
    }

    void join_planes() {
        for (const auto& [corners, sides] : edges_) {
            if (sides.size() != 2) continue;
            const bool alike =
                mesh_.materials[sides[0].triangle] == mesh_.materials[sides[1].triangle];
            if (alike && turn_at(sides[0], sides[1]) > 0.0 &&
                is_one_plane(sides[0].triangle, sides[1].triangle))
                sets_.join(sides[0].triangle, sides[1].triangle);
        }
        planar_.assign(mesh_.materials.size(), 1);
        for (std::uint32_t t = 0; t < mesh_.materials.size(); ++t) {
            const std::uint32_t set = sets_.of(t);
            if (!is_one_plane(t, set)) planar_[set] = 0;
            const Eigen::Vector3f* const p = mesh_.corners.data() + std::size_t{3} * t;
            MeshFace& face = faces_[set];
            face.triangles.push_back({p[0], p[1], p[2]});
            face.normal = normals_[set].cast<float>();
            face.material = mesh_.materials[set];
        }
    }

    bool is_inner(const std::vector<TriangleSide>& sides) {
        return sides.size() == 2 && sets_.of(sides[0].triangle) == sets_.of(sides[1].triangle);
    }

    /// The ends of a side, ordered so that the face always lies on the same side.
    std::array<Eigen::Vector3f, 2> ends_of(const TriangleSide& side) {
        const Eigen::Vector3f* const p = mesh_.corners.data() + std::size_t{3} * side.triangle;
        const Eigen::Vector3f from = p[side.corner];
        const Eigen::Vector3f to = p[(side.corner + 1) % 3];
        const bool along = normals_[side.triangle].dot(normals_[sets_.of(side.triangle)]) > 0.0;
        return {along ? from : to, along ? to : from};
    }

    void add_borders() {
        for (const auto& [corners, sides] : edges_) {
            if (is_inner(sides)) continue;
            for (const TriangleSide& side : sides)
                faces_[sets_.of(side.triangle)].border.push_back(ends_of(side));
        }
    }

    /// Finds the faces that are facets of a curved surface.
    void mark_facets() {
        for (const auto& [corners, sides] : edges_) {
            if (sides.size() != 2 || is_inner(sides) || !(turn_at(sides[0], sides[1]) > min_crease))
                continue;
            std::array<std::uint32_t, 2> sets{};
            std::array<float, 2> reach{};
            for (int k = 0; k < 2; ++k) {
                const auto ends = ends_of(sides[k]);
                sets[k] = sets_.of(sides[k].triangle);
                reach[k] = reach_from(faces_[sets[k]], ends[0], ends[1]);
            }
            if (reach[0] < max_reach_ratio * reach[1] && reach[1] < max_reach_ratio * reach[0])
                curved_.insert(sets.begin(), sets.end());
        }
    }

    const FaceMesh& mesh_;
    SidesByEdge edges_;
    JoinedSets sets_;
    std::vector<Eigen::Vector3d> normals_;
    std::vector<double> slack_;  ///< greatest angle to a plane that a triangle belongs to, rad
    std::vector<char> planar_;   ///< one for each set
    std::map<std::uint32_t, MeshFace> faces_;
    std::set<std::uint32_t> curved_;  ///< facets of curved surfaces
};

}  // namespace

std::vector<MeshFace> faces_of(const FaceMesh& mesh) {
    return FaceFinder(mesh).find();
}

}  // namespace sonarsim
