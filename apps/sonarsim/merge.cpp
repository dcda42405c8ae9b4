#include "job/merge.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "commands.h"
#include "job/folder_lock.h"
#include "job/variants.h"
#include "logging.h"
#include "mission_options.h"
#include "progress.h"
#include "signals.h"

namespace sonarsim {

namespace {

constexpr const char* goes_on = "the same command run again goes on from there";

struct MergeArguments {
    std::vector<std::filesystem::path> folders;  ///< the parts, then the output
    int threads = 0;
    LogOptions log;

    const std::filesystem::path& out() const { return folders.back(); }
    std::vector<std::filesystem::path> parts() const {
        return {folders.begin(), folders.end() - 1};
    }
};

int merge(const MergeArguments& arguments) {
    start_logging(arguments.log);
    const std::atomic<bool>& stop =
        stop_on_signal(warning_line(arguments.log, std::string("stopped at once; ") + goes_on));
    const bool variants = read_variants(arguments.folders.front()).has_value();
    MergeSummary summary;
    {
        ProgressLine line(arguments.log, variants ? "variants" : "pings");
        const auto merge_all = variants ? merge_variants : merge_datasets;
        summary =
            merge_all(arguments.parts(), arguments.out(), arguments.threads, line.callback(), stop);
    }
    if (arguments.log.json) {
        fmt::print("{}", json_line({{"pings", summary.pings},
                                    {"skipped", summary.skipped},
                                    {"complete", summary.complete}}));
    }
    if (summary.unlocked) spdlog::warn("{}", sentence(no_locks_warning(arguments.out())));
    if (!summary.complete) {
        spdlog::warn("stopped after {} pings; {}", summary.pings, goes_on);
        return exit_signal + signal_received();
    }
    spdlog::info("{}: complete; {}", arguments.out().string(),
                 made_text(summary.pings, summary.skipped, "copied"));
    return exit_done;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "merge", "Joins the shards of one mission that were rendered into folders of their own");
    add_examples(command, {"sonarsim merge out/part1 out/part2 out/hull"});
    auto arguments = std::make_shared<MergeArguments>();
    command
        .add_option("folders", arguments->folders,
                    "The folders of the parts, then the folder to write")
        ->required()
        ->expected(2, 1'000'000)
        ->type_name("PART... OUT");
    add_threads_option(command, arguments->threads);
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = merge(*arguments); });
}

}  // namespace sonarsim
