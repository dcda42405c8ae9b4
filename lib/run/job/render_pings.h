#pragma once

#include <atomic>
#include <vector>

#include "output/dataset/writer.h"
#include "run/job/journal.h"
#include "run/job/ping_files.h"
#include "run/job/render_summary.h"

namespace sonarsim {

/// A run as its steps share it.
struct RenderRun {
    const Mission& mission;
    const Assembly& assembly;
    const JobCallback& progress;
    const std::atomic<bool>& stop;
    int threads;
    RenderSummary& summary;
};

/// The place that a run writes to.
struct Destination {
    const Layout& layout;
    const std::vector<Writers>& writers;
    const RecordFiles& records;
    Journal& journal;
};

/// Renders `todo`, several pings at a time. Without a destination nothing is written, but labels
/// are found.
void render_pings(const RenderRun& run, const VisibilityEngine& engine,
                  const std::vector<PingId>& todo, const Destination* to);

}  // namespace sonarsim
