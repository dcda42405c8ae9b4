#include "output/dataset/encode_ping.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "core/clock.h"
#include "simulate/ping/sonar.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

namespace {

/// The greatest magnitude among `values`; not finite if any of them is not. The bits of floats
/// without their sign are in the order of the numbers, with infinity above all numbers and NaN
/// above infinity. A maximum of integers vectorises, a maximum of floats does not.
float greatest_magnitude(std::span<const float> values) {
    std::uint32_t max_bits = 0;
    for (const float value : values)
        max_bits = std::max(max_bits, std::bit_cast<std::uint32_t>(value) & 0x7fffffffU);
    return std::bit_cast<float>(max_bits);
}

/// The number of values above `limit`. Sums of 32 bits vectorise.
std::uint32_t count_above(std::span<const float> values, float limit) {
    std::uint32_t count = 0;
    for (const float value : values)
        count += value > limit ? 1 : 0;
    return count;
}

}  // namespace

float brightest_pixel(const Ping& ping, std::string_view sensor, std::uint32_t pose) {
    const float brightest = greatest_magnitude(ping.intensity);
    if (std::isfinite(brightest)) return brightest;
    const auto faulty =
        std::ranges::count_if(ping.intensity, [](float v) { return !std::isfinite(v); });
    throw std::runtime_error("sensor '" + std::string(sensor) + "', ping at pose " +
                             std::to_string(pose) + ": " + std::to_string(faulty) + " of " +
                             std::to_string(ping.intensity.size()) +
                             " pixels are NaN or infinite, a fault of sonarsim; please report it "
                             "with the mission");
}

void finish_ping(const Assembly& assembly, const LabelPlan& plan, const RenderedPing& rendered,
                 const std::function<void(const FinishedPing&)>& use) {
    const auto& [id, at_pose, engine, traced, ping] = rendered;
    const Sonar& sonar = *at_pose;
    const auto white = static_cast<float>(assembly.full_scales[id.sensor]);
    const std::uint64_t clipped = count_above(ping.intensity, white);
    const auto metadata = measured({sonar, assembly.trajectory[id.pose].T_world_vehicle, id.pose,
                                    ping, traced, assembly.scene.is_bottom},
                                   *engine);
    LabelledPing labels;
    if (plan.on) {
        labels = label_for_writers(plan, assembly, sonar, *engine, traced, ping,
                                   assembly.trajectory[id.pose].t_s);
    }
    use({id, sonar, traced, ping, metadata, clipped, plan.on ? &labels : nullptr});
}

WrittenPing encode_ping(const Assembly& assembly, const Writers& writers, const LabelPlan& plan,
                        const RenderedPing& rendered) {
    WrittenPing out;
    Stopwatch watch;
    finish_ping(assembly, plan, rendered, [&](const FinishedPing& finished) {
        out.label_seconds = watch.lap();
        out.clipped_pixels = finished.clipped_pixels;
        for (const Writer& writer : writers)
            out.parts.push_back(writer.encode(finished));
    });
    return out;
}

}  // namespace sonarsim
