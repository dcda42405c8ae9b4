#pragma once

#include "simulate/paper/paper_model.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "support/test.h"

namespace sonarsim::test {

inline void set_range(SonarConfig& config, double min_m, double max_m, int bins) {
    config.range_min_m = min_m;
    config.range_max_m = max_m;
    config.range_bins = bins;
}

inline void set_fan(SonarConfig& config, double azimuth_deg, double elevation_deg, int beams) {
    config.azimuth_deg = azimuth_deg;
    config.elevation_deg = elevation_deg;
    config.azimuth_bins = beams;
}

/// An imaging sonar of 60 x 12 degrees, 0.5-10 m, 256 x 64 bins, without noise.
inline SonarConfig small_imaging() {
    SonarConfig config;
    config.name = "fls";
    set_fan(config, 60.0, 12.0, 64);
    set_range(config, 0.5, 10.0, 256);
    return config;
}

/// A sonar whose images are the truth, Eq. 9, without the gain of one half of Eq. 12.
inline Sonar noise_free(const SonarConfig& config, double relative_l1 = 0.03) {
    SonarConfig with_gain_1 = config;
    with_gain_1.noise.gain = 1.0;
    return make_sonar(with_gain_1, {relative_l1});
}

/// The range bin that contains a range.
inline int bin_at(const Sonar& sonar, double range_m) {
    return static_cast<int>((range_m - sonar.settings.view.range_min_m) /
                            sonar.settings.view.bin_m());
}

/// The middle of a range bin.
inline double bin_centre(const Sonar& sonar, int i) {
    return 0.5 * (sonar.range_edges_m[i] + sonar.range_edges_m[i + 1]);
}

/// A ping by rays.
inline Ping look(const Sonar& sonar, const Scene& scene, const Pose& T_world_vehicle = {},
                 const PingKey& key = {}, const Terms& terms = {}) {
    return render_ping(sonar, scene, *make_rays_engine(scene), T_world_vehicle, key, terms);
}

/// A ping of a sonar whose bins are all equal.
inline Ping even_ping(const Sonar& sonar, float intensity) {
    const View& view = sonar.settings.view;
    Ping ping;
    ping.range_bins = view.range_bins;
    ping.beams = view.beams;
    ping.intensity.assign(static_cast<std::size_t>(view.range_bins) * view.beams, intensity);
    return ping;
}

/// Changes a copy of the sonar's model, which is the paper's.
template <class Change>
void change_paper_model(Sonar& sonar, Change change) {
    auto model =
        std::make_shared<PaperModel>(dynamic_cast<const PaperModel&>(*sonar.settings.model));
    change(*model);
    sonar.settings.model = std::move(model);
}

}  // namespace sonarsim::test
