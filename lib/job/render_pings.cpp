#include "job/render_pings.h"

#include <string>

#include "core/clock.h"
#include "core/ordered_pipeline.h"
#include "dataset/encode_ping.h"

namespace sonarsim {

namespace {

/// The result of one ping besides its files.
struct PingReport {
    PingId id;
    std::string fields;     ///< for the journal
    SensorSummary summary;  ///< this ping alone
    PingSeconds seconds;
    double encode_seconds = 0.0;
    double write_seconds = 0.0;
};

PingReport report_of(const RenderedPing& rendered) {
    const auto& [id, sonar, engine, traced, ping] = rendered;
    const SensorSummary summary{.pings = 1,
                                .dark_pings = ping.counts.occupied_bins == 0 ? 1U : 0U,
                                .counts = ping.counts,
                                .brightest = brightest_pixel(ping, sonar->config.name, id.pose)};
    return {.id = id, .fields = {}, .summary = summary, .seconds = ping.seconds};
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

/// Hands a ping to the writers of its sensor, and their output to the disk.
void write_encoded(const Assembly& assembly, const Destination& to, const LabelPlan& labels,
                   const RenderedPing& rendered, PingReport& report) {
    const PingId& id = report.id;
    Stopwatch watch;
    const WrittenPing written = encode_ping(assembly, to.writers[id.sensor], labels, rendered);
    report.summary.clipped_pixels = written.clipped_pixels;
    report.encode_seconds = watch.lap();
    write_ping(to.layout, to.records, id, written.parts);
    report.fields = journal_fields(to.layout.sensors[id.sensor], written.parts);
    report.write_seconds = watch.lap();
}

/// Renders pings one at a time.
class PingRenderer {
  public:
    PingRenderer(const RenderRun& run, const VisibilityEngine& engine, const Destination* to)
        : run_(run), to_(to), engine_(engine) {
        for (const Sonar& sonar : run.assembly.sonars)
            labels_.push_back(plan_labels(run.mission, run.assembly, sonar));
    }

    PingReport render(const PingId& id) const {
        const Assembly& assembly = run_.assembly;
        const RenderedPing rendered = render_at_pose(run_.mission, assembly, engine_, id);
        PingReport report = report_of(rendered);
        const LabelPlan& plan = labels_[report.id.sensor];
        if (to_) {
            write_encoded(assembly, *to_, plan, rendered, report);
        } else if (plan.on) {
            Stopwatch labelling;
            label_bins(plan, assembly, *rendered.sonar, *rendered.engine, rendered.traced,
                       assembly.trajectory[rendered.id.pose].t_s);
            report.encode_seconds = labelling.lap();
        }
        return report;
    }

  private:
    const RenderRun& run_;
    const Destination* to_;
    const VisibilityEngine& engine_;
    std::vector<LabelPlan> labels_;
};

}  // namespace

void render_pings(const RenderRun& run, const VisibilityEngine& engine,
                  const std::vector<PingId>& todo, const Destination* to) {
    if (todo.empty()) return;
    RenderSummary& summary = run.summary;
    const PingRenderer renderer(run, engine, to);
    const auto threads = static_cast<std::size_t>(run.threads);
    Stopwatch watch;
    // At most twice as many pings as threads are in memory.
    ordered_pipeline(
        todo.size(), 2 * threads, run.stop, [&](std::size_t i) { return renderer.render(todo[i]); },
        [&](const PingReport& report) {
            add(summary, report);
            if (to) to->journal.add(report.id, report.fields);
            if (run.progress) run.progress(summary, todo.size());
        });
    summary.seconds = watch.lap();
    summary.stopped = summary.pings < todo.size();
}

}  // namespace sonarsim
