#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "output/dataset/writer.h"
#include "simulate/sonar/sonar_at_pose.h"

namespace sonarsim {

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

/// The brightest pixel of a ping. std::runtime_error that names the sensor and the pose when any
/// pixel is NaN or infinite: such an image must never reach the disk.
float brightest_pixel(const Ping& ping, std::string_view sensor, std::uint32_t pose);

/// Measures and labels a ping and calls `use` with it; `plan` is that of its sensor.
void finish_ping(const Assembly& assembly, const LabelPlan& plan, const RenderedPing& rendered,
                 const std::function<void(const FinishedPing&)>& use);

/// The output of a sensor's writers for a ping.
struct WrittenPing {
    std::vector<std::string> parts;    ///< for each writer the bytes of a file or a record
    std::uint64_t clipped_pixels = 0;  ///< intensities above the white of pictures
    double label_seconds = 0.0;        ///< before the writers
};

/// Hands a ping to the writers of its sensor. `plan` is that of the sensor.
WrittenPing encode_ping(const Assembly& assembly, const Writers& writers, const LabelPlan& plan,
                        const RenderedPing& rendered);

}  // namespace sonarsim
