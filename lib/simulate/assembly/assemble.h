#pragma once

#include <compare>

#include "input/mission/mission.h"
#include "input/scene/objects.h"
#include "input/scene/placing/bottom.h"
#include "input/scene/scene.h"
#include "input/trajectory/trajectory.h"
#include "simulate/assembly/scene_store.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// A file that a mission names, and its sum when it was read.
struct InputFile {
    std::filesystem::path path;
    std::string sha256;
};

/// Everything that a mission names, read, checked and ready to render.
struct Assembly {
    Scene scene;
    SceneObjects objects;  ///< objects of the scene for labels
    Trajectory trajectory;
    Trajectory reported;  ///< the poses that the navigation reports; empty: the true ones
    std::vector<Trajectory> motions;       ///< motions of Scene::bodies, over all of `trajectory`
    std::shared_ptr<const Bottom> bottom;  ///< reference of the label `height`; null: none
    std::shared_ptr<const Seabed> seabed;  ///< the part of scene.seabed that was made; null: none
    int epsg = 0;                          ///< reference system of scene.heightmap; 0: none
    std::vector<Sonar> sonars;             ///< in the order of Mission::sensors
    std::vector<InputFile> inputs;         ///< the files that the mission names, each once
    std::vector<double> full_scales;       ///< intensity that becomes white in pictures, by sonar
    std::shared_ptr<const Caster> caster;  ///< over `scene`, if one was needed; null: none
    std::shared_ptr<SharedTrees> trees = std::make_shared<SharedTrees>();
    std::shared_ptr<FanStore> fans = std::make_shared<FanStore>();

    /// A caster over `scene`.
    Caster make_caster() const { return caster ? *caster : trees->caster(scene); }
};

/// Reads the files of a mission and computes its poses. Writes nothing. Throws InputError for
/// errors in them, and when the mission's engine does not support the view of a sensor.
Assembly assemble(const Mission& mission);

/// The same; `models` may hold files that were read for another mission.
Assembly assemble(const Mission& mission, SceneStore& models);

/// Finds the place of every object, as assemble() does first. InputError as there.
void check_places(const Mission& mission, SceneStore& models);

/// The poses of the scene's bodies at a time of the trajectory, world.
std::vector<Pose> body_poses(const Assembly& assembly, double t_s);

/// The engine of a mission, over the trees of its assembly, which must outlive it.
std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly);

/// A ping of a dataset: indices into Mission::sensors and the trajectory. Ordered by pose first.
struct PingId {
    std::uint32_t pose = 0;
    std::uint32_t sensor = 0;

    auto operator<=>(const PingId&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// A ping of a mission, and the sonar and the engine that it was made with.
struct RenderedPing {
    PingId id;
    SonarAtPose sonar;
    std::shared_ptr<const VisibilityEngine> engine;  ///< the scene at the time of the ping
    TracedPing traced;
    Ping ping;
};

/// Traces a ping and forms its image. The mission, the assembly and `engine` must outlive it.
RenderedPing render_at_pose(const Mission& mission, const Assembly& assembly,
                            const VisibilityEngine& engine, const PingId& id);

}  // namespace sonarsim
