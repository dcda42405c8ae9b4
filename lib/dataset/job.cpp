#include "dataset/job.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/clock.h"
#include "core/error.h"
#include "core/file.h"
#include "core/ordered_pipeline.h"
#include "dataset/finite_image.h"
#include "dataset/folder.h"
#include "dataset/measure.h"
#include "dataset/metadata.h"
#include "dataset/ping_files.h"
#include "dataset/products.h"
#include "mission/resolved.h"
#include "product/fan.h"
#include "sonar/engine_settings.h"
#include "trajectory/files.h"

namespace sonarsim {

namespace {

/// What one ping left behind besides its files.
struct PingReport {
    std::size_t sensor;
    PingCounts counts;
    PingSeconds seconds;
    float brightest = 0.0F;
    double encode_seconds = 0.0;
    double write_seconds = 0.0;
    std::uint64_t clipped_pixels = 0;
};

void add(SensorSummary& sensor, const PingReport& report) {
    ++sensor.pings;
    sensor.dark_pings += report.counts.occupied_bins == 0;
    sensor.counts += report.counts;
    sensor.clipped_pixels += report.clipped_pixels;
    sensor.brightest = std::max(sensor.brightest, report.brightest);
}

void add(RenderSummary& summary, const PingReport& report) {
    ++summary.pings;
    summary.stages += report.seconds;
    summary.encode_seconds += report.encode_seconds;
    summary.write_seconds += report.write_seconds;
    summary.counts += report.counts;
    summary.clipped_pixels += report.clipped_pixels;
    add(summary.sensors[report.sensor], report);
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
    std::vector<PingId> others;  ///< those of other shards
    std::uint64_t skipped = 0;   ///< of this shard, with all their files
};

/// Whether a ping is there already.
using IsThere = std::function<bool(const PingId&)>;

Plan make_plan(const std::vector<PingId>& all, const RenderOptions& options,
               const IsThere& is_there) {
    Plan plan;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (static_cast<int>(i % options.shards) != options.shard) {
            plan.others.push_back(all[i]);
        } else if (is_there(all[i])) {
            ++plan.skipped;
        } else {
            plan.todo.push_back(all[i]);
        }
    }
    return plan;
}

/// Renders one ping and writes its files, if any.
using Work = std::function<PingReport(const PingId&)>;

/// Does the work for each ping, several at a time. At most twice as many pings as threads are in
/// memory.
void stream_pings(const std::vector<PingId>& todo, int threads, const Work& work,
                  const ProgressCallback& progress, const std::atomic<bool>& stop,
                  RenderSummary& summary) {
    Stopwatch watch;
    ordered_pipeline(
        todo.size(), 2 * static_cast<std::size_t>(threads), stop,
        [&](std::size_t i) { return work(todo[i]); },
        [&](const PingReport& report) {
            add(summary, report);
            if (progress) progress(summary.pings, todo.size());
        });
    summary.seconds = watch.lap();
    summary.stopped = summary.pings < todo.size();
}

/// Where a run writes to.
struct Destination {
    const Layout& layout;
    const RecordFiles& records;
};

/// What the pings of a run have in common.
struct Workshop {
    const Mission& mission;
    const Assembly& assembly;
    const VisibilityEngine& engine;
};

/// Writes the files of a ping: its record first, then the others, its metadata last.
void write_ping(const Workshop& shop, const Destination& to, const std::vector<FanMap>& fans,
                const PingId& id, const TracedPing& traced, const Ping& ping, PingReport& report) {
    const auto& [mission, assembly, engine] = shop;
    const Sonar& sonar = assembly.sonars[id.sensor];
    const Pose& T_world_vehicle = assembly.trajectory[id.pose].T_world_vehicle;
    Stopwatch watch;
    const Measurement measurement = measure(sonar, engine, T_world_vehicle, ping);
    std::array<Ping, 5> stages;
    if (to.layout.sensors[id.sensor].writes(FileKind::stages))
        stages = form_stages(traced, sonar, assembly.scene, {mission.seed, id.pose});
    const PingFiles encoded =
        encode_ping(mission, assembly, to.layout, fans, id, ping, measurement.summary, stages);
    report.encode_seconds = watch.lap();
    if (to.records[id.sensor]) {
        to.records[id.sensor]->write(to.layout.record_of(id),
                                     std::as_bytes(std::span(measurement.record)));
    }
    for (const auto& [kind, bytes] : encoded.files)
        write_file(to.layout.file(id, kind), bytes);
    report.write_seconds = watch.lap();
    report.clipped_pixels = encoded.clipped_pixels;
}

/// Renders `todo`. Without a destination nothing is written.
void render(const Mission& mission, const Assembly& assembly, const std::vector<PingId>& todo,
            const Destination* to, int threads, const ProgressCallback& progress,
            const std::atomic<bool>& stop, RenderSummary& summary) {
    if (todo.empty()) return;
    const std::unique_ptr<VisibilityEngine> engine =
        make_engine(assembly.scene, engine_settings(mission.engine, mission.octree));
    const std::vector<FanMap> fans =
        to ? make_fan_maps(mission, assembly, to->layout) : std::vector<FanMap>();
    const auto work = [&](const PingId& id) {
        const Sonar& sonar = assembly.sonars[id.sensor];
        const TracedPing traced =
            trace(sonar, assembly.scene, *engine, assembly.trajectory[id.pose].T_world_vehicle);
        const Ping ping =
            form_image(traced, sonar.settings, assembly.scene, {mission.seed, id.pose});
        PingReport report{id.sensor, ping.counts, ping.seconds,
                          brightest_pixel(ping, sonar.config.name, id.pose)};
        if (to) write_ping({mission, assembly, *engine}, *to, fans, id, traced, ping, report);
        return report;
    };
    stream_pings(todo, threads, work, progress, stop, summary);
}

}  // namespace

RenderSummary run_job(const Mission& mission, const Assembly& assembly,
                      const RenderOptions& options, const ProgressCallback& progress,
                      const std::atomic<bool>& stop) {
    check(options);
    const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(threads);
    const std::vector<PingId> all = list_pings(mission, assembly.trajectory.size());
    RenderSummary summary;
    summary.sensors.resize(assembly.sonars.size());
    const auto render_all = [&](const std::vector<PingId>& todo, const Destination* to) {
        arena.execute(
            [&] { render(mission, assembly, todo, to, threads, progress, stop, summary); });
    };
    const auto none = [](const PingId&) { return false; };
    if (!options.files) {
        render_all(make_plan(all, options, none).todo, nullptr);
        return summary;
    }

    const Layout layout = make_layout(mission, assembly.trajectory.size());
    const CommonFiles common{describe_dataset(mission, assembly, layout), resolved_yaml(mission),
                             write_tum(assembly.trajectory)};
    if (options.overwrite) remove_dataset(layout.folder);
    const FolderState state =
        options.overwrite ? FolderState::fresh : inspect_folder(layout, common.description);
    const bool fresh = state == FolderState::fresh;
    if (fresh) begin_dataset(layout, common);
    const RecordFiles records = open_records(assembly, layout);
    const auto is_there = [&](const PingId& id) {
        const auto& record = records[id.sensor];
        return layout.has(id) && (!record || record->is_written(layout.record_of(id)));
    };
    const Plan plan = make_plan(all, options, fresh ? IsThere(none) : IsThere(is_there));
    summary.skipped = plan.skipped;
    summary.complete = state == FolderState::complete && plan.todo.empty() && layout.has_products();
    if (summary.complete) return summary;

    if (!fresh) {
        begin_dataset(layout, common);
        remove_leftovers(layout, plan.todo, options.shards == 1);
    }
    const Destination to{layout, records};
    render_all(plan.todo, &to);
    summary.complete = !summary.stopped && std::ranges::all_of(plan.others, is_there);
    if (!summary.complete) return summary;
    write_products(mission, assembly, layout, records);
    for (const auto& record : records) {
        if (record) record->close();
    }
    finish_dataset(layout, common.description);
    return summary;
}

RenderSummary run_job(const Mission& mission, const RenderOptions& options,
                      const ProgressCallback& progress, const std::atomic<bool>& stop) {
    return run_job(mission, assemble(mission), options, progress, stop);
}

}  // namespace sonarsim
