#include <algorithm>
#include <cstdint>
#include <set>

#include "dataset/ping_metadata.h"
#include "dataset/writer.h"
#include "mission/ping_draws.h"

namespace sonarsim {

namespace {

constexpr double bytes_per_byte = 6.0;  // a byte of a text may become \u0001 in JSON

double longest_drawn(const DrawnValues& drawn) {
    double bytes = 0.0;
    for (const auto& [key, value] : drawn)
        bytes += 50.0 + bytes_per_byte * static_cast<double>(key.size() + value.size());
    return bytes;
}

/// More than the bytes of the metadata of any ping: what grows with the mission is counted.
double longest_metadata(const WriterContext& context) {
    constexpr double common = 2500.0;
    constexpr double longest_object = 500.0;  // a pose, or the targets of one instance
    const Mission& mission = context.mission;
    const Scene& scene = context.assembly.scene;
    std::set<std::uint32_t> targets;
    if (const auto& particles = context.sonar().settings.particles) {
        for (const Particle& particle : particles->all)
            targets.insert(particle.instance);
    }
    double bytes = common + longest_drawn(mission.variant.drawn) +
                   longest_drawn(drawn_for_ping(mission, context.sonar().config.name, 0));
    const auto add_object = [&](std::uint32_t instance) {
        bytes +=
            longest_object + bytes_per_byte * static_cast<double>(scene.instances[instance].size());
    };
    for (const Body& body : scene.bodies)
        add_object(body.instance);
    std::ranges::for_each(targets, add_object);
    return bytes;
}

}  // namespace

/// meta/NNNNNN.json: time, poses, seed, counts and what was measured.
std::optional<Writer> make_meta_writer(const WriterContext& context) {
    return Writer{.outputs = {PingFile{"meta", ".json"}, longest_metadata(context), {}},
                  .encode = [context](const FinishedPing& finished) {
                      return json_text(describe_ping(context.mission, context.assembly, finished));
                  }};
}

}  // namespace sonarsim
