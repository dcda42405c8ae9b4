#include "visibility/slices/merge_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/groups.h"

namespace sonarsim {

namespace {

// Greatest motion of the surface, as a share of the greatest coordinate. Midpoints of edges are
// rounded to 6e-8 of this coordinate, and a plane through small triangles extrapolates the rounding
// beyond them.
constexpr double most_moved = 2e-6;

// Least height of a triangle, as a share of its longest edge. A lifeboat whose triangles are each
// divided into 64 keeps 10,898 triangles; with 0.02 it keeps 45,568.
constexpr double thinnest_needle = 0.002;

// If a smaller share of the corners can be removed, merging is not worth its time: a slice then has
// at most a twentieth fewer segments.
constexpr double least_gone = 0.05;

struct Face {
    std::array<std::uint32_t, 3> corners;  ///< after welding
    std::uint32_t triangle;                ///< index in the scene
    bool gone = false;
    Eigen::Vector3d normal;  ///< normal of the original triangle; its plane is n . p = height
    double height;
};

struct Neighbour {
    std::uint32_t vertex;
    int faces = 0;
    std::uint32_t first_face = 0;
    /// The edge to it separates materials or instances, has one side only, or is a fold.
    bool is_border = false;
};

/// The greatest motion of the surface, m.
double most_moved_m(const Scene& scene) {
    float greatest = 0.0F;
    for (const Eigen::Vector3f& p : scene.vertices)
        greatest = std::max(greatest, p.cwiseAbs().maxCoeff());
    return most_moved * static_cast<double>(greatest);
}

/// A triangle of the scene.
Face face_of(const Scene& scene, const std::vector<std::uint32_t>& welded, std::uint32_t triangle) {
    const auto place = [&](std::uint32_t v) { return scene.vertices[v].cast<double>(); };
    Face face{};
    face.triangle = triangle;
    for (std::size_t k = 0; k < 3; ++k)
        face.corners[k] = welded[scene.triangles[triangle][k]];
    const auto& [a, b, c] = face.corners;
    const Eigen::Vector3d across = (place(b) - place(a)).cross(place(c) - place(a));
    const double length = across.norm();
    face.normal = length > 0.0 ? Eigen::Vector3d(across / length) : Eigen::Vector3d::Zero();
    face.height = face.normal.dot(place(a));
    return face;
}

bool on_plane(const Scene& scene, double most_m, const Face& face, std::uint32_t v) {
    return std::fabs(face.normal.dot(scene.vertices[v].cast<double>()) - face.height) <= most_m;
}

/// Estimates whether merging is worth its time, with less memory than a Merger needs.
class MergerTrial {
  public:
    MergerTrial(const Scene& scene, const std::vector<std::uint32_t>& welded)
        : scene_(scene), welded_(welded), most_m_(most_moved_m(scene)) {
        std::vector<std::uint32_t> corners;
        corners.reserve(3 * scene.triangles.size());
        for (const auto& triangle : scene.triangles) {
            for (const std::uint32_t corner : triangle)
                corners.push_back(welded[corner]);
        }
        around_ = sort_into_groups(corners, scene.vertices.size());
    }

    bool is_worth_it() const {
        std::size_t flat = 0;
        std::size_t used = 0;
        for (std::size_t v = 0; v < welded_.size(); ++v) {
            if (around_.begin[v] == around_.begin[v + 1]) continue;
            ++used;
            flat += at_most_two_planes(v) ? 1 : 0;
        }
        return static_cast<double>(flat) > least_gone * static_cast<double>(used);
    }

  private:
    /// True if the faces around a vertex lie in two planes, or in one.
    bool at_most_two_planes(std::size_t v) const {
        std::array<Face, 2> planes;
        std::size_t count = 0;
        for (std::uint32_t n = around_.begin[v]; n < around_.begin[v + 1]; ++n) {
            const Face face = face_of(scene_, welded_, around_.items[n] / 3);
            const auto known = [&](const Face& plane) {
                return std::ranges::all_of(plane.corners, [&](std::uint32_t corner) {
                    return on_plane(scene_, most_m_, face, corner);
                });
            };
            if (std::any_of(planes.begin(), planes.begin() + count, known)) continue;
            if (count == 2) return false;
            planes[count++] = face;
        }
        return true;
    }

    const Scene& scene_;
    const std::vector<std::uint32_t>& welded_;
    double most_m_;
    Groups around_;  ///< corners of triangles at each vertex
};

class Merger {
  public:
    Merger(const Scene& scene, const std::vector<std::uint32_t>& welded)
        : scene_(scene), around_(scene.vertices.size()), most_m_(most_moved_m(scene)) {
        faces_.reserve(scene.triangles.size());
        for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
            faces_.push_back(face_of(scene, welded, i));
            for (const std::uint32_t corner : faces_.back().corners)
                around_[corner].push_back(i);
        }
    }

    void run() {
        for (bool changed = true; changed;) {
            changed = false;
            for (std::uint32_t v = 0; v < around_.size(); ++v)
                changed |= !around_[v].empty() && take_out(v);
        }
    }

    Scene result() const {
        Scene out;
        out.vertices = scene_.vertices;
        for (const Face& face : faces_) {
            if (face.gone) continue;
            out.triangles.push_back(face.corners);
            out.triangle_material.push_back(scene_.triangle_material[face.triangle]);
            out.triangle_instance.push_back(scene_.triangle_instance[face.triangle]);
        }
        return out;
    }

  private:
    Eigen::Vector3d place(std::uint32_t v) const { return scene_.vertices[v].cast<double>(); }

    bool on_plane(const Face& face, std::uint32_t v) const {
        return sonarsim::on_plane(scene_, most_m_, face, v);
    }

    /// Removes a vertex by moving it to a neighbour, if the surface does not change.
    bool take_out(std::uint32_t v) {
        if (!find_neighbours(v)) return false;
        for (const Neighbour& to : neighbours_) {
            if (!may_move(v, to)) continue;
            move(v, to.vertex);
            return true;
        }
        return false;
    }

    /// Returns false if the surface around v is not a disc or half a disc.
    bool find_neighbours(std::uint32_t v) {
        neighbours_.clear();
        for (const std::uint32_t f : around_[v]) {
            for (const std::uint32_t corner : faces_[f].corners) {
                if (corner == v) continue;
                auto known = std::ranges::find(neighbours_, corner, &Neighbour::vertex);
                if (known == neighbours_.end())
                    known = neighbours_.insert(known, {corner, 0, f, false});
                else if (!alike(known->first_face, f) || is_fold(v, corner, known->first_face, f))
                    known->is_border = true;
                if (++known->faces > 2) return false;
            }
        }
        int borders = 0;
        for (Neighbour& neighbour : neighbours_) {
            neighbour.is_border |= neighbour.faces == 1;
            borders += neighbour.is_border ? 1 : 0;
        }
        return borders == 0 || borders == 2;
    }

    bool alike(std::uint32_t f, std::uint32_t g) const {
        const std::uint32_t s = faces_[f].triangle;
        const std::uint32_t t = faces_[g].triangle;
        return scene_.triangle_material[s] == scene_.triangle_material[t] &&
               scene_.triangle_instance[s] == scene_.triangle_instance[t];
    }

    /// True if two faces lie on the same side of their common edge. The two sheets of a
    /// double-sided panel meet like this: all their faces lie in one plane, and the edge is still
    /// the panel's outline.
    bool is_fold(std::uint32_t v, std::uint32_t to, std::uint32_t f, std::uint32_t g) const {
        const Eigen::Vector3d along = place(to) - place(v);
        const auto side = [&](std::uint32_t face) -> Eigen::Vector3d {
            const auto& [a, b, c] = faces_[face].corners;
            const std::uint32_t third = a != v && a != to ? a : (b != v && b != to ? b : c);
            return along.cross(place(third) - place(v));
        };
        return side(f).dot(side(g)) > 0.0;
    }

    bool may_move(std::uint32_t v, const Neighbour& to) const {
        const Eigen::Vector3d end = place(to.vertex);
        for (const Neighbour& other : neighbours_) {
            if (!other.is_border || other.vertex == to.vertex) continue;
            // A border must remain one straight line.
            if (!to.is_border) return false;
            const Eigen::Vector3d along = (place(other.vertex) - end).normalized();
            const Eigen::Vector3d aside = place(v) - end;
            if (!(aside.cross(along).norm() <= most_m_)) return false;
        }
        int shared = 0;
        for (const std::uint32_t f : around_[v]) {
            const Face& face = faces_[f];
            if (std::ranges::count(face.corners, to.vertex) > 0) {
                ++shared;
            } else if (!stays(face, v, to.vertex)) {
                return false;
            }
        }
        return shared == to.faces && common_neighbours(to.vertex) == shared;
    }

    /// True if a face keeps its plane and its orientation when v moves.
    bool stays(const Face& face, std::uint32_t v, std::uint32_t to) const {
        if (!on_plane(face, to)) return false;
        std::array<Eigen::Vector3d, 3> p;
        for (int k = 0; k < 3; ++k)
            p[k] = place(face.corners[k] == v ? to : face.corners[k]);
        const Eigen::Vector3d ab = p[1] - p[0];
        const Eigen::Vector3d ac = p[2] - p[0];
        const double longest2 =
            std::max({ab.squaredNorm(), ac.squaredNorm(), (p[2] - p[1]).squaredNorm()});
        return ab.cross(ac).dot(face.normal) >= thinnest_needle * longest2;
    }

    /// Number of common neighbours of another vertex and v, whose neighbours are in neighbours_.
    int common_neighbours(std::uint32_t other) const {
        std::vector<std::uint32_t> common;
        for (const std::uint32_t f : around_[other]) {
            for (const std::uint32_t corner : faces_[f].corners) {
                const bool is_common =
                    corner != other &&
                    std::ranges::find(neighbours_, corner, &Neighbour::vertex) != neighbours_.end();
                if (is_common && std::ranges::find(common, corner) == common.end())
                    common.push_back(corner);
            }
        }
        return static_cast<int>(common.size());
    }

    void move(std::uint32_t v, std::uint32_t to) {
        const std::vector<std::uint32_t> moved = std::exchange(around_[v], {});
        for (const std::uint32_t f : moved) {
            Face& face = faces_[f];
            if (std::ranges::count(face.corners, to) == 0) {
                std::ranges::replace(face.corners, v, to);
                around_[to].push_back(f);
                continue;
            }
            face.gone = true;
            for (const std::uint32_t corner : face.corners)
                std::erase(around_[corner], f);
        }
    }

    const Scene& scene_;
    std::vector<Face> faces_;
    std::vector<std::vector<std::uint32_t>> around_;  ///< faces of each vertex
    std::vector<Neighbour> neighbours_;               ///< neighbours of the current vertex
    double most_m_;
};

}  // namespace

std::optional<Scene> with_flat_faces_merged(const Scene& scene,
                                            const std::vector<std::uint32_t>& welded) {
    if (!MergerTrial(scene, welded).is_worth_it()) return std::nullopt;
    Merger merger(scene, welded);
    merger.run();
    return merger.result();
}

}  // namespace sonarsim
