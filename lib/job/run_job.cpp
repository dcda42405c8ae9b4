#include "job/run_job.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assembly/engine_probes.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/ordered_pipeline.h"
#include "dataset/encode_ping.h"
#include "dataset/metadata.h"
#include "dataset/seabed_files.h"
#include "job/completion.h"
#include "job/folder.h"
#include "job/folder_lock.h"
#include "job/journal.h"
#include "job/ping_files.h"
#include "job/resume.h"
#include "trajectory/files.h"

namespace sonarsim {

namespace {

/// The result of one ping besides its files.
struct PingReport {
    PingId id;
    EncodedPing encoded;              ///< bytes for a pack; empty if the sensor has none
    std::vector<std::string> fields;  ///< for the journal
    SensorSummary summary;            ///< this ping alone
    PingSeconds seconds;
    double encode_seconds = 0.0;
    double write_seconds = 0.0;
};

PingReport report_of(const RenderedPing& rendered) {
    const auto& [id, sonar, engine, traced, ping] = rendered;
    SensorSummary summary{.pings = 1,
                          .dark_pings = ping.counts.occupied_bins == 0 ? 1U : 0U,
                          .counts = ping.counts,
                          .brightest = brightest_pixel(ping, sonar->config.name, id.pose)};
    // The estimate is NaN if the engine has none.
    summary.missed_goals = ping.estimated_l1 > sonar->settings.view.relative_l1 ? 1 : 0;
    if (!std::isnan(ping.estimated_l1)) summary.worst_l1 = ping.estimated_l1;
    if (!std::isnan(ping.missed_multipath)) summary.worst_multipath = ping.missed_multipath;
    summary.missed_multipath = summary.worst_multipath > 1.0 - least_found_multipath ? 1 : 0;
    return {.id = id, .encoded = {}, .fields = {}, .summary = summary, .seconds = ping.seconds};
}

void add(RenderSummary& summary, const PingReport& report) {
    ++summary.pings;
    summary.stages += report.seconds;
    summary.encode_seconds += report.encode_seconds;
    summary.write_seconds += report.write_seconds;
    summary.counts += report.summary.counts;
    summary.clipped_pixels += report.summary.clipped_pixels;
    summary.sensors[report.id.sensor] += report.summary;
}

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

/// The place that a run writes to.
struct Destination {
    const Layout& layout;
    const std::vector<Writers>& writers;
    PingFiles& files;
    Journal& journal;
};

/// The arguments of run_job(), and what its steps share.
struct Run {
    const Mission& mission;
    const Assembly& assembly;
    const RenderOptions& options;
    const JobCallback& progress;
    const std::atomic<bool>& stop;
    int threads;
    RenderSummary& summary;
};

/// Hands a ping to the writers of its sensor, and their output to the disk.
void write_ping(const Assembly& assembly, const Destination& to, const LabelPlan& labels,
                const RenderedPing& rendered, PingReport& report) {
    const PingId& id = report.id;
    Stopwatch watch;
    WrittenPing written = encode_ping(assembly, to.writers[id.sensor], labels, rendered);
    report.summary.clipped_pixels = written.clipped_pixels;
    report.encode_seconds = watch.lap();
    to.files.write(id, written.parts);
    const SensorLayout& sensor = to.layout.sensors[id.sensor];
    report.fields = journal_fields(sensor, written.parts);
    if (sensor.pings_per_pack > 0) report.encoded = std::move(written.parts);
    report.write_seconds = watch.lap();
}

/// Renders `todo`, several pings at a time; at most twice as many as threads are in memory. Without
/// a destination nothing is written, but labels are found.
void render(const Run& run, const std::vector<PingId>& todo, const Destination* to) {
    if (todo.empty()) return;
    const Assembly& assembly = run.assembly;
    RenderSummary& summary = run.summary;
    std::vector<LabelPlan> labels;
    for (const Sonar& sonar : assembly.sonars)
        labels.push_back(plan_labels(run.mission, assembly, sonar));
    const std::unique_ptr<VisibilityEngine> engine = make_engine(run.mission, assembly);
    Stopwatch watch;
    ordered_pipeline(
        todo.size(), 2 * static_cast<std::size_t>(run.threads), run.stop,
        [&](std::size_t i) {
            const RenderedPing rendered = render_at_pose(run.mission, assembly, *engine, todo[i]);
            PingReport report = report_of(rendered);
            const LabelPlan& plan = labels[report.id.sensor];
            if (to) {
                write_ping(assembly, *to, plan, rendered, report);
            } else if (plan.on) {
                Stopwatch labelling;
                label_bins(plan, assembly, *rendered.sonar, *rendered.engine, rendered.traced,
                           assembly.trajectory[rendered.id.pose].t_s);
                report.encode_seconds = labelling.lap();
            }
            return report;
        },
        [&](const PingReport& report) {
            add(summary, report);
            if (to) {
                Stopwatch packing;
                to->files.pack(report.id, report.encoded);
                summary.write_seconds += packing.lap();
                to->journal.add(report.id, report.fields);
            }
            if (run.progress) run.progress(summary, todo.size());
        });
    summary.seconds = watch.lap();
    summary.stopped = summary.pings < todo.size();
    for (const std::string& warning : engine->warnings())
        summary.warnings.push_back(make_warning(WarningCode::engine, "engine", warning));
}

/// Makes the folder ready for pings, and returns what it held before. A shard then admits other
/// shards; since another run may come in between, the folder is inspected once more.
FolderState set_up(const Layout& layout, const CommonFiles& common, const Mission& mission,
                   const RenderOptions& options, FolderLock& lock) {
    if (options.overwrite) remove_dataset(layout, mission);
    // Files that are not the dataset's stay in the folder; without its dataset.json it is fresh.
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
void run_in_folder(const Run& run, const std::vector<PingId>& all) {
    const Mission& mission = run.mission;
    const Assembly& assembly = run.assembly;
    const RenderOptions& options = run.options;
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
    const auto shard = [&](std::size_t i) { return shard_of(layout, all[i], i, options.shards); };
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
    // In a fresh folder as well: a run that was cut off before it had dataset.json leaves its part.
    remove_leftovers(layout, plan.todo, options.shards == 1);
    {
        PingFiles files(layout, records, *there);
        const Destination to{layout, writers, files, journal};
        render(run, plan.todo, &to);
    }
    journal.finish();
    if (summary.stopped) return;
    // Files may have been removed meanwhile: all of them are looked at once more.
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
        const Run run{mission, assembly, options, progress, stop, threads, summary};
        const std::vector<PingId> all = list_pings(mission, assembly.trajectory.size());
        if (options.files) {
            run_in_folder(run, all);
        } else {
            const auto shard = [&](std::size_t i) { return static_cast<int>(i % options.shards); };
            render(run, make_plan(all, options, shard, is_never_there).todo, nullptr);
        }
    });
    return summary;
}

RenderSummary run_job(const Mission& mission, const RenderOptions& options,
                      const JobCallback& progress, const std::atomic<bool>& stop) {
    return run_job(mission, assemble(mission), options, progress, stop);
}

}  // namespace sonarsim
