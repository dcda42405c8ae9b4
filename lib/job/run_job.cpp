#include "job/run_job.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "dataset/metadata.h"
#include "dataset/seabed_files.h"
#include "job/completion.h"
#include "job/folder.h"
#include "job/folder_lock.h"
#include "job/journal.h"
#include "job/ping_files.h"
#include "job/render_pings.h"
#include "job/resume.h"
#include "trajectory/files.h"

namespace sonarsim {

namespace {

/// The pings that a run renders.
struct Plan {
    std::vector<PingId> todo;
    std::uint64_t skipped = 0;  ///< pings of this shard with all their files
};

bool is_never_there(const PingId& /*ping*/) {
    return false;
}

/// `shard(i)` is the shard of the ping with the index i in list_pings().
Plan make_plan(const std::vector<PingId>& all, const RenderOptions& options,
               const std::function<int(std::size_t)>& shard,
               const std::function<bool(const PingId&)>& is_there) {
    Plan plan;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (shard(i) != options.shard) continue;
        is_there(all[i]) ? void(++plan.skipped) : plan.todo.push_back(all[i]);
    }
    return plan;
}

/// Makes the folder ready for pings, and returns what it held before. A shard then admits other
/// shards; since another run may come in between, the folder is inspected once more.
FolderState set_up(const Layout& layout, const CommonFiles& common, const Mission& mission,
                   const RenderOptions& options, FolderLock& lock) {
    if (options.overwrite) remove_dataset(layout, mission);
    // Other files stay in the folder; without dataset.json it counts as fresh.
    const FolderState state = options.overwrite
                                  ? FolderState::fresh
                                  : inspect_folder(layout, common.description, common.mission);
    if (state != FolderState::complete) begin_dataset(layout, common);
    if (options.shards == 1) return state;
    if (!lock.share([&] { return !others_write(layout.folder, options.shards); }))
        refuse_second_run(layout.folder);
    return inspect_folder(layout, common.description, common.mission);
}

/// Completes a dataset that has all of its pings. Shards that come to their end at the same time do
/// it one after the other; those that come later find it done. Returns false when `stop` becomes
/// true while it waits.
bool complete_once(const Layout& layout, const Mission& mission,
                   const std::vector<Writers>& writers, RecordFiles& records,
                   const CommonFiles& common, FolderLock& lock, const std::atomic<bool>& stop) {
    if (!lock.take_alone([&] { return !stop; })) return false;
    const FolderState state = inspect_folder(layout, common.description, common.mission);
    if (state != FolderState::complete || !has_all(layout, {}))
        complete_dataset(layout, mission, writers, records, common);
    return true;
}

/// The names and bytes of the shared products that are there from the beginning.
std::vector<std::pair<std::string, std::string>> initial_files(const Assembly& assembly) {
    std::vector<std::pair<std::string, std::string>> files;
    if (assembly.seabed) files = seabed_files(*assembly.seabed);
    if (!assembly.reported.empty())
        files.emplace_back(navigation_name, write_tum(assembly.reported));
    return files;
}

/// Renders into the folder of the mission what is missing there, and completes the dataset.
void run_in_folder(const RenderRun& run, const RenderOptions& options,
                   const std::vector<PingId>& all) {
    const Mission& mission = run.mission;
    const Assembly& assembly = run.assembly;
    RenderSummary& summary = run.summary;
    const std::vector<Writers> writers = make_writers(mission, assembly);
    const Layout layout = make_layout(mission, writers, assembly.trajectory.size());
    const CommonFiles common{describe_dataset(mission, assembly, layout, writers),
                             resolved_text(mission, assembly), write_tum(assembly.trajectory),
                             initial_files(assembly)};
    protect_inputs(layout, mission);
    std::optional<FolderLock> lock = lock_for_run(layout.folder, options.shards, run.stop);
    summary.stopped = !lock;
    if (!lock) return;
    summary.unlocked = !lock->works();
    const FolderState state = set_up(layout, common, mission, options, *lock);
    const auto shard = [&](std::size_t i) { return shard_of(i, options.shards); };
    if (state == FolderState::complete) {
        const std::vector<PingId> own = make_plan(all, options, shard, is_never_there).todo;
        summary.complete = has_all(layout, own);
        if (summary.complete) {
            summary.skipped = own.size();
            remove_journal_parts(layout);
            return;
        }
        begin_dataset(layout, common);
    }
    Journal journal(layout.folder, journal_part(options.shard + 1, options.shards),
                    options.checkpoint_s);
    summary.unlocked = summary.unlocked || !journal.lock_works();
    RecordFiles records = open_records(layout);
    std::optional<FinishedPings> there(std::in_place, layout, records);
    const Plan plan = make_plan(all, options, shard, *there);
    summary.skipped = plan.skipped;
    // Also in a fresh folder: a run that was killed before it had dataset.json leaves a temporary
    // file.
    remove_leftovers(layout, plan.todo, options.shards == 1);
    {
        const Destination to{layout, writers, records, journal};
        render_pings(run, plan.todo, &to);
    }
    journal.finish();
    if (summary.stopped) return;
    // Files may have been removed meanwhile: check all of them again.
    require_records(records);
    // Only one copy of the journal is held at a time: with many pings it is long.
    there.emplace(layout, records);
    require_files(layout, plan.todo, *there);
    const bool all_there = std::ranges::all_of(all, *there);
    there.reset();
    if (!all_there) return;
    summary.complete = complete_once(layout, mission, writers, records, common, *lock, run.stop);
    summary.stopped = !summary.complete;
}

}  // namespace

void check(const RenderOptions& options) {
    if (options.threads < 0) throw InputError("the number of threads must not be negative");
    if (options.shards < 1 || options.shard < 0 || options.shard >= options.shards)
        throw InputError("a shard must be one of 0 to shards - 1");
    if (options.overwrite && options.shards > 1) {
        throw InputError(
            "one shard must not overwrite what another writes: remove the folder instead");
    }
}

RenderSummary run_job(const Mission& mission, const Assembly& assembly,
                      const RenderOptions& options, const JobCallback& progress,
                      const std::atomic<bool>& stop) {
    check(options);
    RenderSummary summary;
    summary.sensors.resize(assembly.sonars.size());
    on_threads(options.threads, [&](int threads) {
        const RenderRun run{mission, assembly, progress, stop, threads, summary};
        const std::vector<PingId> all = list_pings(mission, assembly.trajectory.size());
        if (options.files) {
            run_in_folder(run, options, all);
        } else {
            const auto shard = [&](std::size_t i) { return static_cast<int>(i % options.shards); };
            render_pings(run, make_plan(all, options, shard, is_never_there).todo, nullptr);
        }
    });
    return summary;
}

RenderSummary run_job(const Mission& mission, const RenderOptions& options,
                      const JobCallback& progress, const std::atomic<bool>& stop) {
    return run_job(mission, assemble(mission), options, progress, stop);
}

}  // namespace sonarsim
