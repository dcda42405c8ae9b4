#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "simulate/trace/sample_source.h"

namespace sonarsim {

/// A point target in the water.
struct Particle {
    Eigen::Vector3d start_m;  ///< place at time 0, world
    Eigen::Vector3d velocity_m_s;
    /// Its height wraps between these, if the second is greater: bubbles start again below.
    double bottom_m = 0.0, top_m = 0.0;
    float section_m2 = 0.0F;     ///< backscattering cross-section: 10 log of it is the strength
    std::uint32_t material = 0;  ///< index into Scene::materials
    std::uint32_t instance = 0;  ///< index into Scene::instances
};

/// The place of a particle, world.
Eigen::Vector3d place_at(const Particle& particle, double time_s);

/// The point targets of a scene, with their strengths at the frequency of one sonar.
class Particles final : public SampleSource {
  public:
    /// `time_s`: since the first ping, by pose of the trajectory; 0 for poses beyond its end.
    Particles(std::vector<Particle> all, std::vector<double> time_s)
        : all_(std::move(all)), time_s_(std::move(time_s)) {}

    /// Adds the particles in view and in the water that no surface hides. One ray tests each. Their
    /// samples are points: without edges, with the cross-section as their area, facing the sonar.
    void add(const TraceContext& context, const PingMotion& motion, std::uint32_t pose,
             Samples& samples) const override;

    /// Adds `particles`: by object the number received, mean place and total strength.
    void describe(const Samples& samples, const Scene& scene, std::uint32_t pose,
                  nlohmann::ordered_json& ping) const override;

    const std::vector<Particle>& all() const { return all_; }
    double time_s(std::uint32_t pose) const { return pose < time_s_.size() ? time_s_[pose] : 0.0; }

  private:
    std::vector<Particle> all_;
    std::vector<double> time_s_;
};

}  // namespace sonarsim
