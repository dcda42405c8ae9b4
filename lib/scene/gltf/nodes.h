#pragma once

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace sonarsim {

/// A mesh where a node of the scene puts it.
struct PlacedMesh {
    int mesh = 0;  ///< index into the model's meshes; exists
    Eigen::Affine3d T_world_mesh;
    std::string instance;  ///< the node's name, unique
    std::string material;  ///< extras.sonar.material of the node or an ancestor; "": none
    std::string label;     ///< extras.sonar.class likewise
};

/// The meshes of the default scene, else of the first, else of all root nodes, in the order of a
/// walk that takes parents before children. InputError with `file` for nodes that do not exist,
/// have two parents or are their own ancestor, for hierarchies deeper than 256, matrices that are
/// not affine, rotations that are no unit quaternions, skinned meshes and morphed ones.
std::vector<PlacedMesh> place_meshes(const tinygltf::Model& model, const std::string& file);

/// extras.sonar.material, or "".
std::string sonar_material(const tinygltf::Value& extras);

/// extras.sonar.class, or "".
std::string sonar_class(const tinygltf::Value& extras);

}  // namespace sonarsim
