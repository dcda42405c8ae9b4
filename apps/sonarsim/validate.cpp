#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <system_error>

#include "commands.h"
#include "core/text.h"
#include "dataset/folder.h"
#include "dataset/metadata.h"
#include "logging.h"
#include "mission_options.h"

namespace sonarsim {

namespace {

struct ValidateArguments {
    MissionOptions mission;
    bool overwrite = false;
    LogOptions log;
};

/// The folder may not be there yet: what counts is the nearest one above it that is.
void check_writable(std::filesystem::path folder) {
    while (!std::filesystem::exists(folder) && folder.has_relative_path())
        folder = folder.parent_path();
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw std::system_error(errno, std::generic_category(),
                                "cannot write to " + folder.string());
    }
}

/// What the variants of a mission come to together.
struct VariantFindings {
    std::size_t variants = 0;
    std::uint64_t pings = 0;
    double bytes = 0.0;
};

/// What a mission comes to.
struct Findings {
    const Mission& mission;
    const Assembly& assembly;
    std::filesystem::path folder;
    const char* state;
    std::vector<std::size_t> pings;  ///< per sonar
    double bytes = 0.0;

    std::size_t all_pings() const { return std::reduce(pings.begin(), pings.end()); }
};

const char* state_text(FolderState state) {
    switch (state) {
        case FolderState::fresh:
            return "new";
        case FolderState::unfinished:
            return "unfinished";
        case FolderState::complete:
            return "complete";
    }
    return "";
}

nlohmann::ordered_json json_of(const Findings& f) {
    nlohmann::ordered_json sensors = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < f.pings.size(); ++i) {
        sensors[f.assembly.sonars[i].config.name] = {{"pings", f.pings[i]}};
    }
    return {{"mission", f.mission.name},
            {"triangles", f.assembly.scene.triangles.size()},
            {"poses", f.assembly.trajectory.size()},
            {"sensors", sensors},
            {"pings", f.all_pings()},
            {"folder", f.folder.string()},
            {"folder_state", f.state},
            {"bytes_at_most", f.bytes}};
}

std::string text_of(const Findings& f) {
    const Scene& scene = f.assembly.scene;
    const Trajectory& trajectory = f.assembly.trajectory;
    const Eigen::Vector3d extent = scene.bounds_max - scene.bounds_min;
    const auto line = [](std::string_view head, const std::string& rest) {
        return fmt::format("{:<12}{}\n", head, printable(rest));
    };
    std::string text = line("mission", f.mission.name);
    text += line("scene", fmt::format("{} triangles, {} materials, {} instances, "
                                      "{:.1f} x {:.1f} x {:.1f} m",
                                      scene.triangles.size(), scene.materials.size(),
                                      scene.instances.size(), extent.x(), extent.y(), extent.z()));
    text += line("trajectory", fmt::format("{} poses, {:.1f} s", trajectory.size(),
                                           trajectory.back().t_s - trajectory.front().t_s));
    if (!scene.copies.empty()) {
        text += line("copies", fmt::format("{} of {} shared meshes", scene.copies.size(),
                                           scene.shared_meshes.size()));
    }
    if (!scene.bodies.empty())
        text += line("moving", fmt::format("{} objects", scene.bodies.size()));
    for (std::size_t i = 0; i < f.pings.size(); ++i) {
        const Sonar& sonar = f.assembly.sonars[i];
        text +=
            line(sonar.config.name, fmt::format("{} x {} bins, {} pings", sonar.config.range_bins,
                                                sonar.settings.view.beams, f.pings[i]));
    }
    text +=
        line("dataset", fmt::format("{} pings, at most {:.1f} MB", f.all_pings(), 1e-6 * f.bytes));
    return text + line("folder", fmt::format("{} ({})", f.folder.string(), f.state));
}

/// Checks one mission against its folder.
Findings find_out(const Mission& mission, const Assembly& assembly, bool overwrite) {
    const std::size_t poses = assembly.trajectory.size();
    const std::vector<Writers> writers = make_writers(mission, assembly);
    const Layout layout = make_layout(mission, writers, poses);
    protect_inputs(layout, mission);
    const FolderState state =
        overwrite ? FolderState::fresh
                  : inspect_folder(layout, describe_dataset(mission, assembly, layout, writers));
    check_writable(layout.folder);
    Findings findings{mission, assembly, layout.folder, state_text(state),
                      count_pings(mission, poses)};
    for (std::size_t i = 0; i < writers.size(); ++i)
        findings.bytes += bytes_at_most(writers[i], findings.pings[i]);
    return findings;
}

/// Checks every variant. Their scenes differ, and each may fail for reasons of its own.
VariantFindings check_variants(const std::vector<Mission>& variants, bool overwrite) {
    VariantFindings all;
    SceneFiles models;
    for (const Mission& variant : variants) {
        const Assembly assembly = assemble(variant, models);
        if (all.variants++ == 0) warn_about(assembly.scene);
        const Findings findings = find_out(variant, assembly, overwrite);
        all.pings += findings.all_pings();
        all.bytes += findings.bytes;
    }
    return all;
}

void print_variants(const Mission& mission, const VariantFindings& all, bool as_json) {
    if (as_json) {
        fmt::print("{}", json_line({{"mission", mission.name},
                                    {"variants", all.variants},
                                    {"pings", all.pings},
                                    {"folder", mission.output.folder.string()},
                                    {"bytes_at_most", all.bytes}}));
        return;
    }
    fmt::print("{:<12}{}\n{:<12}{}\n{:<12}{} pings, at most {:.1f} MB\n{:<12}{}\n", "mission",
               printable(mission.name), "variants", all.variants, "dataset", all.pings,
               1e-6 * all.bytes, "folder", mission.output.folder.string());
}

int validate(const ValidateArguments& arguments) {
    start_logging(arguments.log);
    const Mission mission = load(arguments.mission);
    const std::vector<Mission> variants = load_variants(arguments.mission, mission);
    if (!variants.empty()) {
        const VariantFindings all = check_variants(variants, arguments.overwrite);
        if (!arguments.log.quiet) print_variants(mission, all, arguments.log.json);
        return exit_done;
    }
    const Assembly assembly = assemble(mission);
    warn_about(assembly.scene);
    const Findings findings = find_out(mission, assembly, arguments.overwrite);
    if (!arguments.log.quiet) {
        fmt::print("{}", arguments.log.json ? json_line(json_of(findings)) : text_of(findings));
    }
    return exit_done;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
    CLI::App& command =
        *app.add_subcommand("validate", "Checks a mission and all it names; renders nothing");
    auto arguments = std::make_shared<ValidateArguments>();
    add_mission_options(command, arguments->mission);
    command.add_flag("--overwrite", arguments->overwrite, "Allow any output folder, as in render");
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = validate(*arguments); });
}

}  // namespace sonarsim
