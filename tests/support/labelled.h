#pragma once

#include "simulate/labels/labels.h"
#include "simulate/visibility/make_engine.h"
#include "support/sonars.h"

namespace sonarsim::test {

inline constexpr std::array engine_types{EngineKind::rays, EngineKind::slices};
inline constexpr LabelRequest everything{.objects = true,
                                         .shares = true,
                                         .classes = true,
                                         .materials = true,
                                         .elevation = true,
                                         .shadow = true};

/// A scene, its labels and the image without noise.
struct Labelled {
    SceneObjects objects;
    PingLabels labels;
    Ping clean;

    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * labels.range_bins + i;
    }
};

inline Labelled label(const Scene& scene, const Sonar& sonar, const Pose& pose, EngineKind type) {
    const auto engine = make_engine(scene, {.type = type, .octree = {}});
    const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
    Labelled out;
    out.objects = group_objects(scene, {});
    out.labels = label_ping(traced, sonar.settings, scene, out.objects, *engine, everything);
    out.clean = form_image(traced, sonar.settings, scene, {}, without_random_terms);
    return out;
}

}  // namespace sonarsim::test
