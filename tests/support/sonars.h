#pragma once

#include "sonar/sonar.h"

namespace sonarsim::test {

/// An imaging sonar of 60 x 12 degrees, 0.5-10 m, 256 x 64 bins, without noise.
inline SonarConfig small_imaging() {
    SonarConfig config;
    config.name = "fls";
    config.azimuth_deg = 60.0;
    config.elevation_deg = 12.0;
    config.range_min_m = 0.5;
    config.range_max_m = 10.0;
    config.range_bins = 256;
    config.azimuth_bins = 64;
    return config;
}

/// A sonar whose images are the truth, Eq. 9, without the gain of one half of Eq. 12.
inline Sonar noise_free(const SonarConfig& config, double relative_l1 = 0.03) {
    Sonar sonar = make_sonar(config, {relative_l1});
    sonar.settings.pixel_noise.gain = 1.0F;
    return sonar;
}

}  // namespace sonarsim::test
