#pragma once

#include <string>
#include <vector>

#include "benchmark/report.h"

namespace sonarsim {

/// The settings of a report, from coarse to fine: rays and slices by error goal, the octree and the
/// literal octree by leaf size. Leaves finer than a quarter of the finest range bin are left out:
/// they cost much and show nothing more. The mission's own setting is among them, marked.
std::vector<Setting> make_settings(const Mission& mission, bool quick);

/// Why a setting's engine cannot see the scene or a view of its sonars, as a mission would be told;
/// empty when it can.
std::string refusal_of(const Setting& setting, const Assembly& assembly);

}  // namespace sonarsim
