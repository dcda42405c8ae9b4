#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "output/dataset/writer.h"

namespace sonarsim {

/// The brightest pixel. std::runtime_error with sensor and pose when any is NaN or infinite.
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
