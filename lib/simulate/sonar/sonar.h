#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "input/mission/mission.h"
#include "simulate/ping/sonar.h"
#include "simulate/sonar/kinds.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// A sonar of the kind that its configuration names. `water` is for the calibrated model.
Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy,
                 const WaterConfig& water = {});

/// The same for a kind that need not be in the table of simulate/sonar/kinds.h.
Sonar make_sonar(const KindOfSonar& kind, const SonarConfig& config, const AccuracyConfig& accuracy,
                 const WaterConfig& water = {});

/// Sets the data of the sonar that depend on the materials of the scene. An echo model that lacks
/// them finds them for each image, and no sound goes through walls.
void prepare_for(const Scene& scene, Sonar& sonar);

/// Sets the objects of the scene that may be targets in the sonars whose echo model adds energies.
/// Without them only the engine samples small and shiny objects.
void find_targets(std::span<Sonar> sonars, const Scene& scene);

/// A sonar at a pose, with the numbers that the mission's `vary` draws for every ping. If `vary`
/// names no key of this sonar, it is the sonar itself, which must outlive this.
class SonarAtPose {
  public:
    SonarAtPose(const Mission& mission, const Sonar& sonar, std::uint32_t pose);

    const Sonar& operator*() const { return drawn_ ? *drawn_ : own_; }
    const Sonar* operator->() const { return &**this; }

  private:
    const Sonar& own_;
    std::optional<Sonar> drawn_;
};

/// The time from one group of beams to the next, s.
double group_period_s(const Sonar& sonar, double sound_speed_m_s);

/// Traces a ping and, from later poses, its later groups of beams. `pose`: its index.
TracedPing trace(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, std::uint32_t pose, const Terms& terms = {});

Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key, const Terms& terms = {});

/// The stages of the sonar's echo model, as in the paper's Fig. 5(d): 0 is direct echoes alone, 1
/// adds multipath, and each stage more adds one of the random terms.
std::size_t stage_count(const Sonar& sonar);

/// The images of a traced ping at the stages of the sonar's echo model. The last is the ping
/// itself. A term that the sonar does not use changes nothing.
std::vector<Ping> form_stages(const TracedPing& traced, const Sonar& sonar, const Scene& scene,
                              const PingKey& key);

/// The settings of `engine` and `octree_leaf_m`. For `auto` see simulate/assembly/assemble.h.
EngineSettings engine_settings(EngineKind kind, double leaf_m = EngineSettings{}.octree_leaf_m);
EngineSettings engine_settings(const Mission& mission);

/// The distance from a sonar straight down to the scene, m. Nothing if no surface is below.
std::optional<double> altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor);

/// The measured values for the metadata of a ping: altitude_m() and the values of the sonar's kind.
/// An absent value is null; the result is null for kinds that measure nothing.
nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine);

}  // namespace sonarsim
