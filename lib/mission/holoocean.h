#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sonarsim {

/// Paths that a scenario does not give: its world is a level of the game engine.
struct HoloOceanWorld {
    std::string scene = "scene.glb";
    std::string materials = "materials.csv";
};

struct ImportedMission {
    std::string yaml;
    std::vector<std::string> warnings;  ///< keys without a counterpart, "file:line:column: ..."
};

/// A mission from the sonars and the pose of the main agent of a HoloOcean scenario (JSON).
/// HoloOcean's frames are those of sonarsim: metres, right-handed, x forward, y left, z up, roll,
/// pitch and yaw in degrees about fixed axes. The source of its parameters and their meaning: the
/// documentation of HoloOcean 2, pages of its sensors and "Units and Coordinates".
/// InputError with the place in the file for what is no scenario, has no sonar or has a wrong
/// value.
ImportedMission import_holoocean(std::string_view text, const std::string& file,
                                 const HoloOceanWorld& world);

}  // namespace sonarsim
