#include "job/run_job.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assembly/engine_at.h"
#include "assembly/engine_probes.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/ordered_pipeline.h"
#include "dataset/encode_ping.h"
#include "dataset/finite_image.h"
#include "dataset/metadata.h"
#include "job/completion.h"
#include "job/folder.h"
#include "job/folder_lock.h"
#include "job/journal.h"
#include "job/ping_files.h"
#include "job/resume.h"
#include "sonar/sonar_at_pose.h"
#include "trajectory/files.h"

namespace sonarsim {

namespace {

/// What one ping left behind besides its files.
struct PingReport {
    PingId id;
    EncodedPing encoded;             ///< to be packed; empty where nothing is
    std::vector<std::string> words;  ///< for the journal
    PingCounts counts;
    PingSeconds seconds;
    float brightest = 0.0F;
    double encode_seconds = 0.0;
    double write_seconds = 0.0;
    std::uint64_t clipped_pixels = 0;
    double estimated_l1 = 0.0;  ///< NaN when the engine has no estimate
    double goal_l1 = 0.0;
};

void add(SensorSummary& sensor, const PingReport& report) {
    ++sensor.pings;
    sensor.dark_pings += report.counts.occupied_bins == 0;
    sensor.counts += report.counts;
    sensor.clipped_pixels += report.clipped_pixels;
    sensor.brightest = std::max(sensor.brightest, report.brightest);
    if (std::isnan(report.estimated_l1)) return;
    sensor.missed_goals += report.estimated_l1 > report.goal_l1;
    sensor.worst_l1 = std::max(sensor.worst_l1, report.estimated_l1);
}

void add(RenderSummary& summary, const PingReport& report) {
    ++summary.pings;
    summary.stages += report.seconds;
    summary.encode_seconds += report.encode_seconds;
    summary.write_seconds += report.write_seconds;
    summary.counts += report.counts;
    summary.clipped_pixels += report.clipped_pixels;
    add(summary.sensors[report.id.sensor], report);
}

void check(const RenderOptions& options) {
    if (options.threads < 0) throw InputError("the number of threads must not be negative");
    if (options.shards < 1 || options.shard < 0 || options.shard >= options.shards) {
        throw InputError("a shard must be one of 0 to shards - 1");
    }
    if (options.overwrite && options.shards > 1) {
        throw InputError(
            "one shard must not overwrite what another writes: remove the folder instead");
    }
}

/// Which pings a run renders.
struct Plan {
    std::vector<PingId> todo;
    std::uint64_t skipped = 0;  ///< of this shard, with all their files
};

/// The pings whose index in list_pings() is i are in shard `shard_of(i)`.
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

/// Where a run writes to.
struct Destination {
    const Layout& layout;
    const std::vector<Writers>& writers;
    PingFiles& files;
    Journal& journal;
};

/// Hands a ping to the writers of its sensor and what they make of it to the disk.
void write_ping(const Assembly& assembly, const VisibilityEngine& engine, const Destination& to,
                const LabelPlan& labels, const Sonar& sonar, const TracedPing& traced,
                const Ping& ping, PingReport& report) {
    const PingId& id = report.id;
    Stopwatch watch;
    WrittenPing written =
        encode_ping(assembly, engine, to.writers[id.sensor], labels, id, sonar, traced, ping);
    report.clipped_pixels = written.clipped_pixels;
    report.encode_seconds = watch.lap();
    to.files.write(id, written.parts);
    const SensorLayout& sensor = to.layout.sensors[id.sensor];
    report.words = journal_words(sensor, written.parts);
    if (sensor.pings_per_pack > 0) report.encoded = std::move(written.parts);
    report.write_seconds = watch.lap();
}

/// Renders `todo`, several pings at a time; at most twice as many as threads are in memory. Without
/// a destination nothing is written, but what `labels`, by sensor, ask for is found.
void render(const Mission& mission, const Assembly& assembly, const std::vector<LabelPlan>& labels,
            const std::vector<PingId>& todo, const Destination* to, int threads,
            const JobCallback& progress, const std::atomic<bool>& stop, RenderSummary& summary) {
    if (todo.empty()) return;
    const std::unique_ptr<VisibilityEngine> engine =
        make_engine(assembly.scene, engine_settings(mission, assembly));
    Stopwatch watch;
    ordered_pipeline(
        todo.size(), 2 * static_cast<std::size_t>(threads), stop,
        [&](std::size_t i) {
            const PingId& id = todo[i];
            const SonarAtPose at_pose(mission, assembly.sonars[id.sensor], id.pose);
            const Sonar& sonar = *at_pose;
            const TimedPose& pose = assembly.trajectory[id.pose];
            const std::vector<Sight> sights_of_ping =
                sights(sonar.settings.view, sonar.settings.guard_beams,
                       sensor_pose(sonar, pose.T_world_vehicle, id.pose));
            const std::shared_ptr<const VisibilityEngine> now =
                engine_at(*engine, assembly.motions, pose.t_s, sights_of_ping);
            const TracedPing traced =
                trace(sonar, assembly.scene, *now, pose.T_world_vehicle, id.pose);
            const Ping ping =
                form_image(traced, sonar.settings, assembly.scene, {mission.seed, id.pose});
            PingReport report{.id = id,
                              .encoded = {},
                              .words = {},
                              .counts = ping.counts,
                              .seconds = ping.seconds,
                              .brightest = brightest_pixel(ping, sonar.config.name, id.pose),
                              .estimated_l1 = ping.estimated_l1,
                              .goal_l1 = sonar.settings.view.relative_l1};
            const LabelPlan& plan = labels[id.sensor];
            if (to) {
                write_ping(assembly, *now, *to, plan, sonar, traced, ping, report);
            } else if (plan.on) {
                Stopwatch labelling;
                label_ping(traced, sonar.settings, assembly.scene, assembly.objects, *now,
                           plan.request);
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
                to->journal.add(report.id, report.words);
            }
            if (progress) progress(summary, todo.size());
        });
    summary.seconds = watch.lap();
    summary.stopped = summary.pings < todo.size();
    summary.warnings = engine->warnings();
}

/// Makes the folder ready for pings, and says what it held before. A shard then lets others in; as
/// another run may come in between, the folder is looked at once more.
FolderState set_up(const Layout& layout, const CommonFiles& common, const Mission& mission,
                   const RenderOptions& options, FolderLock& lock) {
    if (options.overwrite) remove_dataset(layout, mission);
    // Files that are not the dataset's stay in the folder; without its dataset.json it is fresh.
    const FolderState state =
        options.overwrite ? FolderState::fresh : inspect_folder(layout, common.description);
    if (state != FolderState::complete) begin_dataset(layout, common);
    if (options.shards == 1) return state;
    if (!lock.share([&] { return !others_write(layout.folder, options.shards); }))
        refuse_second_run(layout.folder);
    return inspect_folder(layout, common.description);
}

/// Completes a dataset that has all of its pings. Shards that come to their end at the same time do
/// it one after the other; those that come later find it done. Returns false when `stop` becomes
/// true while it waits.
bool complete_once(const Layout& layout, const Mission& mission,
                   const std::vector<Writers>& writers, RecordFiles& records,
                   const CommonFiles& common, FolderLock& lock, const std::atomic<bool>& stop) {
    if (!lock.take_alone([&] { return !stop; })) return false;
    const FolderState state = inspect_folder(layout, common.description);
    if (state != FolderState::complete || !has_all(layout, {}))
        complete_dataset(layout, mission, writers, records, common);
    return true;
}

}  // namespace

RenderSummary run_job(const Mission& mission, const Assembly& assembly,
                      const RenderOptions& options, const JobCallback& progress,
                      const std::atomic<bool>& stop) {
    check(options);
    const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(threads);
    const std::vector<PingId> all = list_pings(mission, assembly.trajectory.size());
    RenderSummary summary;
    summary.sensors.resize(assembly.sonars.size());
    std::vector<LabelPlan> labels;
    for (const Sonar& sonar : assembly.sonars)
        labels.push_back(plan_labels(mission, assembly, sonar));
    const auto render_all = [&](const std::vector<PingId>& todo, const Destination* to) {
        arena.execute(
            [&] { render(mission, assembly, labels, todo, to, threads, progress, stop, summary); });
    };
    if (!options.files) {
        const auto shard = [&](std::size_t i) { return static_cast<int>(i % options.shards); };
        const auto none = [](const PingId&) { return false; };
        render_all(make_plan(all, options, shard, none).todo, nullptr);
        return summary;
    }

    const std::vector<Writers> writers = make_writers(mission, assembly);
    const Layout layout = make_layout(mission, writers, assembly.trajectory.size());
    const CommonFiles common{describe_dataset(mission, assembly, layout, writers),
                             resolved_text(mission, assembly), write_tum(assembly.trajectory)};
    protect_inputs(layout, mission);
    std::optional<FolderLock> lock = lock_for_run(layout.folder, options.shards, stop);
    if (!lock) {
        summary.stopped = true;
        return summary;
    }
    summary.unlocked = !lock->works();
    const FolderState state = set_up(layout, common, mission, options, *lock);
    const auto shard = [&](std::size_t i) { return shard_of(layout, all[i], i, options.shards); };
    if (state == FolderState::complete) {
        const auto none = [](const PingId&) { return false; };
        const std::vector<PingId> own = make_plan(all, options, shard, none).todo;
        summary.complete = has_all(layout, own);
        if (summary.complete) {
            summary.skipped = own.size();
            remove_journal_parts(layout);
            return summary;
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
        render_all(plan.todo, &to);
    }
    journal.finish();
    if (summary.stopped) return summary;
    // What was there, or written by this run, may be gone by now: all of it is looked at once more.
    require_records(records);
    // The journal is held once at a time: of many pings it is long.
    there.emplace(layout, records);
    require_files(layout, plan.todo, *there);
    const bool all_there = std::ranges::all_of(all, *there);
    there.reset();
    if (!all_there) return summary;
    summary.complete = complete_once(layout, mission, writers, records, common, *lock, stop);
    summary.stopped = !summary.complete;
    return summary;
}

RenderSummary run_job(const Mission& mission, const RenderOptions& options,
                      const JobCallback& progress, const std::atomic<bool>& stop) {
    return run_job(mission, assemble(mission), options, progress, stop);
}

}  // namespace sonarsim
