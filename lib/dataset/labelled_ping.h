#pragma once

#include <vector>

#include "assembly/assemble.h"
#include "labels/labels.h"
#include "mission/mission.h"
#include "ping/sonar.h"
#include "product/fan_bins.h"
#include "product/object_masks.h"

namespace sonarsim {

/// Whether the mission asks for a label.
bool is_asked(const Mission& mission, Label label);

/// What is to be found of every ping of a sonar, worked out once.
struct LabelPlan {
    bool on = false;  ///< the mission asks for labels
    LabelRequest request;
    bool polar_masks = false;
    bool fan_masks = false;
    FanBins fan;  ///< empty where no label is of the fan
};
LabelPlan plan_labels(const Mission& mission, const Assembly& assembly, const Sonar& sonar);

/// What the labels of a ping are written from: found once, for all writers.
struct LabelledPing {
    PingLabels bins;
    std::vector<ObjectMask> polar;  ///< by the object of each bin: rows of range, columns of beams
    std::vector<ObjectMask> fan;    ///< the same in the picture of the fan
    const FanBins* fan_bins = nullptr;
};

/// `plan` must outlive what is returned.
LabelledPing label_for_writers(const LabelPlan& plan, PingLabels bins);

}  // namespace sonarsim
