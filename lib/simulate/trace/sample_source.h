#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "simulate/trace/ping_motion.h"
#include "simulate/trace/trace_context.h"

namespace sonarsim {

/// A source of samples that no engine finds, as what the water holds. Each has a kind of its own.
class SampleSource {
  public:
    virtual ~SampleSource() = default;

    /// Appends the samples that the sonar sees at a pose of the trajectory; they lie in no beam.
    virtual void add(const TraceContext& context, const PingMotion& motion, std::uint32_t pose,
                     Samples& samples) const = 0;

    /// Adds what a ping at this pose has received of it to the ping's metadata.
    virtual void describe(const Samples& /*samples*/, const Scene& /*scene*/,
                          std::uint32_t /*pose*/, nlohmann::ordered_json& /*ping*/) const {}
};

}  // namespace sonarsim
