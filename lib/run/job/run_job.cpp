#include "run/job/run_job.h"

#include <memory>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "run/checks/measured_error.h"
#include "run/job/folder.h"
#include "run/job/journal.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr const char* error_key = "measured_error";

/// Adds the measured error of the sonars to dataset.json: that of the folder's, else measured, with
/// the same values in every shard. The first of several variants stands for all.
void add_measured_error(const RenderRun& run, const VisibilityEngine& engine,
                        const fs::path& folder, Json& description) {
    if (run.mission.variant.index > 0) return;
    if (fs::exists(folder / description_name)) {
        const auto found = read_description(folder);
        if (found && found->contains(error_key)) {
            description[error_key] = (*found)[error_key];
            return;
        }
    }
    const std::vector<std::optional<MeasuredError>> errors =
        measure_errors(run.mission, run.assembly, engine);
    Json& by_sensor = description[error_key] = Json::object();
    for (std::size_t i = 0; i < errors.size(); ++i)
        by_sensor[run.mission.sensors[i].name] = json_of(errors[i]);
    append(run.summary.warnings, error_warnings(run.mission, errors));
}

/// The pings of the shard that a run renders.
std::vector<PingId> pings_of_shard(const std::vector<PingId>& all, const RenderOptions& options) {
    std::vector<PingId> own;
    for (auto i = static_cast<std::size_t>(options.shard); i < all.size(); i += options.shards)
        own.push_back(all[i]);
    return own;
}

/// The sums of the pings' files in the journal, by the name of the file in the dataset.
std::map<std::string, std::string> ping_sums(const Layout& layout, const JournalEntries& entries) {
    std::map<std::string, std::string> sums;
    for (const auto& [ping, entry] : entries) {
        if (ping.sensor >= layout.sensors.size()) continue;  // a line that somebody has added
        std::istringstream fields(entry);
        std::string field;
        for (const Writer& writer : layout.sensors[ping.sensor].writers) {
            fields >> field;
            if (const auto* file = std::get_if<PingFile>(&writer.per_ping))
                sums.emplace(layout.file(ping, *file).lexically_relative(layout.folder).string(),
                             field.substr(field.find(':') + 1));
        }
    }
    return sums;
}

/// SHA256SUMS for `sha256sum -c`: every other file; dataset.json is to be `text`, written later.
std::string checksums(const Layout& layout, const JournalEntries& entries,
                      const DatasetFile& dataset, const std::string& text) {
    std::map<std::string, std::string> known = ping_sums(layout, entries);
    known[description_name] = sha256(text);
    std::string lines;
    for (const std::string& name : list_files(dataset)) {
        const auto sum = known.find(name);
        lines += sum != known.end() ? sum->second : sha256_of_file(layout.folder / name);
        lines += "  " + name + '\n';
    }
    return lines;
}

/// Writes products, journal.txt, SHA256SUMS, then dataset.json with `complete`; closes `records`.
/// Several shards may do it at once: they write the same. std::system_error when the disk fails.
void complete_dataset(const Layout& layout, RecordFiles& records, const CommonFiles& common) {
    for (std::size_t i = 0; i < records.size(); ++i) {
        for (std::size_t k = 0; k < records[i].size(); ++k) {
            const Writer& writer = layout.sensors[i].writers[k];
            if (!records[i][k]) {
                remove_leftovers(layout.sensor_folder(i) /
                                 std::get<PingFile>(writer.per_ping).name);
                continue;
            }
            if (writer.write_products)
                writer.write_products(*records[i][k], layout.sensor_folder(i));
            records[i][k]->close();
        }
    }
    const JournalEntries entries = read_journal(layout.folder);
    write_journal(layout.folder / journal_name, entries);
    // dataset.json says `complete` only after everything else is durable.
    sync_file_system(layout.folder);
    Json finished = common.description;
    finished["complete"] = true;
    const std::string text = json_text(finished);
    write_file(layout.folder / checksums_name,
               checksums(layout, entries, parse_description(finished, description_name), text));
    sync_file_system(layout.folder);
    write_file_durably(layout.folder / description_name, text);
}

/// Renders into the folder of the mission what is missing there, and completes the dataset.
void run_in_folder(const RenderRun& run, const RenderOptions& options,
                   const std::vector<PingId>& all) {
    const Mission& mission = run.mission;
    const Assembly& assembly = run.assembly;
    RenderSummary& summary = run.summary;
    const Layout layout =
        make_layout(mission, make_writers(mission, assembly), assembly.trajectory.size());
    CommonFiles common = make_common_files(mission, assembly, layout);
    const std::vector<PingId> own = pings_of_shard(all, options);
    const auto finished = [&](FolderState state) {
        summary.complete =
            state == FolderState::complete &&
            has_files(layout.folder, parse_description(common.description, description_name)) &&
            FinishedPings(layout).has_all(own);
        if (!summary.complete) return false;
        summary.skipped = own.size();
        tidy(layout.folder, common.description);  // a run was killed at its very end
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
        fs::remove(layout.folder / checksums_name);
    }
    write_common_files(layout, common);
    RecordFiles records = open_records(layout, RecordAccess::write);
    const std::vector<PingId> todo = FinishedPings(layout).missing(own);
    summary.skipped = own.size() - todo.size();
    if (options.shards == 1) remove_leftovers(layout.folder, common.description);
    Journal journal(lock, options.checkpoint_s);
    const Destination to{layout, records, journal};
    render_pings(run, *engine, todo, &to);
    journal.finish();
    if (summary.stopped) return;
    const FinishedPings now(layout);
    if (now.has_all(all)) {
        complete_dataset(layout, records, common);
        lock.remove_parts();
        if (options.shards > 1) tidy(layout.folder, common.description);  // others were killed
        summary.complete = true;
    } else if (!now.has_all(own)) {
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

}  // namespace sonarsim
