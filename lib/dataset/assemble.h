#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mission/mission.h"
#include "scene/scene.h"
#include "sonar/sonar.h"
#include "trajectory/trajectory.h"
#include "visibility/engine.h"

namespace sonarsim {

/// All that a mission names, read, checked and ready to render.
struct Assembly {
    Scene scene;
    Trajectory trajectory;
    std::vector<Sonar> sonars;  ///< in the order of Mission::sensors
};

/// InputError when the mission's engine cannot do what one of its sensors asks for.
void check_engine(const Mission& mission);

/// Reads the files of a mission and works out its poses. Writes nothing. InputError for whatever
/// is wrong with them.
Assembly assemble(const Mission& mission);

/// The engine that a mission asks for, over a scene that must outlive it. `auto` is rays: in the
/// speed-against-error report they reach every error goal in less time than the octree, on every
/// scene. Throws InputError when octree.leaf_m is too small for the scene.
std::unique_ptr<Surface> make_surface(const Scene& scene, EngineKind engine,
                                      const OctreeConfig& octree);

/// 32 hexadecimal digits that differ when the scene, its materials or the poses differ: a mission
/// names its files, this stands for what was in them.
std::string inputs_hash(const Assembly& assembly);

}  // namespace sonarsim
