#include "run/preview/preview.h"

#include <spdlog/spdlog.h>

#include "commands.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "mission_options.h"
#include "output/format/png.h"
#include "run/checks/find_warnings.h"

namespace sonarsim {

namespace {

struct PreviewArguments {
    MissionOptions mission;
    std::optional<std::uint32_t> ping;
    std::filesystem::path out;   ///< "": NAME_preview.png here
    std::filesystem::path gltf;  ///< "": none
    LogOptions log;
};

/// Loads the mission, or its first variant if it has variants.
Mission load_one(const MissionOptions& options) {
    Mission mission = load(options);
    const Variants variants = load_variants(options, mission);
    if (variants.size() == 0) return mission;
    spdlog::info("{} variants: this is the first of them", variants.size());
    return variants[0];
}

int preview(const PreviewArguments& arguments) {
    if (!arguments.out.empty() && in_lower_case(arguments.out.extension().string()) != ".png")
        throw InputError({arguments.out.string()}, "is a PNG; give a name that ends with .png");
    Mission mission = load_one(arguments.mission);
    // The brightness is that of the preview's own pings: to find the dataset's takes too long.
    mission.output.full_scale = 1.0;
    const Assembly assembly = assemble(mission);
    log_warnings(reading_warnings(assembly.scene));
    const std::size_t poses = assembly.trajectory.size();
    const auto pose = arguments.ping.value_or(static_cast<std::uint32_t>(poses / 2));
    if (pose >= poses) {
        throw InputError("--ping " + std::to_string(pose) + ": the mission has the pings 0 to " +
                         std::to_string(poses - 1));
    }
    const std::filesystem::path out = arguments.out.empty()
                                          ? std::filesystem::path(mission.name + "_preview.png")
                                          : arguments.out;
    const auto [picture, beams] = draw_preview(mission, assembly, pose);
    write_picture(out, picture.pixels, picture.width);
    if (!arguments.gltf.empty()) {
        write_file(arguments.gltf, scene_gltf(assembly, pose, beams));
        spdlog::info("{}: scene, trajectory and views", arguments.gltf.string());
    }
    spdlog::info("{}: ping {} of {}", out.string(), pose, mission.name);
    return exit_done;
}

}  // namespace

void add_preview(CLI::App& app, int& exit_code) {
    auto [command, arguments] =
        add_command(app, exit_code, "preview",
                    "Draws one picture of a mission: what the sonars see, and from where", "Look",
                    {"sonarsim preview mission.yaml --ping 20"}, preview);
    add_mission_options(command, arguments.mission, MissionOutput::other);
    command
        .add_option("--ping", arguments.ping,
                    "Number of the ping, which is that of its pose (default: the middle one)")
        ->type_name("N");
    command
        .add_option("--out", arguments.out,
                    "The picture (default: NAME_preview.png in the current folder)")
        ->type_name("FILE.png");
    command
        .add_option("--gltf", arguments.gltf,
                    "Writes the scene, the trajectory and the views of the sonars, for any viewer")
        ->type_name("FILE.glb");
    add_log_options(command, arguments.log);
}

}  // namespace sonarsim
