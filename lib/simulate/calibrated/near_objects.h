#pragma once

#include <span>
#include <vector>

#include "input/scene/objects.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The directions and ranges at which a line array may receive objects that are no background, or
/// lose surface to their shadows: the cones that their visible samples reach, from a little before
/// them to the end of the range.
class NearObjects {
  public:
    explicit NearObjects(const SceneObjects& objects);

    /// Adds the objects among some samples, in the sensor's frame.
    void add(std::span<const Sample> samples);
    /// The samples that reach these cones and ranges.
    std::vector<Sample> among(std::span<const Sample> samples) const;

  private:
    const SceneObjects& objects_;
    std::vector<float> from_m_;  ///< the least range, by cell of y / r; infinite: no object
};

}  // namespace sonarsim
