#include "job/run_job.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assembly/engine_probes.h"
#include "core/error.h"
#include "core/file.h"
#include "dataset/dataset_file.h"
#include "dataset/metadata.h"
#include "dataset/ping_metadata.h"
#include "dataset/seabed_files.h"
#include "job/completion.h"
#include "job/folder.h"
#include "job/folder_lock.h"
#include "job/journal.h"
#include "job/ping_files.h"
#include "job/render_pings.h"
#include "job/resume.h"
#include "trajectory/files.h"
#include "validation/measured_error.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* error_key = "measured_error";

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

/// Takes over the measured error that the folder's dataset.json has, if any.
void keep_measured_error(const fs::path& folder, Json& description) {
    if (!fs::exists(folder / description_name)) return;
    const std::optional<Json> found = read_description(folder);
    if (found && found->contains(error_key)) description[error_key] = (*found)[error_key];
}

/// Measures the error of the sonars and adds it to dataset.json. The first of several shards does
/// so, and the first of several variants stands for all.
void add_measured_error(const RenderRun& run, const VisibilityEngine& engine, const Layout& layout,
                        Json& description) {
    keep_measured_error(layout.folder, description);
    if (description.contains(error_key) || run.mission.variant.index > 0) return;
    const std::vector<std::optional<MeasuredError>> errors =
        measure_errors(run.mission, run.assembly, engine);
    Json& by_sensor = description[error_key] = Json::object();
    for (std::size_t i = 0; i < errors.size(); ++i)
        by_sensor[run.mission.sensors[i].name] = errors[i] ? json_of(*errors[i]) : Json();
    write_file_durably(layout.folder / description_name, json_text(description));
    for (Warning& warning : error_warnings(run.mission, errors))
        run.summary.warnings.push_back(std::move(warning));
}

/// Makes the folder ready for pings, and returns what it held before. A shard then admits other
/// shards; since another run may come in between, the folder is inspected once more.
FolderState set_up(const Layout& layout, CommonFiles& common, const Mission& mission,
                   const RenderOptions& options, FolderLock& lock) {
    if (options.overwrite) remove_dataset(layout, mission);
    // Other files stay in the folder; without dataset.json it counts as fresh.
    const FolderState state = options.overwrite
                                  ? FolderState::fresh
                                  : inspect_folder(layout, common.description, common.mission);
    keep_measured_error(layout.folder, common.description);
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
    CommonFiles common{describe_dataset(mission, assembly, layout, writers),
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
    const std::unique_ptr<VisibilityEngine> engine = make_engine(mission, assembly);
    add_measured_error(run, *engine, layout, common.description);
    {
        const Destination to{layout, writers, records, journal};
        render_pings(run, *engine, plan.todo, &to);
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
            render_pings(run, *make_engine(mission, assembly),
                         make_plan(all, options, shard, is_never_there).todo, nullptr);
        }
    });
    return summary;
}

RenderSummary run_job(const Mission& mission, const RenderOptions& options,
                      const JobCallback& progress, const std::atomic<bool>& stop) {
    return run_job(mission, assemble(mission), options, progress, stop);
}

}  // namespace sonarsim
