#include "job/render_pings.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "core/clock.h"
#include "core/ordered_pipeline.h"
#include "dataset/encode_ping.h"
#include "job/turns.h"

namespace sonarsim {

namespace {

/// The result of one ping besides its files.
struct PingReport {
    PingId id;
    EncodedPing encoded;              ///< until it is summed
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

/// Hands a ping to the writers of its sensor, and their output to the disk.
void write_encoded(const Assembly& assembly, const Destination& to, const LabelPlan& labels,
                   const RenderedPing& rendered, PingReport& report) {
    const PingId& id = report.id;
    Stopwatch watch;
    WrittenPing written = encode_ping(assembly, to.writers[id.sensor], labels, rendered);
    report.summary.clipped_pixels = written.clipped_pixels;
    report.encode_seconds = watch.lap();
    write_ping(to.layout, to.records, id, written.parts);
    report.encoded = std::move(written.parts);
    report.write_seconds = watch.lap();
}

/// Finds the fields of pings in the journal. The files of all of them are summed together, which
/// takes less time.
void sum_pings(const Layout& layout, std::span<PingReport> reports) {
    if (reports.empty()) return;
    Stopwatch watch;
    std::vector<PingToList> pings;
    for (const PingReport& report : reports)
        pings.push_back({layout.sensors[report.id.sensor], report.encoded});
    std::vector<std::vector<std::string>> fields = journal_fields(pings);
    for (std::size_t k = 0; k < reports.size(); ++k) {
        reports[k].fields = std::move(fields[k]);
        reports[k].encoded.clear();
    }
    reports.back().write_seconds += watch.lap();
}

std::size_t bytes_of(const EncodedPing& encoded) {
    std::size_t bytes = 0;
    for (const std::string& part : encoded)
        bytes += part.size();
    return bytes;
}

/// The pings that a thread renders before it sums their files. More would not fit into the caches.
constexpr std::size_t pings_of_turn = 2;

/// Renders pings one at a time.
class PingRenderer {
  public:
    PingRenderer(const RenderRun& run, const VisibilityEngine& engine, const Destination* to)
        : run_(run), to_(to), engine_(engine) {
        for (const Sonar& sonar : run.assembly.sonars)
            labels_.push_back(plan_labels(run.mission, run.assembly, sonar));
    }

    /// Renders the pings of a turn, or the first of them if the run is to stop.
    std::vector<PingReport> render(std::span<const PingId> turn) const {
        constexpr std::size_t most_waiting = std::size_t{1} << 23;  // bytes to sum
        std::vector<PingReport> reports;
        std::size_t summed = 0;
        std::size_t waiting = 0;
        const auto sum_waiting = [&] {
            if (to_) sum_pings(to_->layout, std::span(reports).subspan(summed));
            summed = reports.size();
            waiting = 0;
        };
        for (const PingId& id : turn) {
            if (!reports.empty() && run_.stop) break;
            reports.push_back(render(id));
            waiting += bytes_of(reports.back().encoded);
            if (waiting > most_waiting) sum_waiting();
        }
        sum_waiting();
        return reports;
    }

  private:
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
    const Turns turns(todo.size(), to ? pings_of_turn : 1, threads);
    Stopwatch watch;
    // At most twice as many turns as threads are in memory.
    ordered_pipeline(
        turns.count(), 2 * threads, run.stop,
        [&](std::size_t turn) {
            const std::size_t begin = turns.begin(turn);
            return renderer.render(std::span(todo).subspan(begin, turns.begin(turn + 1) - begin));
        },
        [&](const std::vector<PingReport>& reports) {
            for (const PingReport& report : reports) {
                add(summary, report);
                if (to) to->journal.add(report.id, report.fields);
                if (run.progress) run.progress(summary, todo.size());
            }
        });
    summary.seconds = watch.lap();
    summary.stopped = summary.pings < todo.size();
}

}  // namespace sonarsim
