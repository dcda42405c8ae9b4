#include <spdlog/spdlog.h>

#include "commands.h"
#include "run/checks/warning.h"
#include "run/job/dataset_folders.h"

namespace sonarsim {

namespace {

constexpr const char* run_again = "run the same command again to continue";

struct MergeArguments {
    std::vector<std::filesystem::path> folders;  ///< the parts, then the output
    LogOptions log;
};

int merge(const MergeArguments& arguments) {
    const std::atomic<bool>& stop =
        stop_on_signal(warning_line(arguments.log, std::string("stopped at once; ") + run_again));
    std::vector<std::filesystem::path> parts = arguments.folders;
    parts.pop_back();
    const std::string out = arguments.folders.back().string();
    MergeSummary summary;
    {
        ProgressLine line(arguments.log, "datasets");
        summary = merge_parts(parts, out, line.callback(), stop);
    }
    if (arguments.log.json) {
        fmt::print("{}\n", json_line({{"pings", summary.pings},
                                      {"skipped", summary.skipped},
                                      {"missing", summary.missing},
                                      {"complete", summary.complete}}));
    }
    if (summary.unlocked) spdlog::warn("{}", sentence(make_warning(WarningCode::no_locks, out)));
    if (summary.stopped) {
        spdlog::warn("stopped after {} pings; {}", summary.pings, run_again);
        return exit_code_of_signal();
    }
    const std::string made = made_text(summary.pings, summary.skipped, "copied");
    if (summary.complete) {
        spdlog::info("{}: complete; {}", out, made);
    } else {
        spdlog::info("{}: {}, {} are missing; sonarsim render MISSION --out {} completes it", out,
                     made, summary.missing, out);
    }
    return exit_done;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
    auto [command, arguments] = add_command(app, exit_code, "merge",
                                            "Copies the shards of one mission into one folder, "
                                            "which sonarsim render then completes",
                                            "Make",
                                            {"sonarsim merge out/part1 out/part2 out/hull",
                                             "sonarsim render mission.yaml --out out/hull"},
                                            merge);
    command
        .add_option("folders", arguments.folders,
                    "The folders of the parts, then the folder to write")
        ->required()
        ->expected(2, 1'000'000)
        ->type_name("PART... OUT");
    add_log_options(command, arguments.log);
}

}  // namespace sonarsim
