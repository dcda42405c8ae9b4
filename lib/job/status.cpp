#include "job/status.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>

#include "core/error.h"
#include "dataset/description.h"
#include "dataset/layout.h"
#include "job/folder_lock.h"
#include "job/journal.h"
#include "job/variants.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The part of the layout from which shard_of() derives the shard of a ping.
Layout layout_of(const fs::path& folder, const DatasetFile& dataset) {
    Layout layout;
    layout.folder = folder;
    layout.poses = dataset.poses;
    for (const DescribedSensor& sensor : dataset.sensors) {
        SensorLayout own;
        own.name = sensor.name;
        own.every = static_cast<std::uint32_t>(sensor.every);
        own.pings = sensor.pings;
        layout.sensors.push_back(std::move(own));
    }
    return layout;
}

/// Calls `visit` with every ping of the dataset and its index in list_pings(). It makes no list of
/// them: dataset.json may claim more pings than fit into memory.
template <class Visit>
void for_each_ping(const Layout& layout, const Visit& visit) {
    std::size_t index = 0;
    for (std::uint32_t pose = 0; pose < layout.poses; ++pose) {
        for (std::uint32_t sensor = 0; sensor < layout.sensors.size(); ++sensor) {
            if (pose % layout.sensors[sensor].every == 0) visit(PingId{pose, sensor}, index++);
        }
    }
}

ShardStatus status_of(const fs::path& part, double now_s) {
    ShardStatus status;
    status.begun = true;
    const JournalRun run = read_journal_run(part);
    status.running = is_locked(part);
    const double seconds = run.last_s - run.first_s;
    if (seconds > 0.0) status.pings_per_s = static_cast<double>(run.pings) / seconds;
    if (run.last_s > 0.0) status.age_s = std::max(0.0, now_s - run.last_s);
    return status;
}

/// Adds the shards of one division of the job that were not begun.
std::vector<ShardStatus> with_missing(const std::vector<ShardStatus>& begun) {
    std::vector<ShardStatus> all = begun;
    std::set<int> divisions;
    for (const ShardStatus& one : begun)
        divisions.insert(one.shards);
    if (divisions.size() != 1) return all;
    for (int shard = 1; shard <= *divisions.begin(); ++shard) {
        const auto is_it = [&](const ShardStatus& one) { return one.shard == shard; };
        if (std::ranges::none_of(begun, is_it))
            all.push_back({.shard = shard, .shards = *divisions.begin(), .pings = {}});
    }
    std::ranges::sort(all, {}, &ShardStatus::shard);
    return all;
}

}  // namespace

bool JobStatus::running() const {
    return std::ranges::any_of(shards, &ShardStatus::running);
}

double JobStatus::pings_per_s() const {
    double sum = 0.0;
    for (const ShardStatus& shard : shards)
        sum += shard.running ? shard.pings_per_s : 0.0;
    return sum;
}

JobStatus read_status(const std::vector<fs::path>& folders) {
    const double now_s = seconds_since_1970();
    const DatasetFile dataset = require_dataset(folders.at(0));
    const Layout layout = layout_of(folders[0], dataset);
    JobStatus status;
    status.mission = dataset.mission;
    status.complete = dataset.complete;
    for (const SensorLayout& sensor : layout.sensors)
        status.sensors.push_back({sensor.name, {0, sensor.pings}});
    std::set<PingId> done;
    for (const fs::path& folder : folders) {
        const std::string difference =
            difference_between(require_dataset(folder).json, dataset.json);
        if (!difference.empty())
            throw InputError({folder.string()}, "holds a dataset " + difference);
        read_journal(folder).pings.for_each(
            [&](const PingId& ping, const std::vector<std::string>&) { done.insert(ping); });
    }
    std::map<std::pair<int, int>, fs::path> parts;
    for (const fs::path& folder : folders) {
        for (const fs::path& part : journal_parts(folder))
            parts.try_emplace(shard_of_part(part).value(), part);
    }
    for (const auto& [shard, part] : parts) {
        ShardStatus one = status_of(part, now_s);
        std::tie(one.shard, one.shards) = shard;
        status.shards.push_back(one);
    }
    status.shards = status.complete ? std::vector<ShardStatus>() : with_missing(status.shards);
    for_each_ping(layout, [&](const PingId& ping, std::size_t index) {
        const bool is_done = status.complete || done.contains(ping);
        ++status.pings.all;
        status.pings.done += is_done;
        status.sensors[ping.sensor].second.done += is_done;
        for (ShardStatus& shard : status.shards) {
            if (shard_of(index, shard.shards) + 1 != shard.shard) continue;
            ++shard.pings.all;
            shard.pings.done += is_done;
        }
    });
    return status;
}

VariantsStatus read_variants_status(const std::vector<fs::path>& folders) {
    VariantsStatus status;
    const std::optional<Json> json = read_variants(folders.at(0));
    for (const fs::path& folder : folders) {
        const std::optional<Json> own = read_variants(folder);
        if (!own) throw InputError({folder.string()}, "holds no variants of a sonarsim mission");
        if (*own == *json) continue;
        throw InputError({folder.string()},
                         "holds variants of another mission, seed or version of sonarsim than " +
                             folders[0].string() + variants_difference(*own, *json));
    }
    for (const fs::path& name : folders_of_variants("", *json)) {
        ++status.variants;
        std::vector<fs::path> begun;  // the folders of this variant
        for (const fs::path& folder : folders) {
            if (fs::exists(folder / name / description_name)) begun.push_back(folder / name);
        }
        if (begun.empty()) continue;
        // A variant that is complete somewhere is complete.
        std::stable_partition(begun.begin(), begun.end(), is_complete);
        JobStatus one = read_status(begun);
        if (one.complete) {
            ++status.complete;
        } else {
            status.under_way.emplace_back(name.string(), std::move(one));
        }
    }
    return status;
}

}  // namespace sonarsim
