#include "job/merge.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "commands.h"
#include "job/collection.h"
#include "job/folder_lock.h"
#include "job/variants.h"
#include "logging.h"
#include "progress.h"
#include "signals.h"

namespace sonarsim {

namespace {

constexpr const char* goes_on = "the same command run again goes on from there";

struct MergeArguments {
    std::vector<std::filesystem::path> folders;  ///< the parts, and at last the one to write to
    bool different = false;
    int threads = 0;
    LogOptions log;
};

int collect(const MergeArguments& arguments, const std::atomic<bool>& stop) {
    const std::filesystem::path& out = arguments.folders.back();
    const std::vector<std::filesystem::path> parts(arguments.folders.begin(),
                                                   arguments.folders.end() - 1);
    CollectionSummary summary;
    {
        ProgressLine line(progress_of(arguments.log.quiet, arguments.log.json), "files");
        summary = collect_datasets(
            parts, out, arguments.threads,
            [&](std::uint64_t done, std::uint64_t total) { line.show(done, total); }, stop);
    }
    for (const std::string& warning : summary.warnings)
        spdlog::warn("{}", warning);
    if (arguments.log.json) {
        const nlohmann::ordered_json json = {{"files", summary.files},
                                             {"skipped", summary.skipped},
                                             {"complete", summary.complete},
                                             {"warnings", summary.warnings}};
        fmt::print("{}", json_line(json));
    }
    if (!summary.complete) {
        spdlog::warn("stopped after {} files; {}", summary.files, goes_on);
        return exit_signal + signal_received();
    }
    spdlog::info("{}: complete; {} datasets side by side", out.string(), parts.size());
    return exit_done;
}

int merge(const MergeArguments& arguments) {
    start_logging(arguments.log);
    const std::atomic<bool>& stop =
        stop_on_signal(warning_line(arguments.log, std::string("stopped at once; ") + goes_on));
    if (arguments.different) return collect(arguments, stop);
    const std::filesystem::path& out = arguments.folders.back();
    const std::vector<std::filesystem::path> parts(arguments.folders.begin(),
                                                   arguments.folders.end() - 1);
    MergeSummary summary;
    {
        const bool variants = read_variants(parts.front()).has_value();
        ProgressLine line(progress_of(arguments.log.quiet, arguments.log.json),
                          variants ? "variants" : "pings");
        const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show(done, total); };
        summary = variants ? merge_variants(parts, out, arguments.threads, show, stop)
                           : merge_datasets(parts, out, arguments.threads, show, stop);
    }
    if (arguments.log.json) {
        const nlohmann::ordered_json json = {
            {"pings", summary.pings}, {"skipped", summary.skipped}, {"complete", summary.complete}};
        fmt::print("{}", json_line(json));
    }
    if (summary.unlocked) spdlog::warn("{}", no_locks_warning(out));
    if (!summary.complete) {
        spdlog::warn("stopped after {} pings; {}", summary.pings, goes_on);
        return exit_signal + signal_received();
    }
    spdlog::info("{}: complete; {} of its pings were there already", out.string(), summary.skipped);
    return exit_done;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "merge", "Joins the shards of one mission that were rendered into folders of their own");
    auto arguments = std::make_shared<MergeArguments>();
    command
        .add_option("folders", arguments->folders,
                    "The folders of the parts, then the folder to write")
        ->required()
        ->expected(2, 1'000'000)
        ->type_name("PART... OUT");
    command.add_flag("--different", arguments->different,
                     "Puts whole datasets of different missions side by side");
    command.add_option("-j,--threads", arguments->threads, "Threads (default: one per core)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = merge(*arguments); });
}

}  // namespace sonarsim
