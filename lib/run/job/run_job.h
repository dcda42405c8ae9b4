#pragma once

#include <atomic>

#include "input/mission/mission.h"
#include "run/job/parallel.h"
#include "run/job/render_pings.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

struct RenderOptions {
    int threads = 0;            ///< 0: one per core
    int shard = 0;              ///< renders the pings whose index i has i % shards == shard
    int shards = 1;             ///< 1: all of them
    bool overwrite = false;     ///< replaces another dataset in the folder
    bool files = true;          ///< false: renders without writing, to measure times
    double checkpoint_s = 5.0;  ///< between checkpoints; the most that a power cut costs
};
/// InputError when the options contradict each other.
void check(const RenderOptions& options);

/// Renders a mission into its output folder.
///
/// An unfinished dataset of the same mission, inputs and program version is resumed: pings that its
/// journal lists, and whose files are there with the listed sizes, are not rendered again, and the
/// bytes come out the same. Each shard holds a lock (run/job/shard_lock.h). They may run at the
/// same time, in one folder or in folders that are merged later; whichever run finds that no ping
/// is missing makes the products and marks the dataset as complete. When `stop` becomes true, pings
/// in flight are finished. InputError when the folder holds something else and `overwrite` is off,
/// when another run writes there, or when the dataset would replace a file that the mission reads;
/// std::system_error when the disk does not take a file; std::runtime_error when files vanish while
/// the run is under way.
RenderSummary run_job(const Mission& mission, const Assembly& assembly,
                      const RenderOptions& options, const JobCallback& progress,
                      const std::atomic<bool>& stop);

}  // namespace sonarsim
