#pragma once

#include <cstdint>
#include <optional>

#include "sonar/sonar.h"

namespace sonarsim {

/// A sonar as it is at a pose: with what the mission's `vary` draws for every ping or, where that
/// is nothing of it, the sonar itself, which must last as long as this.
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
