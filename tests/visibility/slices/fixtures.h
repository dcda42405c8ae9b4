#pragma once

#include "core/units.h"
#include "visibility/slices/slices_engine.h"

namespace sonarsim::test {

inline View fan_view() {
    return {.azimuth_rad = radians(60.0),
            .elevation_rad = radians(20.0),
            .range_min_m = 0.2,
            .range_max_m = 12.0,
            .range_bins = 256,
            .beams = 64,
            .relative_l1 = 0.03};
}

inline Samples seen(const Scene& scene, const View& view, const Pose& pose, int per_beam = 2) {
    return make_slices_engine(scene, Caster(scene), per_beam)->visible_surface(view, pose);
}

inline double area_of(const Samples& samples) {
    double area = 0.0;
    for (const Sample& sample : samples.items)
        area += sample.area_m2;
    return area;
}

}  // namespace sonarsim::test
