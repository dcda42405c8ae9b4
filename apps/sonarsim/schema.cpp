#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

#include "commands.h"
#include "mission/json_schema.h"
#include "sonar/kinds.h"

namespace sonarsim {

void add_schema(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "schema", "Prints the JSON Schema of a mission, for editors that complete and check");
    command.callback([&exit_code] {
        fmt::print("{}\n", mission_json_schema(sonar_keys()).dump(1));
        exit_code = exit_done;
    });
}

}  // namespace sonarsim
