#include "mission_options.h"

#include "core/error.h"
#include "dataset/layout.h"
#include "mission/parse.h"
#include "sonar/kinds.h"

namespace sonarsim {

void add_mission_options(CLI::App& command, MissionOptions& options) {
    command.add_option("mission", options.file, "The mission, a YAML file")->required();
    command
        .add_option("--set", options.settings,
                    "Changes a key of the mission, as in sensors.fls.noise.add_sigma=0.2; "
                    "may be given again and again")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    command.add_option("--seed", options.seed, "Short for --set seed=N")->type_name("N");
    command.add_option("--out", options.out, "Output folder, instead of the mission's")
        ->type_name("FOLDER");
    command
        .add_option("--paths-from", options.paths_from,
                    "Where relative paths of the mission start (default: in its own folder)")
        ->type_name("FOLDER");
}

Mission load(const MissionOptions& options) {
    std::vector<std::string> settings = options.settings;
    if (!options.seed.empty()) settings.push_back("seed=" + options.seed);
    const std::filesystem::path own_folder = options.file.parent_path();
    Mission mission =
        load_mission(options.file, options.paths_from.empty() ? own_folder : options.paths_from,
                     settings, sonar_keys());
    if (options.paths_from.empty() && !std::filesystem::exists(mission.scene.file) &&
        std::filesystem::exists(own_folder / description_name)) {
        throw InputError({options.file.string()},
                         "belongs to a dataset, and its paths start at the folder of the scene "
                         "file; say which that is with --paths-from FOLDER");
    }
    // On the command line a path starts here, in the mission at the mission's folder.
    if (!options.out.empty()) mission.output.folder = std::filesystem::absolute(options.out);
    return mission;
}

}  // namespace sonarsim
