#pragma once

#include "job/folder.h"
#include "job/ping_files.h"

namespace sonarsim {

/// Completes a dataset that has every ping: writes products, journal.txt and SHA256SUMS, then
/// dataset.json with `complete` set to true; closes `records`. Several shards may do it at once:
/// they write the same. std::system_error when the disk fails.
void complete_dataset(const Layout& layout, const std::vector<Writers>& writers,
                      RecordFiles& records, const CommonFiles& common);

}  // namespace sonarsim
