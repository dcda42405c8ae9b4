#pragma once

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/trace/apply_maps.h"
#include "simulate/trace/counters.h"
#include "simulate/trace/multipath.h"
#include "simulate/trace/ping.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/sample_source.h"
#include "simulate/trace/target_shapes.h"
#include "simulate/trace/visible_surface.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The settings of the trace of a ping.
struct TraceSettings {
    View view;
    Multipath multipath;
    /// Objects that the trace samples itself where an engine's samples cannot; null: none.
    std::shared_ptr<const TargetShapes> targets;
    std::vector<std::shared_ptr<const SampleSource>> sources;  ///< the water's
    MapStrengths map_strengths = MapStrengths::in_samples;
    std::vector<float> wall_transmissions;  ///< see add_behind_walls(); empty: none
};

/// The samples that a sonar insonified. It holds no noise: it may become any number of images.
struct TracedPing {
    Pose T_world_sensor;  ///< at transmission
    PingMotion motion;
    MapStrengths map_strengths = MapStrengths::in_samples;
    Samples samples;
    std::vector<BouncePath> bounces;  ///< multipath paths from samples in beams
    std::optional<Samples> rays;      ///< the samples that multipath starts from; none: `samples`
    /// The group in which each beam transmits, and the traces of all groups after the first, whose
    /// trace is this one. Empty: all beams transmit at once.
    std::vector<int> group_of_beam;
    std::vector<TracedPing> later_groups;
    PingCounts counts;
    PingSeconds seconds;

    /// The samples that `bounces` number.
    const Samples& starts() const { return rays ? *rays : samples; }
};

/// Makes something of a ping in each beam. Every group of beams is traced with all beams:
/// make(group, number) makes it from the trace of one, take_beam(from, beam, to) takes a beam that
/// transmits in a later group, and take_all(from, to) the rest of that group.
template <class Make, class TakeBeam, class TakeAll>
auto by_groups(const TracedPing& traced, Make make, TakeBeam take_beam, TakeAll take_all) {
    auto out = make(traced, 0);
    int number = 0;
    for (const TracedPing& group : traced.later_groups) {
        const auto later = make(group, ++number);
        for (int beam = 0; beam < std::ssize(traced.group_of_beam); ++beam) {
            if (traced.group_of_beam[static_cast<std::size_t>(beam)] == number)
                take_beam(later, beam, out);
        }
        take_all(later, out);
    }
    return out;
}

/// Calls use(sample) for the surface that a ping receives, each where its group receives it.
void for_each_received(const TracedPing& traced, const std::function<void(const Sample&)>& use);

/// Finds the visible surface and, if on, the multipath: steps 1 and 2 of docs/model.md.
TracedPing trace_ping(const TraceSettings& settings, const Scene& scene,
                      const VisibilityEngine& engine, const Pose& T_world_sensor,
                      const Terms& terms = {}, const PingMotion& motion = {});

/// Finds the multipath of a traced ping again, with these settings.
void trace_multipath(const TraceSettings& settings, const Scene& scene,
                     const VisibilityEngine& engine, TracedPing& traced);

/// Adds the surface that sound reaches through thin walls of `samples`. `transmissions`:
/// the share of the power that passes a wall out and back, by material; 0: none; empty: no material
/// is a wall. Sound goes straight on behind a wall, and the strength of a sample is what the walls
/// before it leave. Maps and motion are not applied.
void add_behind_walls(std::span<const float> transmissions, const TraceContext& context,
                      Samples& samples);

}  // namespace sonarsim
