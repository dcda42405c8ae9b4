#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace sonarsim {

/// A glTF file, how it is read, and where the scene has it.
struct PlacedFile {
    std::filesystem::path file = {};
    double unit_m = 1.0;        ///< length of the file's unit
    bool z_up = false;          ///< the file's z points up, not its y
    std::string material = {};  ///< of every triangle; "": the file's own
    std::vector<std::pair<std::string, std::string>> renamed_materials = {};
    std::vector<std::string> exclude = {};  ///< patterns of nodes left out, with all below them

    std::string name = {};        ///< makes one instance of all nodes; "": each is one of its own
    std::string class_name = {};  ///< of its instances; "": as the file says
    /// From the file's own frame, which is in metres with z up, to the world, or to the frame of a
    /// body that moves.
    Eigen::Affine3d T_world_file = Eigen::Affine3d::Identity();
    bool moves = false;
    Location place = {};  ///< in the mission, for messages
};

}  // namespace sonarsim
