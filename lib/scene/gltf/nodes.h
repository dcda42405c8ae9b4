#pragma once

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/placed_file.h"

namespace sonarsim {

/// A mesh where a node of the scene puts it.
struct PlacedMesh {
    int mesh = 0;  ///< index into the model's meshes; exists
    Eigen::Affine3d T_world_mesh;
    std::string instance;  ///< the node's name, unique, or that of the whole file
    std::string material;  ///< extras.sonar.material of the node or an ancestor; "": none
    std::string label;     ///< extras.sonar.class likewise
};

/// Gives every name once: what is taken gets "_2", "_3", ...
struct UniqueNames {
    std::set<std::string> taken;
    std::map<std::string, int> last;

    std::string unique(const std::string& name);
};

/// The meshes of the default scene, else of the first, else of all root nodes, in the order of a
/// walk that takes parents before children. Nodes that fit a pattern of `placed` are left out, with
/// all below them. InputError with the name of the file for nodes that do not exist, have two
/// parents or are their own ancestor, for hierarchies deeper than 256, matrices that are not
/// affine, rotations that are no unit quaternions, skinned meshes and morphed ones; and at the
/// place of `placed` for a pattern that fits no node.
std::vector<PlacedMesh> place_meshes(const tinygltf::Model& model, const PlacedFile& placed,
                                     UniqueNames& names);

/// extras.sonar.material, or "".
std::string sonar_material(const tinygltf::Value& extras);

/// extras.sonar.class, or "".
std::string sonar_class(const tinygltf::Value& extras);

}  // namespace sonarsim
