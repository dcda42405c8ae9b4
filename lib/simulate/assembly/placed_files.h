#pragma once

#include "input/mission/mission.h"
#include "input/scene/placed_file.h"

namespace sonarsim {

/// A file with the mission's options for reading it, not placed yet.
PlacedFile file_of(const std::filesystem::path& path, const MeshConfig& mesh,
                   const Location& place);
PlacedFile file_of(const ObjectConfig& object);
/// The transform of an object that is not moved to the bottom.
Eigen::Affine3d transform_of(const ObjectConfig& object);
/// A heightmap, placed.
PlacedFile file_of(const HeightmapConfig& map);

/// The materials whose parts of the nodes are instances of their own, by the rules for classes.
std::vector<std::string> parts_of(const Mission& mission, const PlacedFile& file);

/// Unit and axis of .obj, .stl and .ply files of a scene: "tyre.stl: metres, y up (no `up` given)".
std::vector<std::string> readings_of(const SceneConfig& scene);

/// "'tyre'", or "'tyre.stl'" for an object without a name.
std::string title_of(const ObjectConfig& object);

/// The greatest range of the mission's sonars, m.
double farthest_range_m(const Mission& mission);

}  // namespace sonarsim
