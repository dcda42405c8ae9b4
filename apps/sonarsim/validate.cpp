#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <tbb/info.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

#include "assembly/engines.h"
#include "checks/find_warnings.h"
#include "commands.h"
#include "core/clock.h"
#include "core/machine_memory.h"
#include "dataset/metadata.h"
#include "dataset/ping_metadata.h"
#include "disk.h"
#include "job/folder.h"
#include "job/ping_cost.h"
#include "job/variants.h"
#include "logging.h"
#include "mission/variants.h"
#include "mission_options.h"
#include "progress.h"
#include "survey_report.h"
#include "validation/measured_error.h"
#include "visibility/make_engine.h"

namespace sonarsim {

namespace {

struct ValidateArguments {
    MissionOptions mission;
    bool overwrite = false;
    bool strict = false;
    LogOptions log;
};

/// The sums over all variants of a mission, and what was found in the first.
struct VariantFindings {
    std::size_t variants = 0;
    std::uint64_t pings = 0;
    std::size_t images = 0;
    double bytes = 0.0;           ///< at most
    double seconds = 0.0;         ///< sum over all pings, if they cost what the first variant costs
    double expected_bytes = 0.0;  ///< sum, estimated in the same way
    double set_up_s = 0.0;        ///< sum, if all cost what the first variant costs
    std::string first;            ///< text about the first
    std::vector<Warning> warnings;
};

/// The names of FolderState.
constexpr std::array state_names{"new", "unfinished", "complete"};

/// Everything that is printed about a mission.
struct Findings {
    const Mission& mission;
    const Assembly& assembly;
    std::filesystem::path folder;
    const char* state;
    std::vector<std::size_t> pings;        ///< per sonar
    double bytes = 0.0;                    ///< at most
    std::size_t images = 0;                ///< pings with a picture, and pictures of all pings
    double set_up_s = 0.0;                 ///< before the first ping: reading, tables, the engine
    std::vector<PingCost> costs = {};      ///< per sonar
    std::vector<SonarSurvey> sonars = {};  ///< per sonar
    std::vector<std::optional<MeasuredError>> errors = {};  ///< per sonar
    std::vector<Warning> warnings = {};

    std::size_t all_pings() const { return std::reduce(pings.begin(), pings.end()); }

    /// The sum over all pings of what one costs.
    double cost(double PingCost::*part) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < pings.size(); ++i)
            sum += static_cast<double>(pings[i]) * costs[i].*part;
        return sum;
    }
    /// Wall clock of all pings if all threads are at work, without set_up_s.
    double hours() const {
        constexpr double seconds = 3600.0;
        return cost(&PingCost::seconds) / seconds / tbb::info::default_concurrency();
    }
};

nlohmann::ordered_json json_of(const Findings& f) {
    nlohmann::ordered_json sensors = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < f.pings.size(); ++i) {
        nlohmann::ordered_json sensor = {{"pings", f.pings[i]},
                                         {"seconds_per_ping", f.costs[i].seconds},
                                         {"bytes_per_ping", f.costs[i].bytes}};
        sensor["survey"] = survey_json(f.sonars[i], f.assembly.scene);
        sensor["measured_error"] = f.errors[i] ? json_of(*f.errors[i]) : nlohmann::ordered_json();
        sensors[f.assembly.sonars[i].config.name] = std::move(sensor);
    }
    nlohmann::ordered_json json{{"mission", f.mission.name},
                                {"triangles", f.assembly.scene.triangles.size()},
                                {"poses", f.assembly.trajectory.size()},
                                {"sensors", sensors},
                                {"pings", f.all_pings()},
                                {"folder", f.folder.string()},
                                {"folder_state", f.state},
                                {"images", f.images},
                                {"set_up_seconds", f.set_up_s},
                                {"hours", f.hours()},
                                {"bytes", f.cost(&PingCost::bytes)},
                                {"bytes_at_most", f.bytes},
                                {"warnings", warnings_json(f.warnings)}};
    return json;
}

std::string error_line(const std::optional<MeasuredError>& error, const Scene& scene, double goal) {
    if (!error)
        return scene.sound_profile
                   ? result_line("", "error not measured: water.profile bends the sound")
                   : "";
    const PingError& worst = error->worst();
    return result_line(
        "", fmt::format("error {:.2g} % on average and {:.2g} % at worst in {} "
                        "pings, goal {:.4g} %; noise of the reference itself {:.2g} %",
                        100.0 * error->mean(), 100.0 * worst.relative_l1, error->pings.size(),
                        100.0 * goal, 100.0 * worst.noise));
}

/// The lines about the scene, the trajectory and the sonars.
std::string text_of_parts(const Findings& f) {
    const Scene& scene = f.assembly.scene;
    const Trajectory& trajectory = f.assembly.trajectory;
    const Eigen::Vector3d extent = scene.bounds_max - scene.bounds_min;
    std::string text = result_line(
        "scene", fmt::format("{} triangles, {} materials, {} instances, "
                             "{:.1f} x {:.1f} x {:.1f} m",
                             scene.triangles.size(), scene.materials.size(), scene.instances.size(),
                             extent.x(), extent.y(), extent.z()));
    text += result_line("trajectory", fmt::format("{} poses, {:.1f} s", trajectory.size(),
                                                  trajectory.back().t_s - trajectory.front().t_s));
    if (!scene.copies.empty()) {
        text += result_line("copies", fmt::format("{} of {} shared meshes", scene.copies.size(),
                                                  scene.shared_meshes.size()));
    }
    if (!scene.bodies.empty())
        text += result_line("moving", fmt::format("{} objects", scene.bodies.size()));
    for (std::size_t i = 0; i < f.pings.size(); ++i) {
        const Sonar& sonar = f.assembly.sonars[i];
        text += result_line(sonar.config.name,
                            fmt::format("{} x {} bins, {} pings", sonar.config.range_bins,
                                        sonar.settings.view.beams, f.pings[i]));
        text += survey_text(f.sonars[i], scene);
        text += error_line(f.errors[i], scene, f.mission.accuracy.relative_l1);
    }
    return text;
}

std::string text_of(const Findings& f) {
    return result_line("mission", f.mission.name) + text_of_parts(f) +
           estimate_text(f.all_pings(), f.images, 3600.0 * f.hours(), f.set_up_s,
                         f.cost(&PingCost::bytes), f.bytes) +
           result_line("folder", fmt::format("{} ({})", f.folder.string(), f.state));
}

/// The images that a sensor leaves. A ping counts once, whatever files show it.
std::size_t count_images(const Writers& writers, std::size_t pings) {
    std::size_t images = 0;
    bool of_pings = false;
    for (const auto& writer : writers) {
        const WriterOutputs& outputs = writer.outputs;
        const auto* file = std::get_if<PingFile>(&outputs.per_ping);
        of_pings = of_pings || (file != nullptr && !file->title.empty());
        images += std::ranges::count_if(outputs.products, [](const Product& product) {
            return product.file.ends_with(".png");
        });
    }
    return of_pings ? images + pings : images;
}

/// The largest size of the files that all sensors share, and of the folders.
double common_bytes_at_most(const Mission& mission, const Assembly& assembly, const Layout& layout,
                            const nlohmann::ordered_json& description) {
    constexpr double line_bytes = 128.0;  // a line of SHA256SUMS or a pose
    double files = 0.0;
    for (const SensorLayout& sensor : layout.sensors)
        files +=
            static_cast<double>(sensor.pings * sensor.per_ping.size() + sensor.products.size());
    return on_disk(static_cast<double>(json_text(description).size())) +
           on_disk(static_cast<double>(resolved_text(mission, assembly).size())) +
           2.0 * on_disk(line_bytes * static_cast<double>(assembly.trajectory.size())) +
           2.0 * on_disk(line_bytes * files) +
           on_disk(1.0) * static_cast<double>(layout.folders().size() + 1);
}

/// Checks one mission against its folder.
Findings check_folder(const Mission& mission, const Assembly& assembly,
                      const std::vector<Writers>& writers, bool overwrite) {
    const std::size_t poses = assembly.trajectory.size();
    const Layout layout = make_layout(mission, writers, poses);
    protect_inputs(layout, mission);
    const nlohmann::ordered_json description = describe_dataset(mission, assembly, layout, writers);
    const FolderState state =
        inspect_folder(layout.folder, description, resolved_text(mission, assembly), overwrite);
    require_writable(layout.folder);
    Findings findings{mission,
                      assembly,
                      layout.folder,
                      state_names[static_cast<std::size_t>(state)],
                      count_pings(mission, poses),
                      common_bytes_at_most(mission, assembly, layout, description)};
    for (std::size_t i = 0; i < writers.size(); ++i) {
        findings.bytes += bytes_at_most(writers[i], findings.pings[i]);
        findings.images += count_images(writers[i], findings.pings[i]);
    }
    return findings;
}

/// Casts rays: surveys the mission with its sonars, finds warnings and measures the cost of pings.
void survey_mission(const Mission& mission, const Assembly& assembly,
                    const std::vector<Writers>& writers, Findings& findings) {
    const double available = std::max(0.0, machine_memory() - resident_memory());
    findings.warnings =
        memory_warnings(assembly.sonars, tbb::info::default_concurrency(), available);
    const std::unique_ptr<VisibilityEngine> rays = make_engine(assembly.scene, {});
    findings.sonars = survey(mission, assembly, *rays);
    for (Warning& warning : find_warnings(mission, assembly, findings.sonars, *rays))
        findings.warnings.push_back(std::move(warning));
    // If not even one ping has room in memory, none is made to measure its time.
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (exceeds_memory(assembly.sonars, available)) {
        findings.costs.assign(assembly.sonars.size(), {unknown, unknown});
        findings.errors.resize(assembly.sonars.size());
        return;
    }
    findings.costs = measure_pings(mission, assembly, writers, findings.set_up_s);
    findings.errors = measure_errors(mission, assembly, *make_engine(mission, assembly));
    for (Warning& warning : error_warnings(mission, findings.errors))
        findings.warnings.push_back(std::move(warning));
}

/// The variant as it is assembled to be checked. The white of a new dataset's pictures need not be
/// found, which takes as long as all else together.
Mission checked_variant(const Mission& variant) {
    Mission checked = variant;
    const bool is_new = !std::filesystem::exists(variant.output.folder);
    if (is_new && checked.output.full_scale == 0.0) checked.output.full_scale = 1.0;
    return checked;
}

/// Checks every variant, since scenes differ and each may fail for its own reasons. Casts rays only
/// in the first.
VariantFindings check_variants(const std::vector<Mission>& variants,
                               const ValidateArguments& arguments) {
    VariantFindings all;
    std::vector<PingCost> costs;
    double set_up_s = 0.0;
    SceneStore models;
    ProgressLine line(arguments.log, "variants");
    for (const Mission& variant : variants) {
        Stopwatch watch;
        const bool is_first = all.variants++ == 0;
        const Mission checked = is_first ? variant : checked_variant(variant);
        const Assembly assembly = assemble(checked, models);
        const double assemble_s = watch.lap();
        const std::vector<Writers> writers = make_writers(checked, assembly);
        Findings findings = check_folder(checked, assembly, writers, arguments.overwrite);
        if (is_first) {
            findings.set_up_s = assemble_s;
            survey_mission(variant, assembly, writers, findings);
            all.warnings = std::move(findings.warnings);
            all.first = text_of_parts(findings);
            set_up_s = findings.set_up_s;
            costs = std::move(findings.costs);
        }
        all.set_up_s += set_up_s;
        line.show(all.variants, variants.size());
        findings.costs = costs;
        all.pings += findings.all_pings();
        all.images += findings.images;
        all.bytes += findings.bytes;
        all.seconds += 3600.0 * findings.hours();
        all.expected_bytes += findings.cost(&PingCost::bytes);
    }
    return all;
}

void print_variants(const Mission& mission, const VariantFindings& all, bool as_json) {
    if (as_json) {
        fmt::print("{}", json_line({{"mission", mission.name},
                                    {"variants", all.variants},
                                    {"pings", all.pings},
                                    {"folder", mission.output.folder.string()},
                                    {"images", all.images},
                                    {"set_up_seconds", all.set_up_s},
                                    {"hours", all.seconds / 3600.0},
                                    {"bytes", all.expected_bytes},
                                    {"bytes_at_most", all.bytes},
                                    {"warnings", warnings_json(all.warnings)}}));
        return;
    }
    fmt::print("{}{}{}{}{}{}{}", result_line("mission", mission.name),
               result_line("variants", std::to_string(all.variants)),
               result_line("surveyed", variant_folder(0) + ":"), all.first,
               result_line("together", fmt::format("{} variants:", all.variants)),
               estimate_text(all.pings, all.images, all.seconds, all.set_up_s, all.expected_bytes,
                             all.bytes),
               result_line("folder", mission.output.folder.string()));
}

int validate(const ValidateArguments& arguments) {
    start_logging(arguments.log);
    const Mission mission = load(arguments.mission);
    const std::vector<Mission> variants = load_variants(arguments.mission, mission);
    if (!variants.empty()) {
        inspect_variants(mission.output.folder, describe_variants(mission, variants), variants,
                         arguments.overwrite);
        const VariantFindings all = check_variants(variants, arguments);
        if (arguments.log.prints_result()) print_variants(mission, all, arguments.log.json);
        return log_warnings(all.warnings) > 0 && arguments.strict ? exit_warned : exit_done;
    }
    Stopwatch watch;
    const Assembly assembly = assemble(mission);
    const double assemble_s = watch.lap();
    const std::vector<Writers> writers = make_writers(mission, assembly);
    Findings findings = check_folder(mission, assembly, writers, arguments.overwrite);
    findings.set_up_s = assemble_s;
    survey_mission(mission, assembly, writers, findings);
    if (arguments.log.prints_result()) {
        fmt::print("{}", arguments.log.json ? json_line(json_of(findings)) : text_of(findings));
    }
    return log_warnings(findings.warnings) > 0 && arguments.strict ? exit_warned : exit_done;
}

}  // namespace

void add_validate(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "validate",
        "Checks a mission and all it names, and looks at it through its sonars; writes nothing");
    add_examples(command,
                 {"sonarsim validate mission.yaml", "sonarsim validate mission.yaml --json",
                  "sonarsim validate mission.yaml --strict"});
    auto arguments = std::make_shared<ValidateArguments>();
    add_mission_options(command, arguments->mission);
    command.add_flag("--overwrite", arguments->overwrite, "Allow any output folder, as in render");
    command.add_flag("--strict", arguments->strict, "Exit code 3 where there is a warning");
    add_log_options(command, arguments->log);
    command.callback([arguments, &exit_code] { exit_code = validate(*arguments); });
}

}  // namespace sonarsim
