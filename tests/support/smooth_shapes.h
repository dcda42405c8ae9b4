#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "calibrated/decibel.h"
#include "core/units.h"
#include "support/calibrated.h"

// Sonars that look at a small smooth shape between 10 and 30 m.

namespace sonarsim::test {

inline constexpr SonarKind kinds_before_shapes[] = {SonarKind::imaging, SonarKind::sidescan,
                                                    SonarKind::echosounder, SonarKind::scanning,
                                                    SonarKind::profiling};
inline constexpr EngineKind engines_before_shapes[] = {EngineKind::rays, EngineKind::slices, EngineKind::automatic};

/// A sonar whose bins are 10 cm long, and the direction in which it looks.
struct Looking {
    Sonar sonar;
    Eigen::Vector3d axis;

    double wavelength() const { return calibrated_model_of(sonar).wavelength_m; }
};

inline Looking looking(SonarKind kind, double frequency_hz) {
    SonarConfig config = calibrated(default_sonar(kind), frequency_hz);
    const bool sidescan = kind == SonarKind::sidescan;
    if (sidescan) {
        config.elevation_deg = 6.0;
        config.instrument.beam.tilt_deg = 30.0;
    } else {
        config.azimuth_deg = 20.0;
        config.elevation_deg = 20.0;
        config.azimuth_bins = 61;
    }
    config.range_min_m = 10.0;
    config.range_max_m = 30.0;
    config.range_bins = 200;
    config.instrument = bare(config.instrument);
    config.instrument.beam.width_deg = 3.0;
    config.instrument.pulse.resolution_m = 0.3;
    const double azimuth = sidescan ? radians(60.0) : 0.0;
    return {make_sonar(config, {}), {std::cos(azimuth), std::sin(azimuth), 0.0}};
}

/// The largest level of the image, dB, without absorption up to a range.
inline double peak_db(const Looking& from, const Scene& scene, EngineKind type, double range_m) {
    Sonar sonar = from.sonar;
    find_targets({&sonar, 1}, scene);
    EngineSettings settings;
    settings.type = type;
    const auto engine = make_engine(scene, settings);
    // The sensor looks along its axis, whatever the mount of its kind.
    const TracedPing traced =
        trace_ping(sonar.settings, scene, *engine, Pose{}, direct_echoes_alone);
    const std::vector<float> image =
        form_image(traced, sonar.settings, scene, {}, direct_echoes_alone).intensity;
    return db_of_power(*std::ranges::max_element(image) + 1e-30F) +
           2.0 * calibrated_model_of(sonar).absorption_db_per_m * range_m;
}

}  // namespace sonarsim::test
