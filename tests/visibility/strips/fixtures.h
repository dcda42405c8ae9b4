#pragma once

#include "simulate/visibility/strips/strips_engine.h"
#include "support/test.h"

namespace sonarsim::test {

inline View fan_view() {
    return {radians(60.0), radians(20.0), 0.2, 12.0, 256, 64, 0.03};
}

inline Samples seen(const Scene& scene, const View& view, const Pose& pose = {}) {
    return StripsEngine(scene, Caster(scene)).visible_surface(view, pose);
}

inline double area_of(std::span<const Sample> samples) {
    double area = 0.0;
    for (const Sample& sample : samples)
        area += static_cast<double>(sample.area_m2);
    return area;
}

inline double area_of(const Samples& samples) {
    return area_of(std::span<const Sample>(samples.items));
}

}  // namespace sonarsim::test
