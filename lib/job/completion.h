#pragma once

#include <vector>

#include "job/folder.h"
#include "job/resume.h"
#include "mission/mission.h"

namespace sonarsim {

/// Completes a dataset that has every ping: writes products, journal.txt and SHA256SUMS, then
/// dataset.json with `complete` set to true, and removes the parts of the journal; closes
/// `records`. std::runtime_error when files vanish meanwhile; std::system_error when the disk
/// fails.
void complete_dataset(const Layout& layout, const Mission& mission,
                      const std::vector<Writers>& writers, RecordFiles& records,
                      const CommonFiles& common);

}  // namespace sonarsim
