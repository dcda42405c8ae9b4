#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace sonarsim {

struct Seabed;

/// The way in which an image becomes a surface: each pixel is a height.
struct HeightmapRule {
    static constexpr double unlimited = std::numeric_limits<double>::infinity();
    /// The size of a pixel; the south-west corner lies at (0, 0). 0: the file places its pixels.
    double pixel_m = 0.0;
    /// The longest side of the surface's cells, cubic between pixels. 0: those of the pixels.
    double cell_m = 0.0;
    bool is_scaled = false;  ///< the mission has a factor on the heights
    /// The part that is read, on the map: least x and y, largest x and y. Outside the map: all.
    std::array<double, 4> window{-unlimited, -unlimited, unlimited, unlimited};

    bool operator==(const HeightmapRule&) const = default;
};

/// A file of a mesh or of heights, how it is read, and where it is placed.
struct PlacedFile {
    std::filesystem::path file = {};
    double unit_m = 1.0;        ///< length of the file's unit
    bool z_up = false;          ///< the file's z points up, not its y
    bool up_given = false;      ///< the user has said which axis points up
    std::string material = {};  ///< material of every triangle; "": the file's own
    /// Patterns of materials. The part of a node of such a material is an instance of its own.
    std::vector<std::string> parts = {};
    std::optional<HeightmapRule> heightmap = {};  ///< the file is an image of heights
    std::shared_ptr<const Seabed> seabed = {};    ///< generated sea bed, in place of the file

    std::string name = {};        ///< joins all nodes into one instance; "": one instance each
    std::string class_name = {};  ///< class of its instances; "": the file's own
    /// Transform from the file's frame, metres with z up, to the world or to its body's frame.
    Eigen::Affine3d T_world_file = Eigen::Affine3d::Identity();
    bool moves = false;
    /// Patterns of the nodes that are the bottom, empty for all; none: no node is.
    std::optional<std::vector<std::string>> bottom = {};
    Location place = {};  ///< in the mission, for messages
};

}  // namespace sonarsim
