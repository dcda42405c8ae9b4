#include "job/run_job.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "assembly/engines.h"
#include "core/error.h"
#include "core/file.h"
#include "dataset/dataset_file.h"
#include "dataset/metadata.h"
#include "dataset/seabed_files.h"
#include "job/completion.h"
#include "job/folder.h"
#include "job/journal.h"
#include "job/ping_files.h"
#include "job/render_pings.h"
#include "job/shard_lock.h"
#include "trajectory/files.h"
#include "validation/measured_error.h"

namespace sonarsim {

namespace {

constexpr const char* error_key = "measured_error";

/// Adds the measured error of the sonars to dataset.json: that of the folder's dataset.json, else
/// it is measured, which gives the same values in every shard. The first of several variants stands
/// for all.
void add_measured_error(const RenderRun& run, const VisibilityEngine& engine,
                        const std::filesystem::path& folder, nlohmann::ordered_json& description) {
    if (run.mission.variant.index > 0) return;
    if (std::filesystem::exists(folder / description_name)) {
        const auto found = read_description(folder);
        if (found && found->contains(error_key)) {
            description[error_key] = (*found)[error_key];
            return;
        }
    }
    const std::vector<std::optional<MeasuredError>> errors =
        measure_errors(run.mission, run.assembly, engine);
    nlohmann::ordered_json& by_sensor = description[error_key] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < errors.size(); ++i)
        by_sensor[run.mission.sensors[i].name] =
            errors[i] ? json_of(*errors[i]) : nlohmann::ordered_json();
    for (Warning& warning : error_warnings(run.mission, errors))
        run.summary.warnings.push_back(std::move(warning));
}

/// The pings of the shard that a run renders.
std::vector<PingId> pings_of_shard(const std::vector<PingId>& all, const RenderOptions& options) {
    std::vector<PingId> own;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (shard_of(i, options.shards) == options.shard) own.push_back(all[i]);
    }
    return own;
}

/// The names and bytes of the shared products that are there from the beginning.
std::vector<std::pair<std::string, std::string>> initial_files(const Assembly& assembly) {
    std::vector<std::pair<std::string, std::string>> files;
    if (assembly.seabed) files = seabed_files(*assembly.seabed);
    if (!assembly.reported.empty())
        files.emplace_back(navigation_name, write_tum(assembly.reported));
    return files;
}

/// The pings in `own` that are not finished.
std::vector<PingId> unfinished(const Layout& layout, const RecordFiles& records,
                               const std::vector<PingId>& own) {
    const FinishedPings is_finished(layout, records);
    std::vector<PingId> todo;
    for (const PingId& ping : own) {
        if (!is_finished(ping)) todo.push_back(ping);
    }
    return todo;
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
    const std::vector<PingId> own = pings_of_shard(all, options);
    const auto finished = [&](FolderState state) {
        summary.complete =
            state == FolderState::complete &&
            has_files(layout.folder, parse_description(common.description, description_name)) &&
            has_pings(layout, own);
        if (!summary.complete) return false;
        summary.skipped = own.size();
        remove_journal_parts(layout.folder);  // a run was killed at its very end
        return true;
    };
    protect_inputs(layout, mission);
    // Before the lock, which makes a file: the folder may not be ours, or the disk read-only.
    if (finished(
            inspect_folder(layout.folder, common.description, common.mission, options.overwrite)))
        return;
    ShardLock lock(layout.folder, options.shard, options.shards);
    summary.unlocked = !lock.works();
    if (options.overwrite) remove_dataset(layout.folder, mission);
    const std::unique_ptr<VisibilityEngine> engine = make_engine(mission, assembly);
    add_measured_error(run, *engine, layout.folder, common.description);
    const FolderState state = claim_folder(layout.folder, common);
    if (finished(state)) return;
    if (state == FolderState::complete) {
        write_file_durably(layout.folder / description_name, json_text(common.description));
        std::filesystem::remove(layout.folder / checksums_name);
    }
    write_common_files(layout, common);
    RecordFiles records = open_records(layout, RecordAccess::write);
    const std::vector<PingId> todo = unfinished(layout, records, own);
    summary.skipped = own.size() - todo.size();
    if (options.shards == 1) remove_leftovers(layout);
    Journal journal(lock, options.checkpoint_s);
    const Destination to{layout, writers, records, journal};
    render_pings(run, *engine, todo, &to);
    journal.finish();
    if (summary.stopped) return;
    if (has_pings(layout, all)) {
        complete_dataset(layout, writers, records, common);
        lock.finish();
        remove_journal_parts(layout.folder);
        summary.complete = true;
    } else if (!has_pings(layout, own)) {
        throw std::runtime_error(layout.folder.string() +
                                 ": files were changed or removed during the run; the same command "
                                 "run again renders what is missing");
    }
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
            render_pings(run, *make_engine(mission, assembly), pings_of_shard(all, options),
                         nullptr);
        }
    });
    return summary;
}

RenderSummary run_job(const Mission& mission, const RenderOptions& options,
                      const JobCallback& progress, const std::atomic<bool>& stop) {
    return run_job(mission, assemble(mission), options, progress, stop);
}

}  // namespace sonarsim
