#include <spdlog/spdlog.h>

#include "commands.h"
#include "mission_options.h"
#include "run/job/dataset_folders.h"

namespace sonarsim {

namespace {

struct VerifyArguments {
    std::filesystem::path folder;
    int threads = 0;
    LogOptions log;
};

int verify(const VerifyArguments& arguments) {
    const std::atomic<bool>& stop =
        stop_on_signal(warning_line(arguments.log, "stopped at once; nothing was changed"));
    const std::filesystem::path& folder = arguments.folder;
    DatasetCheck check;
    {
        ProgressLine line(arguments.log, "files");
        check = verify_folder(folder, arguments.threads, line.callback(), stop);
    }
    for (const std::string& name : check.unknown_files)
        spdlog::warn("{}: is not a file of the dataset; it does no harm", name);
    for (const std::string& error : check.errors)
        spdlog::error("{}", error);
    if (check.stopped) {
        spdlog::warn("stopped after {} files; nothing was changed", check.files);
        return exit_code_of_signal();
    }
    if (arguments.log.json) {
        fmt::print("{}\n", json_line({{"whole", check.errors.empty()},
                                      {"files", check.files},
                                      {"bytes", check.bytes},
                                      {"errors", check.errors},
                                      {"unknown_files", check.unknown_files}}));
    }
    if (!check.errors.empty()) return exit_failed;
    spdlog::info("{}: whole; {} files, {} bytes", folder.string(), check.files, check.bytes);
    return exit_done;
}

}  // namespace

void add_verify(CLI::App& app, int& exit_code) {
    auto [command, arguments] =
        add_command(app, exit_code, "verify",
                    "Checks that a dataset is whole: every file is there and has its bytes",
                    "Check", {"sonarsim verify out/hull"}, verify);
    command.add_option("folder", arguments.folder, "The folder of the dataset")->required();
    add_threads_option(command, arguments.threads);
    add_log_options(command, arguments.log);
}

}  // namespace sonarsim
