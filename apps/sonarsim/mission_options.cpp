#include "mission_options.h"

#include <algorithm>
#include <array>

#include "input/mission/parse.h"
#include "simulate/assembly/mission_objects.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

MissionSource source_of(const MissionOptions& options) {
    MissionSource source{options.file, options.file.parent_path(), options.settings};
    if (!options.seed.empty()) source.overrides.push_back("seed=" + options.seed);
    if (!options.paths_from.empty()) source.base_folder = options.paths_from;
    return source;
}

/// The value of a choice that the command line has checked; `fallback` for "".
template <class T, std::size_t N>
T chosen(const std::array<Choice<T>, N>& choices, const std::string& name, T fallback) {
    const auto* const choice = std::ranges::find(choices, name, &Choice<T>::name);
    return choice == choices.end() ? fallback : choice->value;
}

}  // namespace

void add_mission_options(CLI::App& command, MissionOptions& options, MissionOutput output) {
    command.add_option("mission", options.file, "The mission, a YAML file")->required();
    command
        .add_option("--set", options.settings,
                    "Changes a key of the mission, as in sensors.fls.range_max_m=20; may be "
                    "given several times")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    command.add_option("--seed", options.seed, "Short for --set seed=N")->type_name("N");
    if (output == MissionOutput::dataset) {
        command.add_option("--out", options.out, "Output folder, instead of the mission's")
            ->check([](const std::string& folder) {
                return folder.empty() ? "the folder's name is empty" : "";
            })
            ->type_name("FOLDER");
    }
    command
        .add_option("--paths-from", options.paths_from,
                    "Where relative paths of the mission start (default: in its own folder)")
        ->type_name("FOLDER");
}

void add_threads_option(CLI::App& command, int& threads, const std::string& meaning) {
    command.add_option("-j,--threads", threads, meaning)
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
}

Mission load(const MissionOptions& options) {
    Mission mission = load_mission(source_of(options), sonar_keys());
    // Relative paths on the command line start at the current folder.
    if (!options.out.empty()) mission.output.folder = std::filesystem::absolute(options.out);
    return mission;
}

Variants load_variants(const MissionOptions& options, const Mission& mission) {
    if (mission.variants == 0) return {};
    return variants_of(mission, source_of(options));
}

MeshConfig MeshOptions::config() const {
    MeshConfig mesh;
    mesh.units = chosen(length_units, units, mesh.units);
    mesh.up = chosen(up_axes, up, mesh.up);
    mesh.up_given = !up.empty();
    return mesh;
}

void add_mesh_options(CLI::App& command, MeshOptions& options, const std::string& usual_units,
                      const std::string& usual_up) {
    command
        .add_option(
            "--units", options.units,
            "Unit of the file's lengths, as `units` of a mission (default: " + usual_units + ")")
        ->check(CLI::IsMember(names_of(length_units)));
    command
        .add_option(
            "--up", options.up,
            "Axis of the file that points up, as `up` of a mission (default: " + usual_up + ")")
        ->check(CLI::IsMember(names_of(up_axes)));
}

}  // namespace sonarsim
