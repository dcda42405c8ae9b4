#include "simulate/sonar/kinds.h"
#include "simulate/sonar/setup.h"

namespace sonarsim {

/// A multibeam imaging sonar (section III): range by azimuth, elevation is lost. Looks forward.
KindOfSonar imaging_kind() {
    SonarConfig defaults;
    defaults.kind = SonarKind::imaging;
    return {.keys = {.kind = SonarKind::imaging,
                     .name = "imaging",
                     .defaults = defaults,
                     .azimuth_bins = true},
            .shape = ViewShape::fan,
            .looks_down = false,
            .gain = 0.5,
            .has_images = true,
            .finish = add_azimuth};
}

}  // namespace sonarsim
