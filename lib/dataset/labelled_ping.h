#pragma once

#include <vector>

#include "assembly/assemble.h"
#include "labels/labels.h"
#include "mission/mission.h"
#include "ping/sonar.h"
#include "product/fan_bins.h"
#include "product/object_masks.h"

namespace sonarsim {

/// True if the mission asks for a label.
bool is_asked(const Mission& mission, Label label);

/// The labels to find for every ping of a sonar.
struct LabelPlan {
    bool on = false;  ///< the mission asks for labels
    LabelRequest request;
    bool polar_masks = false;
    bool fan_masks = false;
    FanBins fan;  ///< empty if no label is in the fan
};
LabelPlan plan_labels(const Mission& mission, const Assembly& assembly, const Sonar& sonar);

/// The labels of a ping, for all writers.
struct LabelledPing {
    PingLabels bins;
    std::vector<ObjectMask> polar;  ///< masks of the objects: rows of range, columns of beams
    std::vector<ObjectMask> fan;    ///< the same in the picture of the fan
    const FanBins* fan_bins = nullptr;
};

/// `plan` must outlive the result.
LabelledPing label_for_writers(const LabelPlan& plan, PingLabels bins);

}  // namespace sonarsim
