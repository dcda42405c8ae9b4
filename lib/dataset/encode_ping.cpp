#include "dataset/encode_ping.h"

#include <algorithm>

#include "sonar/measured.h"

namespace sonarsim {

WrittenPing encode_ping(const Assembly& assembly, const VisibilityEngine& engine,
                        const Writers& writers, const LabelPlan& plan, const PingId& id,
                        const TracedPing& traced, const Ping& ping) {
    WrittenPing out;
    const auto white = static_cast<float>(assembly.full_scales[id.sensor]);
    out.clipped_pixels = std::ranges::count_if(ping.intensity, [&](float v) { return v > white; });
    const Sonar& sonar = assembly.sonars[id.sensor];
    const auto metadata =
        measured({sonar, assembly.trajectory[id.pose].T_world_vehicle, id.pose, ping}, engine);
    LabelledPing labels;
    if (plan.on) {
        labels = label_for_writers(plan, label_ping(traced, sonar.settings, assembly.scene,
                                                    assembly.objects, engine, plan.request));
    }
    const FinishedPing finished{
        id, traced, ping, metadata, out.clipped_pixels, plan.on ? &labels : nullptr};
    for (const auto& writer : writers)
        out.parts.push_back(writer->encode(finished));
    return out;
}

}  // namespace sonarsim
