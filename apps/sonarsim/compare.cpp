#include "compare/compare.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <string>

#include "commands.h"
#include "compare/plot.h"
#include "compare/report.h"
#include "core/error.h"
#include "core/file.h"
#include "logging.h"
#include "recording/read_recording.h"

namespace sonarsim {

namespace {

struct CompareArguments {
    std::filesystem::path real;
    std::filesystem::path simulated;
    std::filesystem::path out;
    RecordingOptions of_real;
    RecordingOptions of_simulated;
    LogOptions log;
};

void write_comparison(const Comparison& comparison, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    write_file(folder / "compare.json", comparison_json(comparison).dump(2) + "\n");
    write_file(folder / "compare.svg", comparison_svg(comparison));
    spdlog::info("{}: compare.json and compare.svg", folder.string());
}

void compare_files(const CompareArguments& arguments) {
    start_logging(arguments.log);
    if (!arguments.out.empty() && std::filesystem::exists(arguments.out / "compare.json"))
        throw InputError({arguments.out.string()},
                         "holds a comparison already: name another folder, or remove it");
    const Recording real = load_recording(arguments.real, arguments.of_real);
    const Recording simulated = load_recording(arguments.simulated, arguments.of_simulated);
    const Comparison comparison = compare_recordings(real, simulated);
    if (arguments.log.json) {
        fmt::print("{}", json_line(comparison_json(comparison)));
    } else if (arguments.log.prints_result()) {
        fmt::print("{}", comparison_text(comparison));
    }
    if (!arguments.out.empty()) write_comparison(comparison, arguments.out);
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
    CLI::App& command =
        *app.add_subcommand("compare", "Compares simulated pings with real ones, figure by figure");
    add_examples(command, {"sonarsim compare real_pings out/tank_calibrated --out compared",
                           "sonarsim compare real_pings out/survey --sensor fls --pings 100"});
    auto arguments = std::make_shared<CompareArguments>();
    command
        .add_option("real", arguments->real,
                    "The real pings: a folder with recording.yaml, or a dataset")
        ->required();
    command.add_option("simulated", arguments->simulated, "The simulated pings: the same")
        ->required();
    command.add_option("--out", arguments->out, "A folder for compare.json and compare.svg")
        ->type_name("FOLDER");
    command
        .add_option("--sensor", arguments->of_simulated.sensor,
                    "The sensor of the simulated dataset, if it has several")
        ->type_name("NAME");
    command
        .add_option("--real-sensor", arguments->of_real.sensor,
                    "The same of the real pings, if these are a dataset")
        ->type_name("NAME");
    command
        .add_option("--pings", arguments->of_simulated.most_pings,
                    "Reads only the first so many pings of each; default: all")
        ->check(CLI::Range(1, 1 << 20))
        ->type_name("N");
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] {
        arguments->of_real.most_pings = arguments->of_simulated.most_pings;
        compare_files(*arguments);
        exit_code = exit_done;
    });
}

}  // namespace sonarsim
