#pragma once

#include <cstdint>
#include <optional>

#include "simulate/sonar/sonar.h"

namespace sonarsim {

/// A sonar at a pose, with the numbers that the mission's `vary` draws for every ping. If `vary`
/// names no key of this sonar, it is the sonar itself, which must outlive this.
class SonarAtPose {
  public:
    SonarAtPose(const Mission& mission, const Sonar& sonar, std::uint32_t pose)
        : own_(sonar), drawn_(drawn_sonar(mission, sonar, pose)) {}

    const Sonar& operator*() const { return drawn_ ? *drawn_ : own_; }
    const Sonar* operator->() const { return &**this; }

  private:
    const Sonar& own_;
    std::optional<Sonar> drawn_;
};

}  // namespace sonarsim
