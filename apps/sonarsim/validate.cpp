#include <spdlog/spdlog.h>
#include <tbb/info.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <limits>
#include <system_error>
#include <variant>

#include "commands.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/machine_memory.h"
#include "core/text.h"
#include "mission_options.h"
#include "run/checks/find_warnings.h"
#include "run/job/folder.h"
#include "run/job/ping_cost.h"
#include "run/job/variants.h"
#include "simulate/assembly/assemble.h"
#include "simulate/assembly/mission_objects.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/visibility/make_engine.h"
#include "survey_report.h"

namespace sonarsim {

namespace {

struct ValidateArguments {
    MissionOptions mission;
    bool overwrite = false;
    bool strict = false;
    LogOptions log;
};

/// The names of FolderState.
constexpr std::array state_names{"new", "unfinished", "complete"};

/// The images that a sensor leaves. A ping counts once, whatever files show it.
std::size_t count_images(const SensorLayout& sensor) {
    std::size_t images = 0;
    bool has_pictures = false;
    for (const Writer& writer : sensor.writers) {
        const auto* file = std::get_if<PingFile>(&writer.per_ping);
        has_pictures = has_pictures || (file != nullptr && !file->title.empty());
        images += std::ranges::count_if(
            writer.products, [](const std::string& product) { return product.ends_with(".png"); });
    }
    return has_pictures ? images + sensor.pings : images;
}

/// Everything that is printed about a mission. The lists are by sonar.
struct Findings {
    const Mission& mission;
    const Assembly& assembly;
    Layout layout;
    const char* state;
    double common_bytes;  ///< files of no single ping
    double set_up_s = 0.0;
    std::vector<PingCost> costs = {};
    std::vector<SonarSurvey> sonars = {};
    std::vector<std::optional<MeasuredError>> errors = {};
    std::vector<Warning> warnings = {};

    /// The size of the dataset if its pings cost `costs`.
    Estimate estimate() const {
        Estimate out{.set_up_s = set_up_s, .bytes = common_bytes};
        for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
            const auto count = static_cast<double>(layout.sensors[i].pings);
            out.images += count_images(layout.sensors[i]);
            out.pings += layout.sensors[i].pings;
            out.hours += count * costs[i].seconds / 3600.0 / tbb::info::default_concurrency();
            out.bytes += count * costs[i].bytes;
        }
        return out;
    }
};

/// The mission, or all its variants, as they are printed.
struct Report {          // NOLINT(bugprone-exception-escape): moving JSON throws nothing
    std::string first;   ///< text about the mission, or the first variant
    Json first_as_json;  ///< the same
    std::string state;   ///< state of its folder
    std::vector<Warning> warnings;
    Estimate estimate;  ///< sum, if all variants cost what the first costs
};

Json json_of(const Findings& f) {
    Json json{{"mission", f.mission.name},
              {"read_as", readings_of(f.mission.scene)},
              {"triangles", f.assembly.scene.triangles.size()},
              {"poses", f.assembly.trajectory.size()},
              {"folder", f.mission.output.folder.string()},
              {"folder_state", f.state},
              {"warnings", warnings_json(f.warnings)}};
    for (std::size_t i = 0; i < f.layout.sensors.size(); ++i) {
        Json& sensor = json["sensors"][f.layout.sensors[i].name];
        sensor["pings"] = f.layout.sensors[i].pings;
        sensor["seconds_per_ping"] = f.costs[i].seconds;
        sensor["bytes_per_ping"] = f.costs[i].bytes;
        sensor["survey"] = survey_json(f.sonars[i], f.assembly.scene, f.assembly.objects);
        sensor["measured_error"] = json_of(f.errors[i]);
    }
    return json;
}

/// The lines about the scene, the trajectory and the sonars.
std::string text_of(const Findings& f) {
    const Scene& scene = f.assembly.scene;
    const Trajectory& trajectory = f.assembly.trajectory;
    const Eigen::Vector3d extent = scene.bounds_max - scene.bounds_min;
    std::string text = result_line(
        "scene", fmt::format("{} triangles, {} materials, {} instances, "
                             "{:.1f} x {:.1f} x {:.1f} m",
                             scene.triangles.size(), scene.materials.size(), scene.instances.size(),
                             extent.x(), extent.y(), extent.z()));
    text += readings_text(f.mission.scene);
    text += result_line("trajectory", fmt::format("{} poses, {:.1f} s", trajectory.size(),
                                                  trajectory.back().t_s - trajectory.front().t_s));
    if (!scene.copies.empty()) {
        text += result_line("copies", fmt::format("{} of {} shared meshes", scene.copies.size(),
                                                  scene.shared_meshes.size()));
    }
    const bool has_objects = std::ranges::count(f.mission.output.labels, Label::objects) > 0;
    if (const auto name =
            has_objects ? background_by_size(f.mission, scene, f.assembly.objects) : std::nullopt) {
        text += result_line("background", fmt::format("'{}', the largest surface, is no object by "
                                                      "labels.background: [auto]; [none] keeps it",
                                                      printable(*name)));
    }
    if (!scene.bodies.empty())
        text += result_line("moving", fmt::format("{} objects", scene.bodies.size()));
    for (std::size_t i = 0; i < f.layout.sensors.size(); ++i) {
        const Sonar& sonar = f.assembly.sonars[i];
        text += result_line(sonar.config.name,
                            fmt::format("{} x {} bins, {} pings", sonar.config.range_bins,
                                        sonar.settings.view.beams, f.layout.sensors[i].pings));
        text += survey_text(f.sonars[i], scene, f.assembly.objects);
        text += error_line(f.errors[i], scene, f.mission.accuracy.relative_l1);
    }
    return text;
}

/// InputError for a folder in which nothing can be written.
void require_writable(std::filesystem::path folder) {
    std::error_code unknown;
    while (!std::filesystem::exists(folder, unknown) && folder.has_relative_path())
        folder = folder.parent_path();
    if (::access(folder.c_str(), W_OK | X_OK) == 0) return;
    throw InputError({folder.string()},
                     "cannot write to this folder: " + std::generic_category().message(errno) +
                         "; choose another output.folder (--out)");
}

/// Checks one mission against its folder.
Findings check_folder(const Mission& mission, const Assembly& assembly, bool overwrite) {
    Layout layout =
        make_layout(mission, make_writers(mission, assembly), assembly.trajectory.size());
    protect_inputs(layout, mission);
    const CommonFiles common = make_common_files(mission, assembly, layout);
    const FolderState state =
        inspect_folder(layout.folder, common.description, common.mission, overwrite);
    require_writable(layout.folder);
    return {mission, assembly, std::move(layout), state_names[static_cast<std::size_t>(state)],
            bytes_of(common)};
}

/// Casts rays: surveys the mission with its sonars, finds warnings and measures the cost of pings.
void survey_mission(Findings& findings) {
    const Mission& mission = findings.mission;
    const Assembly& assembly = findings.assembly;
    const double available = std::max(0.0, machine_memory() - resident_memory());
    findings.warnings =
        memory_warnings(assembly.sonars, tbb::info::default_concurrency(), available);
    const std::unique_ptr<VisibilityEngine> rays = make_engine(assembly.scene, {});
    findings.sonars = survey(mission, assembly, *rays);
    append(findings.warnings, find_warnings(mission, assembly, findings.sonars, *rays));
    // If not even one ping has room in memory, none is made to measure its time.
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (!memory_warnings(assembly.sonars, 1, available).empty()) {
        findings.costs.assign(assembly.sonars.size(), {unknown, unknown});
        findings.errors.resize(assembly.sonars.size());
        return;
    }
    findings.costs = measure_pings(mission, assembly, findings.layout, findings.set_up_s);
    findings.errors = measure_errors(mission, assembly, *make_engine(mission, assembly));
    append(findings.warnings, error_warnings(mission, findings.errors));
}

/// Without the white of a new dataset's pictures, which takes as long to find as all else.
Mission checked_variant(const Mission& variant) {
    Mission checked = variant;
    const bool is_new = !std::filesystem::exists(variant.output.folder);
    if (is_new && checked.output.full_scale == 0.0) checked.output.full_scale = 1.0;
    return checked;
}

/// Checks a mission or every variant, each of which may fail. Casts rays only in the first.
Report check(const Mission& mission, const Variants& variants, const ValidateArguments& arguments) {
    Report report;
    std::vector<PingCost> costs;
    double set_up_s = 0.0;
    SceneStore models;
    models.announce = [](const std::string& what) { spdlog::info("{}", what); };
    std::optional<ProgressLine> line;
    if (variants.size() > 0) line.emplace(arguments.log, "variants");
    for (int i = 0; i < std::max(variants.size(), 1); ++i) {
        Stopwatch watch;
        const Mission one = variants.size() > 0 ? variants[i] : mission;
        const Mission checked = i == 0 ? one : checked_variant(one);
        const Assembly assembly = assemble(checked, models);
        models.announce = nullptr;  // the other variants take as long
        const double assemble_s = watch.lap();
        Findings findings = check_folder(checked, assembly, arguments.overwrite);
        if (i == 0) {
            findings.set_up_s = assemble_s;
            survey_mission(findings);
            report = {text_of(findings), json_of(findings), findings.state, findings.warnings, {}};
            set_up_s = findings.set_up_s;
            costs = findings.costs;
        }
        if (line) line->show(i + 1, variants.size());
        findings.set_up_s = set_up_s;
        findings.costs = costs;
        report.estimate += findings.estimate();
    }
    return report;
}

Json json_of(const Report& report, const Mission& mission, int variants) {
    Json json = report.first_as_json;
    if (variants > 0) {
        json = {{"mission", mission.name},
                {"variants", variants},
                {"folder", mission.output.folder.string()},
                {"warnings", warnings_json(report.warnings)}};
    }
    describe_estimate(report.estimate, json);
    return json;
}

std::string text_of(const Report& report, const Mission& mission, int variants) {
    const std::string folder = mission.output.folder.string();
    const std::string text = result_line("mission", mission.name);
    const std::string estimate = estimate_text(report.estimate);
    if (variants == 0)
        return text + report.first + estimate +
               result_line("folder", folder + " (" + report.state + ")");
    return text + result_line("variants", std::to_string(variants)) +
           result_line("surveyed", variant_folder(0) + ":") + report.first +
           result_line("together", fmt::format("{} variants:", variants)) + estimate +
           result_line("folder", folder);
}

int validate(const ValidateArguments& arguments) {
    const Mission mission = load(arguments.mission);
    const Variants variants = load_variants(arguments.mission, mission);
    const int count = variants.size();
    if (count > 0)
        inspect_variants(mission.output.folder, describe_variants(mission, variants), variants,
                         arguments.overwrite);
    const Report report = check(mission, variants, arguments);
    if (arguments.log.json)
        fmt::print("{}\n", json_line(json_of(report, mission, count)));
    else if (arguments.log.prints_result())
        fmt::print("{}", text_of(report, mission, count));
    return log_warnings(report.warnings) > 0 && arguments.strict ? exit_warned : exit_done;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
    auto [command, arguments] =
        add_command(app, exit_code, "validate",
                    "Checks a mission and all it names, and looks at it "
                    "through its sonars; leaves no files",
                    "Check",
                    {"sonarsim validate mission.yaml", "sonarsim validate mission.yaml --json",
                     "sonarsim validate mission.yaml --strict"},
                    validate);
    add_mission_options(command, arguments.mission);
    command.add_flag("--overwrite", arguments.overwrite, "Allow any output folder, as in render");
    command.add_flag("--strict", arguments.strict, "Exit code 3 where there is a warning");
    add_log_options(command, arguments.log);
}

}  // namespace sonarsim
