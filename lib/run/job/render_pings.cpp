#include "run/job/render_pings.h"

#include <string>

#include "core/clock.h"
#include "core/ordered_pipeline.h"
#include "output/dataset/encode_ping.h"

namespace sonarsim {

namespace {

/// The result of one ping besides its files.
struct PingReport {
    RenderSummary summary;  ///< this ping alone
    std::string fields;     ///< for the journal
};

/// Renders a ping, hands it to the writers of its sensor, and their output to the disk. Without a
/// destination, only labels are made of it.
PingReport run_ping(const RenderRun& run, const VisibilityEngine& engine, const LabelPlan& plan,
                    const PingId& id, const Destination* to) {
    const RenderedPing rendered = render_at_pose(run.mission, run.assembly, engine, id);
    const Ping& ping = rendered.ping;
    const float brightest = brightest_pixel(ping, rendered.sonar->config.name, id.pose);
    Stopwatch watch;
    WrittenPing written;
    PingReport report;
    RenderSummary& summary = report.summary;
    summary.pings = 1;
    summary.stages = ping.seconds;
    if (to || plan.on) {
        written =
            encode_ping(run.assembly, to ? to->writers[id.sensor] : Writers(), plan, rendered);
        summary.label_seconds = written.label_seconds;
        summary.encode_seconds = watch.lap() - written.label_seconds;
    }
    summary.counts = ping.counts;
    summary.clipped_pixels = to ? written.clipped_pixels : 0;
    summary.sensors.resize(id.sensor + 1);
    summary.sensors.back() = {.pings = 1,
                              .dark_pings = ping.counts.occupied_bins == 0 ? 1U : 0U,
                              .counts = ping.counts,
                              .clipped_pixels = summary.clipped_pixels,
                              .brightest = brightest};
    if (!to) return report;
    report.fields = write_ping(to->layout, to->records, id, written.parts);
    summary.write_seconds = watch.lap();
    return report;
}

}  // namespace

void render_pings(const RenderRun& run, const VisibilityEngine& engine,
                  const std::vector<PingId>& todo, const Destination* to) {
    if (todo.empty()) return;
    RenderSummary& summary = run.summary;
    std::vector<LabelPlan> plans;
    for (const Sonar& sonar : run.assembly.sonars)
        plans.push_back(plan_labels(run.mission, run.assembly, sonar));
    const auto threads = static_cast<std::size_t>(run.threads);
    Stopwatch watch;
    // At most twice as many pings as threads are in memory.
    std::size_t done = 0;
    ordered_pipeline(
        todo.size(), 2 * threads, run.stop,
        [&](std::size_t i) { return run_ping(run, engine, plans[todo[i].sensor], todo[i], to); },
        [&](const PingReport& report) {
            summary += report.summary;
            if (to) to->journal.add(todo[done++], report.fields);
            if (run.progress) run.progress(summary, todo.size());
        });
    summary.seconds = watch.lap();
    summary.stopped = summary.pings < todo.size();
}

}  // namespace sonarsim
