#include "simulate/trace/traced_ping.h"

#include "core/clock.h"
#include "simulate/trace/sample_kinds.h"
#include "simulate/trace/target_surface.h"
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

    // 1. The visible surface, and what else returns the sound.
    const View& view = settings.view;
    Samples& samples = traced.samples;
    samples = visible_surface(view, engine, T_world_sensor);
    TargetSurface targets;
    if (settings.targets)
        targets = target_surface(*settings.targets, view, scene, engine, T_world_sensor);
    replace_samples(targets, view, samples);
    add_behind_walls(settings.wall_transmissions, {view, scene, engine, T_world_sensor}, samples);
    cut_above_water(scene, T_world_sensor, samples);
    traced.counts.samples += samples.items.size();
    traced.counts.dropped_samples = samples.dropped;
    const auto finish = [&](Samples& of) {
        if (scene.maps) {
            apply_maps(*scene.maps, view, T_world_sensor, of, scene.sound_profile.get(),
                       settings.map_strengths);
        }
        move_in_ping(motion, view, of);
    };
    finish(samples);
    if (settings.multipath.on && &engine.by_rays() != &engine) {
        Samples rays = visible_surface(view, engine.by_rays(), T_world_sensor);
        replace_samples(targets, view, rays);
        cut_above_water(scene, T_world_sensor, rays);
        finish(rays);
        traced.rays = std::move(rays);
    }
    traced.seconds.trace = watch.lap();

    // 2. Multipath, Eq. 1-3.
    if (terms.multipath) trace_multipath(settings, scene, engine, traced);
    return traced;
}

void for_each_received(const TracedPing& traced, const std::function<void(const Sample&)>& use) {
    const bool at_once = traced.group_of_beam.empty();
    const auto use_surface = [&](const Sample& sample) {
        if (kind_of(sample.kind).is_surface) use(sample);
    };
    for (int number = 0; number <= std::ssize(traced.later_groups); ++number) {
        const Samples& samples = (number == 0 ? traced : traced.later_groups[number - 1]).samples;
        for (int beam = 0; beam + 1 < std::ssize(samples.beam_begin); ++beam) {
            if (at_once || traced.group_of_beam[static_cast<std::size_t>(beam)] == number)
                std::ranges::for_each(samples.beam(beam), use_surface);
        }
        for (const Sample& sample : samples.in_no_beam()) {
            if (at_once || sample.kind == SampleKind::behind_wall) use_surface(sample);
        }
    }
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
            find_bounces(settings.multipath, context, traced.starts(), traced.counts.multipath);
    }
    traced.seconds.multipath = watch.lap();
}

}  // namespace sonarsim
