#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mission/mission.h"
#include "scene/gltf/scene_files.h"
#include "scene/objects.h"
#include "scene/scene.h"
#include "sonar/sonar.h"
#include "trajectory/trajectory.h"

namespace sonarsim {

/// A file that a mission names, as it was when it was read.
struct InputFile {
    std::filesystem::path path;
    std::string sha256;
};

/// All that a mission names, read, checked and ready to render.
struct Assembly {
    Scene scene;
    SceneObjects objects;  ///< what labels tell apart in the scene
    Trajectory trajectory;
    std::vector<Trajectory> motions;  ///< of Scene::bodies; they last as long as `trajectory`
    std::vector<Sonar> sonars;        ///< in the order of Mission::sensors
    std::vector<InputFile> inputs;    ///< all files that the mission names, each once
    std::vector<double> full_scales;  ///< by sonar, the intensity that becomes white in pictures
};

/// Reads the files of a mission and works out its poses. Writes nothing. InputError for whatever
/// is wrong with them, and when the mission's engine cannot see what one of its sensors asks for.
Assembly assemble(const Mission& mission);

/// The same with glTF files that may have been read for another mission.
Assembly assemble(const Mission& mission, SceneFiles& models);

/// Where the bodies of the scene are at a time of the trajectory, world.
std::vector<Pose> body_poses(const Assembly& assembly, double t_s);

/// 32 hexadecimal digits that differ when the scene, its materials or the poses differ: a mission
/// names its files, this stands for what was in them.
std::string inputs_hash(const Assembly& assembly);

}  // namespace sonarsim
