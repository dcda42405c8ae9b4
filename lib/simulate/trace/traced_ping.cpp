#include "simulate/trace/traced_ping.h"

#include <utility>

#include "core/clock.h"
#include "simulate/trace/target_surface.h"
#include "simulate/trace/through_walls.h"
#include "simulate/trace/visible_water_surface.h"

namespace sonarsim {

TracedPing trace_ping(const TraceSettings& settings, const Scene& scene,
                      const VisibilityEngine& engine, const Pose& T_world_sensor,
                      const Terms& terms, const PingMotion& motion) {
    TracedPing traced;
    traced.T_world_sensor = T_world_sensor;
    traced.motion = motion;
    traced.map_strengths = settings.map_strengths;
    Stopwatch watch;

    // 1. The visible surface.
    VisibleSurface surface =
        visible_surface(settings.view, settings.guard_beams, engine, T_world_sensor);
    if (settings.targets) {
        replace_samples(target_surface(*settings.targets, settings.view, settings.guard_beams,
                                       scene, engine, T_world_sensor),
                        settings.view, surface);
    }
    traced.samples = std::move(surface.samples);
    traced.outside_sector = std::move(surface.outside_sector);
    traced.behind_walls = surface_behind_walls(
        settings.wall_transmissions, {settings.view, scene, engine, traced.T_world_sensor},
        {traced.samples.items, traced.outside_sector});
    for (const std::span<const Sample> of : traced.surfaces())
        traced.counts.samples += of.size();
    traced.counts.dropped_samples = traced.samples.dropped;
    if (scene.maps) {
        apply_maps(*scene.maps, settings.view, T_world_sensor, traced.samples,
                   traced.outside_sector, scene.sound_profile.get(), settings.map_strengths);
        Samples in_no_beams;
        apply_maps(*scene.maps, settings.view, T_world_sensor, in_no_beams, traced.behind_walls,
                   scene.sound_profile.get(), settings.map_strengths);
    }
    move_in_ping(motion, settings.view, traced.samples, traced.outside_sector);
    move_in_ping(motion, settings.view.shape, traced.behind_walls);
    if (settings.sees_water_surface) {
        traced.water_surface = visible_water_surface(settings.view, settings.guard_beams, scene,
                                                     engine, T_world_sensor, motion);
    }
    traced.seconds.trace = watch.lap();

    // 2. Multipath, Eq. 1-3.
    if (terms.multipath) trace_multipath(settings, scene, engine, traced);
    return traced;
}

void trace_multipath(const TraceSettings& settings, const Scene& scene,
                     const VisibilityEngine& engine, TracedPing& traced) {
    Stopwatch watch;
    traced.counts.multipath = {};
    traced.bounces.clear();
    if (settings.multipath.on) {
        const TraceContext context{.view = settings.view,
                                   .scene = scene,
                                   .engine = engine,
                                   .T_world_sensor = traced.T_world_sensor};
        traced.bounces =
            find_bounces(settings.multipath, context, traced.samples, traced.counts.multipath);
    }
    traced.seconds.multipath = watch.lap();
}

}  // namespace sonarsim
