#include <spdlog/fmt/fmt.h>

#include "commands.h"
#include "run/job/dataset_folders.h"

namespace sonarsim {

namespace {

struct StatusArguments {
    std::vector<std::filesystem::path> folders;
    LogOptions log;
};

const char* state_of(const JobStatus& status) {
    if (status.complete()) return "complete";
    return status.running ? "running" : "incomplete";
}

void print_json(const JobStatus& status) {
    Json json = {{"mission", status.mission}, {"state", state_of(status)}};
    if (status.variants > 0)
        json["variants"] = {{"done", status.complete_variants}, {"all", status.variants}};
    json["pings"] = {{"done", status.pings}, {"all", status.all_pings}};
    fmt::print("{}\n", json_line(json));
}

void print_text(const JobStatus& status) {
    const double share = status.all_pings > 0 ? 100.0 * static_cast<double>(status.pings) /
                                                    static_cast<double>(status.all_pings)
                                              : 0.0;
    print_result("mission", status.mission);
    print_result("state", state_of(status));
    if (status.variants > 0)
        print_result("variants",
                     fmt::format("{} of {} complete", status.complete_variants, status.variants));
    print_result("pings",
                 fmt::format("{} of {} ({:.1f} %)", status.pings, status.all_pings, share));
}

int status(const StatusArguments& arguments) {
    const JobStatus found = read_status(arguments.folders);
    arguments.log.json ? print_json(found) : print_text(found);
    return exit_done;
}

}  // namespace

void add_status(CLI::App& app, int& exit_code) {
    auto [command, arguments] =
        add_command(app, exit_code, "status", "Prints the progress of a job", "Check",
                    {"sonarsim status out/part1 out/part2"}, status);
    command
        .add_option("folders", arguments.folders,
                    "The folder of the dataset, or those of all its shards")
        ->required();
    add_log_options(command, arguments.log);
}

}  // namespace sonarsim
