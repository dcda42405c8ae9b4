#include "run/job/render_pings.h"

#include <sys/stat.h>

#include <algorithm>
#include <span>
#include <sstream>
#include <stdexcept>

#include "core/clock.h"
#include "core/file.h"
#include "core/hash.h"
#include "core/ordered_pipeline.h"
#include "output/dataset/encode_ping.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

/// The size of a regular file as text; "" for anything else.
std::string size_of(const fs::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return "";
    return std::to_string(status.st_size);
}

/// Writes what each writer has `encoded` of a ping where the layout says. Returns the fields in the
/// journal. From any thread, in any order. std::system_error when the disk does not take it.
std::string write_ping(const Layout& layout, const RecordFiles& records, const PingId& ping,
                       const std::vector<std::string>& encoded) {
    const SensorLayout& sensor = layout.sensors[ping.sensor];
    std::string fields;
    for (std::size_t k = 0; k < encoded.size(); ++k) {
        const std::string& bytes = encoded[k];
        if (k > 0) fields += ' ';
        if (const auto* file = std::get_if<PingFile>(&sensor.writers[k].per_ping)) {
            write_file(layout.file(ping, *file), bytes);
            fields += std::to_string(bytes.size()) + ':' + sha256(bytes);
        } else {
            records[ping.sensor][k]->write(layout.record_of(ping), std::as_bytes(std::span(bytes)));
            fields += hash_of_record(bytes);
        }
    }
    return fields;
}

/// The result of one ping besides its files.
struct PingReport {
    RenderSummary summary;  ///< this ping alone
    std::string fields;     ///< for the journal
};

/// Renders, encodes and writes a ping. Without a destination only its labels are made.
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
        written = encode_ping(run.assembly, to ? to->layout.sensors[id.sensor].writers : Writers(),
                              plan, rendered);
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

RecordFiles open_records(const Layout& layout, RecordAccess access) {
    RecordFiles files(layout.sensors.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        const SensorLayout& sensor = layout.sensors[i];
        for (const Writer& writer : sensor.writers) {
            const auto* record = std::get_if<PingRecord>(&writer.per_ping);
            files[i].push_back(
                record ? std::make_unique<RecordFile>(layout.sensor_folder(i) / record->file,
                                                      record->format, sensor.pings, access)
                       : nullptr);
        }
    }
    return files;
}

FinishedPings::FinishedPings(const Layout& layout) : layout_(layout) {
    try {
        records_ = open_records(layout, RecordAccess::read);
    } catch (const std::runtime_error&) {
        return;  // a file of records is missing or damaged, so no ping is finished
    }
    entries_ = read_journal(layout.folder);
}

bool FinishedPings::has(const PingId& ping) const {
    const auto entry = entries_.find(ping);
    if (entry == entries_.end()) return false;
    std::istringstream fields(entry->second);
    const Writers& writers = layout_.sensors[ping.sensor].writers;
    std::string field;
    for (std::size_t k = 0; k < writers.size(); ++k) {
        if (!(fields >> field)) return false;
        if (const auto* file = std::get_if<PingFile>(&writers[k].per_ping)) {
            const std::string size = size_of(layout_.file(ping, *file));
            if (size.empty() || !field.starts_with(size + ':')) return false;
        } else if (records_[ping.sensor][k]->hash(layout_.record_of(ping)) != field) {
            return false;
        }
    }
    return !(fields >> field);
}

bool FinishedPings::has_all(const std::vector<PingId>& pings) const {
    return std::ranges::all_of(pings, [this](const PingId& ping) { return has(ping); });
}

std::vector<PingId> FinishedPings::missing(std::vector<PingId> pings) const {
    std::erase_if(pings, [this](const PingId& ping) { return has(ping); });
    return pings;
}

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
