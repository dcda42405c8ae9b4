#include "job/status.h"

#include <spdlog/fmt/fmt.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "job/variants.h"
#include "logging.h"
#include "progress.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

struct StatusArguments {
    std::vector<std::filesystem::path> folders;
    LogOptions log;
};

const char* state_of(const JobStatus& status) {
    if (status.complete) return "complete";
    if (status.running()) return "running";
    return status.pings.done == status.pings.all ? "to be completed" : "interrupted";
}

const char* state_of(const ShardStatus& shard) {
    if (shard.running) return "running";
    if (!shard.begun) return "not begun";
    return shard.pings.done == shard.pings.all ? "done" : "interrupted";
}

/// The seconds left at this rate; nothing if the rate is 0.
std::optional<double> time_left(const PingTally& pings, double pings_per_s) {
    if (pings_per_s <= 0.0) return std::nullopt;
    return static_cast<double>(pings.all - pings.done) / pings_per_s;
}

/// The time left of the shard that takes longest.
std::optional<double> time_left(const JobStatus& status) {
    std::optional<double> longest;
    for (const ShardStatus& shard : status.shards) {
        if (!shard.running) continue;
        const std::optional<double> left = time_left(shard.pings, shard.pings_per_s);
        if (left && (!longest || *left > *longest)) longest = left;
    }
    return longest;
}

Json json_of(const PingTally& pings) {
    return {{"done", pings.done}, {"all", pings.all}};
}

Json json_of(const JobStatus& status) {
    Json json = {{"mission", status.mission},      {"state", state_of(status)},
                 {"pings", json_of(status.pings)}, {"pings_per_s", status.pings_per_s()},
                 {"seconds_left", nullptr},        {"sensors", Json::object()},
                 {"shards", Json::array()}};
    if (const std::optional<double> left = time_left(status)) json["seconds_left"] = *left;
    for (const auto& [name, pings] : status.sensors)
        json["sensors"][name] = json_of(pings);
    for (const ShardStatus& shard : status.shards) {
        json["shards"].push_back({{"shard", shard.shard},
                                  {"of", shard.shards},
                                  {"state", state_of(shard)},
                                  {"pings", json_of(shard.pings)},
                                  {"pings_per_s", shard.pings_per_s},
                                  {"seconds_since_checkpoint", shard.age_s}});
    }
    return json;
}

std::string text_of(const PingTally& pings) {
    return fmt::format("{} of {}", pings.done, pings.all);
}

std::string text_of(const ShardStatus& shard) {
    std::string text = text_of(shard.pings) + ", " + state_of(shard);
    if (!shard.running) return text;
    text += fmt::format(", {:.3g} pings/s", shard.pings_per_s);
    if (const auto left = time_left(shard.pings, shard.pings_per_s))
        text += ", " + duration_text(*left) + " left";
    return text + ", checkpoint " + duration_text(shard.age_s) + " ago";
}

std::string text_of(const JobStatus& status) {
    std::string text =
        result_line("mission", status.mission) + result_line("state", state_of(status));
    const double share = status.pings.all > 0 ? 100.0 * static_cast<double>(status.pings.done) /
                                                    static_cast<double>(status.pings.all)
                                              : 100.0;
    text += result_line("pings", fmt::format("{} ({:.1f} %)", text_of(status.pings), share));
    if (status.running())
        text += result_line("pings/s", fmt::format("{:.3g}", status.pings_per_s()));
    if (const auto left = time_left(status)) text += result_line("left", duration_text(*left));
    for (const auto& [name, pings] : status.sensors)
        text += result_line(name, text_of(pings));
    for (const ShardStatus& shard : status.shards)
        text += result_line(fmt::format("shard {}/{}", shard.shard, shard.shards), text_of(shard));
    return text;
}

void print_variants(const VariantsStatus& status, bool as_json) {
    if (as_json) {
        Json json = {{"variants", status.variants},
                     {"complete", status.complete},
                     {"under_way", Json::object()}};
        for (const auto& [name, job] : status.under_way)
            json["under_way"][name] = json_of(job);
        fmt::print("{}", json_line(json));
        return;
    }
    fmt::print("{}", result_line("variants", fmt::format("{} of {} complete", status.complete,
                                                         status.variants)));
    for (const auto& [name, job] : status.under_way)
        fmt::print("{}{}", result_line("variant", name), text_of(job));
}

int status(const StatusArguments& arguments) {
    start_logging(arguments.log);
    if (read_variants(arguments.folders.at(0))) {
        print_variants(read_variants_status(arguments.folders), arguments.log.json);
        return exit_done;
    }
    const JobStatus found = read_status(arguments.folders);
    fmt::print("{}", arguments.log.json ? json_line(json_of(found)) : text_of(found));
    return exit_done;
}

}  // namespace

void add_status(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand("status", "Prints the progress of a job");
    add_examples(command, {"sonarsim status out/part1 out/part2"});
    auto arguments = std::make_shared<StatusArguments>();
    command
        .add_option("folders", arguments->folders,
                    "The folder of the dataset, or those of all its shards")
        ->required();
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = status(*arguments); });
}

}  // namespace sonarsim
