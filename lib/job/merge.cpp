#include "job/merge.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "assembly/assemble.h"
#include "core/error.h"
#include "core/file.h"
#include "core/ordered_pipeline.h"
#include "core/text.h"
#include "dataset/checked_json.h"
#include "dataset/description.h"
#include "dataset/metadata.h"
#include "job/completion.h"
#include "job/folder.h"
#include "job/folder_lock.h"
#include "job/ping_files.h"
#include "job/resume.h"
#include "mission/differences.h"
#include "mission/resolved.h"
#include "sonar/kinds.h"
#include "sonar/sonar.h"
#include "trajectory/files.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t largest_common_file = std::size_t{1} << 32;

/// The files of a part other than its pings. `complete` is set to false, as at the beginning of a
/// run.
CommonFiles read_common(const fs::path& folder) {
    Json description = require_dataset(folder).json;
    description["complete"] = false;
    CommonFiles common{std::move(description),
                       read_file(folder / mission_name, largest_common_file),
                       read_file(folder / trajectory_name, largest_common_file)};
    for (const Json& product : common.description.value("products", Json::array())) {
        const auto name = product.get<std::string>();
        if (name != navigation_name && !name.starts_with(std::string(seabed_folder_name) + "/"))
            continue;
        common.initial.emplace_back(name, read_file(folder / name, largest_common_file));
    }
    return common;
}

void require_same(const fs::path& part, const CommonFiles& found, const fs::path& first,
                  const CommonFiles& expected) {
    std::string difference = difference_between(found.description, expected.description);
    if (difference == of_another_mission)
        difference += differing_keys(found.mission, expected.mission);
    if (difference.empty() &&
        (found.mission != expected.mission || found.trajectory != expected.trajectory ||
         found.initial != expected.initial))
        difference = "of this mission whose inputs or poses were changed since";
    if (difference.empty()) {
        const auto key = first_difference(found.description, expected.description);
        if (!key) return;
        difference = "whose dataset.json differs in '" + printable(*key) + "'";
    }
    throw InputError({part.string()}, "holds a dataset " + difference + ", seen from " +
                                          first.string() +
                                          "; only parts of one mission become one dataset");
}

/// The input of a dataset's products: all that the mission names except the scene.
struct MergeContext {
    Mission mission;
    Assembly assembly;
};

MergeContext read_context(const fs::path& part, const CommonFiles& common, const fs::path& out) {
    MergeContext context;
    const std::string file = (part / mission_name).string();
    context.mission = parse_resolved(common.mission, file, sonar_keys());
    const DatasetFile dataset =
        check_description(common.description, (part / description_name).string());
    if (mission_hash(context.mission, sonar_keys()) != dataset.mission_hash) {
        throw InputError({file},
                         "is not the mission that dataset.json was made of, or not by this version "
                         "of sonarsim; copy the part again, or merge with the version that "
                         "rendered it");
    }
    context.mission.output.folder = fs::absolute(out).lexically_normal();
    context.assembly.trajectory = parse_tum(common.trajectory, (part / trajectory_name).string());
    for (const SonarConfig& sensor : context.mission.sensors)
        context.assembly.sonars.push_back(
            make_sonar(sensor, context.mission.accuracy, context.mission.water));
    // The full scale of pictures was derived from the scene, which is not read here.
    for (const DescribedSensor& sensor : dataset.sensors) {
        if (sensor.full_scale <= 0.0) {
            throw InputError({(part / description_name).string()},
                             "sensor '" + sensor.name + "' has no full_scale above 0");
        }
        context.assembly.full_scales.push_back(sensor.full_scale);
    }
    if (context.assembly.full_scales.size() != context.assembly.sonars.size())
        throw InputError({(part / description_name).string()}, "lists other sensors");
    return context;
}

/// Compares dataset.json with the mission: a changed key would be copied into the result.
void require_as_made(const Json& found, const fs::path& part, const MergeContext& context,
                     const Layout& layout, const std::vector<Writers>& writers) {
    const Mission& mission = context.mission;
    Json made = {{"mission", mission.name},
                 {"seed", mission.seed},
                 {"poses", context.assembly.trajectory.size()},
                 {"sensors", describe_sensors(context.assembly, layout, writers)}};
    if (!layout.products.empty()) made["products"] = layout.products;
    for (const auto& [key, value] : made.items()) {
        const auto way = first_difference(found.value(key, Json()), value, key);
        if (!way) continue;
        throw InputError({(part / description_name).string()},
                         "'" + printable(*way) +
                             "' is not what its mission.resolved.yaml gives; copy the part again, "
                             "or render it anew");
    }
}

/// A folder that pings are taken from.
struct Part {
    /// `datasets`: number of datasets that are open at the same time.
    Part(Layout of, const fs::path& folder, std::size_t datasets) : layout(std::move(of)) {
        layout.folder = folder;
        records = open_records(layout, RecordAccess::read, datasets);
        finished = std::make_unique<FinishedPings>(layout, records);
    }

    Layout layout;
    RecordFiles records;
    std::unique_ptr<FinishedPings> finished;  ///< refers to the two above
};

/// A ping to be copied, and its source.
struct Copy {
    PingId id;
    const Part* from;
};

/// " (--shard 2/3, 3/3)" with the shards of the missing pings; empty if the journals have no
/// shards.
std::string missing_shards(const std::vector<std::unique_ptr<Part>>& parts,
                           const std::vector<std::size_t>& missing) {
    int shards = 1;
    for (const auto& part : parts) {
        for (const fs::path& file : journal_parts(part->layout.folder))
            shards = shard_of_part(file)->second;
    }
    if (shards < 2) return {};
    std::set<int> which;
    for (const std::size_t ping : missing)
        which.insert(1 + shard_of(ping, shards));
    std::string text;
    for (const int shard : which)
        text += (text.empty() ? "" : ", ") + std::to_string(shard) + "/" + std::to_string(shards);
    return " (--shard " + text + ")";
}

std::vector<Copy> plan_copies(const std::vector<PingId>& all,
                              const std::vector<std::unique_ptr<Part>>& parts,
                              const FinishedPings& there) {
    std::vector<Copy> copies;
    std::vector<std::size_t> missing;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (there(all[i])) continue;
        const auto part =
            std::ranges::find_if(parts, [&](const auto& p) { return (*p->finished)(all[i]); });
        part != parts.end() ? copies.push_back({all[i], part->get()}) : missing.push_back(i);
    }
    if (missing.empty()) return copies;
    throw InputError(std::to_string(missing.size()) + " of " + std::to_string(all.size()) +
                     " pings are in none of the parts" + missing_shards(parts, missing) +
                     ": the first is ping " + std::to_string(all[missing[0]].pose) +
                     " of sensor '" + parts[0]->layout.sensors[all[missing[0]].sensor].name +
                     "'; render what is missing, or name its folder, too");
}

/// The bytes of a ping. InputError unless they are those that the journal of its part lists.
EncodedPing verified_ping(const Copy& copy) {
    const Part& from = *copy.from;
    EncodedPing encoded = read_ping(from.layout, from.records, copy.id);
    const SensorLayout& sensor = from.layout.sensors[copy.id.sensor];
    const std::vector<std::string> found =
        journal_fields(std::array{PingToList{sensor, encoded}}).front();
    const auto differs = std::ranges::mismatch(found, from.finished->fields_of(copy.id)).in1;
    if (differs == found.end()) return encoded;
    const auto* file = std::get_if<PingFile>(&sensor.per_ping[differs - found.begin()]);
    const fs::path path =
        file ? from.layout.file(copy.id, *file) : from.layout.sensor_folder(copy.id.sensor);
    throw InputError({path.string()},
                     "differs from the journal of its part; copy the part again, or remove "
                     "the file and render that shard again");
}

/// Makes the missing pings of a dataset from those of the parts, and completes it.
void copy_pings(const std::vector<std::unique_ptr<Part>>& parts, const std::vector<PingId>& all,
                const Layout& layout, const MergeContext& context,
                const std::vector<Writers>& writers, const CommonFiles& common, int threads,
                const ProgressCallback& progress, const std::atomic<bool>& stop,
                MergeSummary& summary) {
    RecordFiles records = open_records(layout, RecordAccess::write, parts.size() + 1);
    const FinishedPings there(layout, records);
    const std::vector<Copy> copies = plan_copies(all, parts, there);
    summary.skipped = all.size() - copies.size();
    std::vector<PingId> todo;
    for (const Copy& copy : copies)
        todo.push_back(copy.id);
    std::ranges::sort(todo);
    remove_leftovers(layout, todo, true);
    constexpr double checkpoint_s = 5.0;
    Journal journal(layout.folder, journal_part(1, 1), checkpoint_s);
    ordered_pipeline(
        copies.size(), 2 * static_cast<std::size_t>(threads), stop,
        [&](std::size_t i) {
            write_ping(layout, records, copies[i].id, verified_ping(copies[i]));
            return i;
        },
        [&](std::size_t i) {
            const Copy& copy = copies[i];
            journal.add(copy.id, copy.from->finished->fields_of(copy.id));
            ++summary.pings;
            if (progress) progress(summary.pings, copies.size());
        });
    journal.finish();
    if (summary.pings < copies.size()) return;
    complete_dataset(layout, context.mission, writers, records, common);
    summary.complete = true;
}

}  // namespace

void require_apart(const std::vector<fs::path>& parts, const fs::path& out) {
    for (const fs::path& part : parts) {
        std::error_code absent;
        if (fs::equivalent(part, out, absent)) {
            throw InputError({out.string()},
                             "is one of the parts; name another folder to write to");
        }
    }
}

MergeSummary merge_datasets(const std::vector<fs::path>& folders, const fs::path& out, int threads,
                            const ProgressCallback& progress, const std::atomic<bool>& stop) {
    require_apart(folders, out);
    const CommonFiles common = read_common(folders.at(0));
    for (const fs::path& folder : folders)
        require_same(folder, read_common(folder), folders[0], common);
    const MergeContext context = read_context(folders[0], common, out);
    const std::size_t poses = context.assembly.trajectory.size();
    const std::vector<Writers> writers = make_writers(context.mission, context.assembly);
    const Layout layout = make_layout(context.mission, writers, poses);
    require_as_made(common.description, folders[0], context, layout, writers);
    std::vector<std::unique_ptr<Part>> parts;
    parts.reserve(folders.size());
    for (const fs::path& folder : folders)
        parts.push_back(std::make_unique<Part>(layout, folder, folders.size() + 1));

    protect_inputs(layout, context.mission);
    const std::vector<PingId> all = list_pings(context.mission, poses);
    // InputError for missing pings before anything is written.
    if (inspect_folder(layout, common.description, common.mission) == FolderState::fresh)
        plan_copies(all, parts, *parts[0]->finished);
    const FolderLock lock = lock_alone(layout.folder);
    MergeSummary summary{.unlocked = !lock.works()};
    if (inspect_folder(layout, common.description, common.mission) == FolderState::complete &&
        has_all(layout, all)) {
        summary.skipped = all.size();
        summary.complete = true;
        return summary;
    }
    begin_dataset(layout, common);
    on_threads(threads, [&](int n) {
        copy_pings(parts, all, layout, context, writers, common, n, progress, stop, summary);
    });
    return summary;
}

}  // namespace sonarsim
