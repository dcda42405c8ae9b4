#include "preview/scene_raster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/input_limits.h"
#include "scene/copies.h"

namespace sonarsim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

/// Visits the triangles of the scene at a pose, world. It visits the copies whose box is
/// wanted, and only every n-th triangle of them if there are very many.
template <class Wanted, class Visit>
void for_each_triangle(const Assembly& assembly, std::uint32_t pose, const Wanted& wanted,
                       const Visit& visit) {
    const Scene& scene = assembly.scene;
    const auto resting = [&](std::uint32_t i) -> Vector3d {
        return scene.origin + scene.vertices[i].cast<double>();
    };
    for (const auto& [a, b, c] : scene.triangles)
        visit({resting(a), resting(b), resting(c)});
    const std::vector<Pose> poses = body_poses(assembly, assembly.trajectory[pose].t_s);
    for (std::size_t k = 0; k < poses.size(); ++k) {
        const Body& body = scene.bodies[k];
        const auto moved = [&](std::uint32_t i) -> Vector3d {
            return poses[k].rotation * body.vertices[i].cast<double>() + poses[k].translation;
        };
        for (const auto& [a, b, c] : body.triangles)
            visit({moved(a), moved(b), moved(c)});
    }
    constexpr std::size_t most_of_copies = 3'000'000;  // keeps the preview quick
    const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_copies(scene);
    std::size_t count = 0;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (wanted(boxes[k])) count += scene.shared_meshes[scene.copies[k].mesh].triangles.size();
    }
    const std::size_t step = 1 + count / most_of_copies;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (!wanted(boxes[k])) continue;
        const MeshCopy& copy = scene.copies[k];
        const SharedMesh& mesh = scene.shared_meshes[copy.mesh];
        const auto placed = [&](std::uint32_t i) -> Vector3d {
            return copy.T_world_mesh * mesh.vertices[i].cast<double>();
        };
        for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
            const auto& [a, b, c] = mesh.triangles[t];
            visit({placed(a), placed(b), placed(c)});
        }
    }
}

/// Keeps the height of the highest surface in each pixel.
struct HeightRaster {
    const PlaneFrame& frame;
    double ceiling;  ///< higher surface is left out
    std::vector<float> z;

    void put(int column, int row, double height) {
        if (column < 0 || row < 0 || column >= frame.plot_width || row >= frame.plot_height ||
            height > ceiling)
            return;
        float& here = z[static_cast<std::size_t>(row) * frame.plot_width + column];
        if (!(here >= height)) here = static_cast<float>(height);
    }

    /// Coordinates in pixels of the plot.
    Vector2d place(const Vector3d& p) const {
        return frame.pixel(p.head<2>()) - Vector2d(frame.left, frame.top);
    }

    /// Draws the edges of triangles, so that thin and upright ones are visible, too. An upright
    /// triangle that crosses the ceiling is drawn at the ceiling where its edge is above.
    void put_edge(const Vector3d& a, const Vector3d& b, bool upright) {
        const Vector2d from = place(a);
        const Vector2d way = place(b) - from;
        // Only the part in the plot is stepped along: an edge may be a million times as long.
        const auto part = part_within(Vector2d(frame.plot_width, frame.plot_height), from, way);
        if (!part) return;
        const auto [begin, end] = *part;
        const int steps = static_cast<int>(std::ceil((end - begin) * way.norm()));
        for (int k = 0; k <= steps; ++k) {
            const double share = steps > 0 ? begin + (end - begin) * k / steps : begin;
            const Vector2d at = from + share * way;
            put(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                std::min(a.z() + share * (b.z() - a.z()), upright ? ceiling : furthest_m));
        }
    }

    void put_face(const Corners& corner) {
        const Vector2d a = place(corner[0]);
        const Vector2d ab = place(corner[1]) - a;
        const Vector2d ac = place(corner[2]) - a;
        const double area = ab.x() * ac.y() - ab.y() * ac.x();
        if (std::fabs(area) < 1e-9) return;
        const Vector2d low = a + ab.cwiseMin(ac).cwiseMin(0.0);
        const Vector2d high = a + ab.cwiseMax(ac).cwiseMax(0.0);
        // The coordinates of a corner may exceed an int.
        const Vector2d size(frame.plot_width, frame.plot_height);
        const Eigen::Vector2i first = low.cwiseMax(0.0).cwiseMin(size).cast<int>();
        const Eigen::Vector2i last =
            high.cwiseMax(-1.0).cwiseMin(size - Vector2d::Ones()).cast<int>();
        for (int row = first.y(); row <= last.y(); ++row) {
            for (int column = first.x(); column <= last.x(); ++column) {
                const Vector2d p = Vector2d(column + 0.5, row + 0.5) - a;
                const double u = (p.x() * ac.y() - p.y() * ac.x()) / area;
                const double v = (ab.x() * p.y() - ab.y() * p.x()) / area;
                if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
                put(column, row,
                    corner[0].z() + u * (corner[1].z() - corner[0].z()) +
                        v * (corner[2].z() - corner[0].z()));
            }
        }
    }
};

}  // namespace

std::vector<float> heights_below(const Assembly& assembly, std::uint32_t pose,
                                 const PlaneFrame& frame) {
    HeightRaster raster{
        frame, assembly.trajectory[pose].T_world_vehicle.translation.z(),
        std::vector<float>(static_cast<std::size_t>(frame.plot_width) * frame.plot_height,
                           std::nanf(""))};
    const Vector2d high = frame.low + frame.pixel_m * Vector2d(frame.plot_width, frame.plot_height);
    const auto shows = [&](const Vector3d& least, const Vector3d& most) {
        return least.z() <= raster.ceiling && (most.head<2>().array() >= frame.low.array()).all() &&
               (least.head<2>().array() <= high.array()).all();
    };
    const auto wanted = [&](const Eigen::AlignedBox3d& box) { return shows(box.min(), box.max()); };
    for_each_triangle(assembly, pose, wanted, [&](const Corners& corner) {
        if (!shows(corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
                   corner[0].cwiseMax(corner[1]).cwiseMax(corner[2])))
            return;
        raster.put_face(corner);
        const Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
        const bool upright = std::fabs(normal.z()) < 0.05 * normal.norm();
        for (int k = 0; k < 3; ++k)
            raster.put_edge(corner[k], corner[(k + 1) % 3], upright);
    });
    return std::move(raster.z);
}

void for_each_cut(const Assembly& assembly, std::uint32_t pose, const Vector3d& point,
                  const Vector2d& axis,
                  const std::function<void(const Vector3d&, const Vector3d&)>& visit) {
    const Vector2d normal(-axis.y(), axis.x());
    const auto meets_plane = [&](const Eigen::AlignedBox3d& box) {
        const double reach = 0.5 * normal.cwiseAbs().dot(box.sizes().head<2>());
        return !box.isEmpty() &&
               std::fabs(normal.dot(box.center().head<2>() - point.head<2>())) <= reach;
    };
    for_each_triangle(assembly, pose, meets_plane, [&](const Corners& corner) {
        std::array<double, 3> side;
        for (int k = 0; k < 3; ++k)
            side[k] = normal.dot(corner[k].head<2>() - point.head<2>());
        Vector3d ends[2];
        int count = 0;
        for (int k = 0; k < 3 && count < 2; ++k) {
            const int next = (k + 1) % 3;
            if ((side[k] < 0.0) == (side[next] < 0.0)) continue;
            const double share = side[k] / (side[k] - side[next]);
            ends[count++] = corner[k] + share * (corner[next] - corner[k]);
        }
        if (count == 2) visit(ends[0], ends[1]);
    });
}

}  // namespace sonarsim
