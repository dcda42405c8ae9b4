#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace sonarsim {

/// A glTF file, how it is read, and where it is placed.
struct PlacedFile {
    std::filesystem::path file = {};
    double unit_m = 1.0;        ///< length of the file's unit
    bool z_up = false;          ///< the file's z points up, not its y
    std::string material = {};  ///< material of every triangle; "": the file's own
    std::vector<std::pair<std::string, std::string>> renamed_materials = {};
    /// Patterns of nodes that are left out with their descendants.
    std::vector<std::string> exclude = {};

    std::string name = {};        ///< makes one instance of all nodes; "": each is one of its own
    std::string class_name = {};  ///< class of its instances; "": the file's own
    /// Transform from the file's own frame, which is in metres with z up, to the world, or to the
    /// frame of a body that moves.
    Eigen::Affine3d T_world_file = Eigen::Affine3d::Identity();
    bool moves = false;
    Location place = {};  ///< in the mission, for messages
};

}  // namespace sonarsim
