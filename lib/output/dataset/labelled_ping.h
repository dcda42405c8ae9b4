#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "simulate/labels/labels.h"
#include "simulate/labels/object_directions.h"
#include "simulate/ping/sonar.h"
#include "simulate/product/fan.h"
#include "simulate/product/object_table.h"

namespace sonarsim {

/// World boxes around the objects; empty without triangles, and if a part moves.
std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly);

/// An object that moves as a whole.
struct MovingObject {
    std::size_t body = 0;     ///< index into Scene::bodies
    Eigen::AlignedBox3d box;  ///< box around it in its own frame
};
/// One for each object; nothing for an object that stands still or consists of several parts.
std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly);

/// Spheres around the objects of a scene whose class is not background.
struct AnnotatedObjects {
    struct Moving {
        std::size_t body;     ///< index into Scene::bodies
        ObjectSphere sphere;  ///< in the frame of the body
    };
    std::vector<ObjectSphere> still;  ///< world
    std::vector<Moving> moving;
    Eigen::AlignedBox3d surface;  ///< around all surface, world; empty if some of it moves
};

/// True if the mission asks for a label.
bool is_listed(const Mission& mission, Label label);

/// The labels to find for every ping of a sonar.
struct LabelPlan {
    bool on = false;  ///< the mission asks for labels
    LabelRequest request;
    bool objects = false;                ///< a writer needs the masks and the table of objects
    std::shared_ptr<const FanBins> fan;  ///< null if no label is in the fan
    MaskKind mask = MaskKind::outline;
    std::vector<std::uint8_t> has_shadow;  ///< shadow_ids()
    bool fan_objects = false;              ///< objects have masks and boxes in the fan, too
    /// For shadows; null without.
    std::shared_ptr<const SceneClusters> triangles;
    AnnotatedObjects annotated;  ///< empty without annotations and shadows
};
LabelPlan plan_labels(const Mission& mission, const Assembly& assembly, const Sonar& sonar);

/// The labels of a ping, for all writers.
struct LabelledPing {
    PingLabels bins;
    std::vector<ObjectMask> polar;      ///< masks of the objects: rows of range, columns of beams
    std::vector<ObjectMask> fan;        ///< the same in the picture of the fan
    const FanBins* fan_bins = nullptr;  ///< null if no label is in the fan
    std::vector<ObjectInPing> visible;  ///< sorted by id; empty if no writer needs it
};

/// The labels, masks and seen objects at the time `t_s`; `plan` must outlive the result.
LabelledPing label_for_writers(const LabelPlan& plan, const Assembly& assembly, const Sonar& sonar,
                               const VisibilityEngine& engine, const TracedPing& traced,
                               const Ping& ping, double t_s);

}  // namespace sonarsim
