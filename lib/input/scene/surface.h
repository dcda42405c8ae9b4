#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// Triangles in double precision, before they become a scene; m.
struct Surface {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
};

inline std::array<Eigen::Vector3d, 3> corners_of(const Surface& surface, std::size_t triangle) {
    const auto& c = surface.triangles[triangle];
    return {surface.vertices[c[0]], surface.vertices[c[1]], surface.vertices[c[2]]};
}

inline Surface moved(const Surface& surface, const Eigen::Affine3d& T_world_surface) {
    Surface out = surface;
    for (Eigen::Vector3d& vertex : out.vertices)
        vertex = T_world_surface * vertex;
    return out;
}

inline Eigen::AlignedBox3d box_of(const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : surface.vertices)
        box.extend(vertex);
    return box;
}

inline Eigen::AlignedBox2d box_from_above(std::span<const Eigen::Vector3d> points) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3d& point : points)
        box.extend(point.head<2>());
    return box;
}

}  // namespace sonarsim
