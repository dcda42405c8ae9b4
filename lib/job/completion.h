#pragma once

#include <vector>

#include "job/folder.h"
#include "job/resume.h"
#include "mission/mission.h"

namespace sonarsim {

/// Makes the products and the checksums when every ping is there, and says so in the folder; closes
/// `records`. std::runtime_error when files vanish meanwhile; std::system_error when the disk
/// fails.
void complete_dataset(const Layout& layout, const Mission& mission,
                      const std::vector<Writers>& writers, RecordFiles& records,
                      const CommonFiles& common);

}  // namespace sonarsim
