#pragma once

#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "input/scene/placed_file.h"

namespace sonarsim {

/// extras.sonar.material or extras.sonar.class, by `key`; "" for none.
std::string sonar_extra(const tinygltf::Value& extras, const char* key);

/// InputError for an extras.sonar that is no object or holds other keys or types than the above.
void check_extras(const tinygltf::Model& model, const Location& where);

/// A mesh placed by a node of the scene.
struct PlacedMesh {
    int mesh = 0;  ///< index into the model's meshes; checked to exist
    Eigen::Affine3d T_world_mesh;
    std::string node;              ///< the node's unique name, or the name of the whole file
    std::string material;          ///< extras.sonar.material of the node or an ancestor; "": none
    std::string label;             ///< extras.sonar.class, inherited in the same way
    std::string instance;          ///< `node`, or of a part NODE.MATERIAL
    std::string own_name;          ///< `instance` before names were made unique
    std::string own_node;          ///< `node` before
    std::set<int> materials = {};  ///< the glTF materials of its primitives; empty: all
};

/// Makes names unique: a name that is taken gets "_2", "_3", ...
struct UniqueNames {
    std::set<std::string> taken;
    std::map<std::string, int> last;

    std::string unique(const std::string& name);
};

/// The meshes of the default scene, else of the first, else of all root nodes; parents come before
/// children. InputError with the name of the file for nodes that do not exist, have two parents or
/// are their own ancestor, for hierarchies deeper than 256, matrices that are not affine, rotations
/// that are not unit quaternions, skinned meshes and morphed ones.
std::vector<PlacedMesh> place_meshes(const tinygltf::Model& model, const PlacedFile& placed,
                                     UniqueNames& names);

}  // namespace sonarsim
