#include "simulate/assembly/render_at_pose.h"

#include "simulate/assembly/poses.h"

namespace sonarsim {

RenderedPing render_at_pose(const Mission& mission, const Assembly& assembly,
                            const VisibilityEngine& engine, const PingId& id) {
    const TimedPose& at = assembly.trajectory[id.pose];
    const SonarAtPose sonar(mission, assembly.sonars[id.sensor], id.pose);
    const std::shared_ptr<const VisibilityEngine> now = engine_at(engine, assembly.motions, at.t_s);
    TracedPing traced = trace(*sonar, assembly.scene, *now, at.T_world_vehicle, id.pose);
    Ping ping = form_image(traced, sonar->settings, assembly.scene, {mission.seed, id.pose});
    return {id, sonar, now, std::move(traced), std::move(ping)};
}

}  // namespace sonarsim
