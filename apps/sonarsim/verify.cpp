#include "job/verify.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "job/collection.h"
#include "job/variants.h"
#include "logging.h"
#include "progress.h"
#include "signals.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

struct VerifyArguments {
    std::filesystem::path folder;
    int threads = 0;
    LogOptions log;
};

void print_verdict(const DatasetCheck& check, bool whole) {
    const Json json = {{"whole", whole},
                       {"files", check.files},
                       {"bytes", check.bytes},
                       {"faults", check.faults},
                       {"more_faults", check.more_faults},
                       {"strangers", check.strangers}};
    fmt::print("{}", json_line(json));
}

int verify(const VerifyArguments& arguments, const std::filesystem::path& folder,
           const std::atomic<bool>& stop) {
    DatasetCheck check;
    {
        const bool variants = read_variants(folder).has_value();
        ProgressLine line(progress_of(arguments.log.quiet, arguments.log.json),
                          variants ? "variants" : "files");
        const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show(done, total); };
        check = variants ? verify_variants(folder, arguments.threads, show, stop)
                         : verify_dataset(folder, arguments.threads, show, stop);
    }
    for (const std::string& name : check.strangers)
        spdlog::warn("{}: is no file of the dataset; it does no harm", name);
    for (const std::string& fault : check.faults)
        spdlog::error("{}", fault);
    if (check.more_faults > 0) spdlog::error("and more faults, which are not listed");
    if (check.stopped) {
        spdlog::warn("stopped after {} files; nothing was changed", check.files);
        return exit_signal + signal_received();
    }
    const bool whole = check.faults.empty();
    if (arguments.log.json) print_verdict(check, whole);
    if (whole)
        spdlog::info("{}: whole; {} files, {} bytes", folder.string(), check.files, check.bytes);
    return whole ? exit_done : exit_failed;
}

/// The worst exit code of the folder's dataset, or of its datasets side by side.
int verify_all(const VerifyArguments& arguments) {
    start_logging(arguments.log);
    const std::atomic<bool>& stop =
        stop_on_signal(warning_line(arguments.log, "stopped at once; nothing was changed"));
    std::vector<std::filesystem::path> folders = collected_folders(arguments.folder);
    int worst = exit_done;
    if (folders.empty()) {
        folders.push_back(arguments.folder);
    } else {
        for (const std::string& fault : collection_faults(arguments.folder)) {
            spdlog::error("{}", fault);
            worst = exit_failed;
        }
    }
    for (const std::filesystem::path& folder : folders) {
        if (!stop) worst = std::max(worst, verify(arguments, folder, stop));
    }
    return worst;
}

}  // namespace

void add_verify(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "verify", "Checks that a dataset is whole: every file is there, opens and has its bytes");
    auto arguments = std::make_shared<VerifyArguments>();
    command.add_option("folder", arguments->folder, "The folder of the dataset")->required();
    command.add_option("-j,--threads", arguments->threads, "Threads (default: one per core)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = verify_all(*arguments); });
}

}  // namespace sonarsim
