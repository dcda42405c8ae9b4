#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace sonarsim {

/// Triangles with materials.
struct FaceMesh {
    std::vector<Eigen::Vector3f> corners;  ///< three of each triangle
    std::vector<std::uint32_t> materials;  ///< one for each triangle

    void add(const std::vector<Eigen::Vector3f>& vertices,
             const std::array<std::uint32_t, 3>& triangle, std::uint32_t material) {
        for (const std::uint32_t corner : triangle)
            corners.push_back(vertices[corner]);
        materials.push_back(material);
    }
};

/// Triangles of one material that join in one plane.
struct MeshFace {
    std::vector<std::array<Eigen::Vector3f, 3>> triangles;
    std::vector<std::array<Eigen::Vector3f, 2>> border;  ///< the face lies on one side of it
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit
    std::uint32_t material = 0;
};

/// The flat faces of a mesh. Two faces that meet are facets of one curved surface, and left out, if
/// it turns by less than 30 degrees there and neither of them reaches 5 times as far from the side
/// as the other: a large face next to a narrow bevel is flat.
std::vector<MeshFace> faces_of(const FaceMesh& mesh);

}  // namespace sonarsim
