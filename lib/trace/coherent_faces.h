#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

// The surface of a scene whose materials reflect coherently. Positions are m relative to
// Scene::origin.

namespace sonarsim {

/// A flat face: triangles of one instance and one material that join in one plane. The surface ends
/// or has a crease at its border, so the facets of a curved surface are no plates.
struct ScenePlate {
    std::vector<std::array<Eigen::Vector3f, 3>> triangles;
    std::vector<std::array<Eigen::Vector3f, 2>> border;  ///< the triangles lie on one side of it
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit, world
    std::uint32_t material = 0;                          ///< index into Scene::materials
    std::uint32_t instance = 0;                          ///< index into Scene::instances
    bool mapped = false;  ///< maps lie on it: its material is that of a texel
};

/// A line along which a curved surface is straight, from one end of a strip to the other.
struct Ruling {
    Eigen::Vector3f from, to;
    Eigen::Vector3f normal;  ///< unit, of the curved surface
};

/// A facet of a surface whose normals turn about one axis, such as a cylinder: it is straight along
/// its rulings, and an arc across them.
struct SceneStrip {
    Ruling first, second;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, of the facet
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
    bool mapped = false;  ///< as for a plate
};

/// Two plates at right angles that meet in a seam.
struct SceneDihedral {
    std::array<std::uint32_t, 2> plates;  ///< indices into CoherentFaces::plates
    Eigen::Vector3f from, to;             ///< the seam
};

/// Three plates at right angles to each other that meet in a point.
struct SceneTrihedral {
    std::array<std::uint32_t, 3> plates;
    Eigen::Vector3f apex;
};

/// The faces of the scene at rest and of copies. Moving bodies have none.
struct CoherentFaces {
    std::vector<ScenePlate> plates;
    std::vector<SceneStrip> strips;
    std::vector<SceneDihedral> dihedrals;
    std::vector<SceneTrihedral> trihedrals;
};

}  // namespace sonarsim
