#pragma once

#include <vector>

#include "benchmark/report.h"

namespace sonarsim {

/// The settings of a report, from coarse to fine: rays and slices by error goal, the octree and the
/// literal octree by leaf size. Leaves finer than a quarter of the finest range bin are left out:
/// they cost much and show nothing more. The mission's own setting is among them, marked.
std::vector<Setting> make_settings(const Mission& mission, bool quick);

}  // namespace sonarsim
