#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "run/preview/drawing.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

/// An object of the scene and the box around it, world.
struct ObjectBox {
    std::string name;
    Eigen::AlignedBox3d box;
};

/// The objects at a pose of the trajectory, without those that are background. Nodes of the scene
/// are the objects if the mission asks for no labels and has no classes.
std::vector<ObjectBox> object_boxes(const Assembly& assembly, std::uint32_t pose);

/// Draws the boxes in a plan of x and y, without those that fill most of it, and the names for
/// which there is room, those of large objects first. Returns the boxes of the names in pixels,
/// which do not overlap.
std::vector<Eigen::AlignedBox2d> draw_objects(Picture& tile, const PlaneFrame& frame,
                                              const std::vector<ObjectBox>& objects);

}  // namespace sonarsim
