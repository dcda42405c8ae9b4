#pragma once

#include "support/calibrated.h"
#include "support/draws.h"
#include "support/labelled.h"

namespace sonarsim::test {

enum class Spacing { angle, sine };
constexpr std::array spacings{Spacing::angle, Spacing::sine};

/// 90 degrees of azimuth and of elevation, 1 to 9 m in 320 bins, 160 narrow beams, no noise.
inline Sonar wide_fan(Spacing spacing) {
    SonarConfig config = bare_sonar(default_sonar(SonarKind::imaging), 1e6);
    set_fan(config, 90.0, 90.0, 160);
    set_range(config, 1.0, 9.0, 320);
    BeamConfig& beam = config.instrument.beam;
    beam.width_deg = 0.5;
    beam.side_lobe_db = -40.0;
    beam.view_azimuth_deg = 150.0;
    if (spacing == Spacing::sine) beam.spread = BeamSpacing::equal_sine;
    return make_sonar(config, {0.02});
}

inline int beam_at(const Sonar& sonar, double sine) {
    const std::vector<double>& edges = sonar.azimuth_edges_rad;
    const auto above = std::ranges::upper_bound(edges, std::asin(sine));
    return above == edges.begin() || above == edges.end()
               ? -1
               : static_cast<int>(above - edges.begin()) - 1;
}

}  // namespace sonarsim::test
