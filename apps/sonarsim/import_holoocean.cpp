#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "core/error.h"
#include "core/file.h"
#include "logging.h"
#include "mission/holoocean.h"

namespace sonarsim {

namespace {

constexpr std::size_t largest_scenario = std::size_t{1} << 20;

struct ImportArguments {
    std::string scenario;
    std::string out;
    HoloOceanWorld world;
    LogOptions log;
};

void import_scenario(const ImportArguments& arguments) {
    start_logging(arguments.log);
    const ImportedMission mission = import_holoocean(
        read_file(arguments.scenario, largest_scenario), arguments.scenario, arguments.world);
    for (const std::string& warning : mission.warnings)
        spdlog::warn("{}", warning);
    if (arguments.out.empty()) {
        fmt::print("{}", mission.yaml);
        return;
    }
    if (std::filesystem::exists(arguments.out)) {
        throw InputError({arguments.out}, "is there already: name another file, or remove it");
    }
    write_file(arguments.out, mission.yaml);
}

}  // namespace

void add_import_holoocean(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "import-holoocean", "Writes a mission from the sonars and poses of a HoloOcean scenario");
    add_examples(command,
                 {"sonarsim import-holoocean scenario.json --out mission.yaml --scene hull.glb"});
    auto arguments = std::make_shared<ImportArguments>();
    command.add_option("scenario", arguments->scenario, "The scenario, a JSON file")->required();
    command.add_option("--out", arguments->out, "The mission (default: standard output)")
        ->type_name("FILE");
    command.add_option("--scene", arguments->world.scene, "The scene that the mission names")
        ->type_name("FILE");
    command
        .add_option("--materials", arguments->world.materials,
                    "The CSV of materials that the mission names; HoloOcean's own is one")
        ->type_name("FILE");
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] {
        import_scenario(*arguments);
        exit_code = exit_done;
    });
}

}  // namespace sonarsim
