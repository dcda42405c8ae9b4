#include "benchmark/report.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <set>

#include "benchmark/cold_start.h"
#include "benchmark/label_rows.h"
#include "benchmark/multipath_rows.h"
#include "benchmark/report_files.h"
#include "benchmark/report_text.h"
#include "benchmark/scaling.h"
#include "benchmark/settings.h"
#include "benchmark/timed_pings.h"
#include "checks/find_warnings.h"
#include "commands.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "logging.h"
#include "mission_options.h"
#include "validation/hard/cases.h"

namespace sonarsim {

namespace {

struct ReportArguments {
    MissionOptions mission;
    std::filesystem::path json_file;
    ReportOptions report;
    bool quick = false;
    bool scale = false;
    bool hard = false;
    std::string hard_name;
    std::vector<std::string> engines;
    std::size_t most_triangles = 5'000'000;
    LogOptions log;
};

void write_files(const Report& report, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    write_file(folder / "report.json", report_json(report));
    write_file(folder / "report.csv", report_csv(report));
    if (!report.multipath.empty()) write_file(folder / "multipath.csv", multipath_csv(report));
    write_file(folder / "report.md", report_markdown(report));
}

/// The catalogue of hard cases, which needs no mission.
int report_hard(const ReportArguments& arguments) {
    start_logging(arguments.log);
    std::vector<HardResult> results;
    bool all_hold = true;
    for (const HardCase& hard : hard_cases()) {
        if (hard.name.find(arguments.hard_name) == std::string::npos) continue;
        spdlog::info("{}", hard.name);
        for (HardResult& result : run_hard_case(hard)) {
            all_hold = all_hold && (result.holds() || !result.known_fault.empty());
            results.push_back(std::move(result));
        }
    }
    if (results.empty())
        throw InputError("--hard: no case has '" + printable(arguments.hard_name) +
                         "' in its name");
    fmt::print("{}", hard_table(results));
    return all_hold ? exit_done : exit_failed;
}

/// The mission without the water's echoes, which no engine finds, and with one sample per range
/// bin, since several samples do not add up.
Mission without_water_echoes(Mission mission) {
    mission.water.content = WaterContent::none;
    mission.water.scattering_db_per_m3.reset();
    mission.water.suspended_mg_l.reset();
    mission.water.layers.clear();
    for (SonarConfig& sensor : mission.sensors)
        sensor.instrument.receiver.samples = 1;
    return mission;
}

/// The settings to measure: the requested engines that support the mission's scene.
std::vector<Setting> settings_of(const ReportArguments& arguments, const Mission& mission,
                                 const Assembly& assembly) {
    std::vector<Setting> settings = make_settings(mission, arguments.quick);
    std::set<std::string> refusals;
    std::erase_if(settings, [&](const Setting& setting) {
        if (!arguments.engines.empty() &&
            std::ranges::find(arguments.engines, setting.engine) == arguments.engines.end())
            return true;
        const std::string refusal = unsupported(setting, assembly);
        if (refusal.empty()) return false;
        if (refusals.insert(refusal).second) spdlog::info("left out: {}", refusal);
        return true;
    });
    if (settings.empty()) {
        throw InputError({arguments.mission.file.string()},
                         refusals.empty()
                             ? "--engines: no setting of these engines suits the range "
                               "bins of this mission; add another engine"
                             : *refusals.begin());
    }
    return settings;
}

int report(const ReportArguments& arguments) {
    if (arguments.hard) return report_hard(arguments);
    if (arguments.mission.file.empty()) throw CLI::RequiredError("mission");
    const double start = seconds_now();
    start_logging(arguments.log);
    const Mission mission = without_water_echoes(load(arguments.mission));
    if (mission.variants > 0) {
        throw InputError({arguments.mission.file.string()},
                         "the report measures one scene, and this mission has variants; give it "
                         "the mission.resolved.yaml of one of them, or --set variants=0 --set "
                         "vary=[]");
    }
    const Assembly assembly = assemble(mission);
    if (!assembly.scene.bodies.empty()) {
        throw InputError({arguments.mission.file.string()},
                         "the report measures scenes that stand still; leave the trajectories of "
                         "objects out");
    }
    if (assembly.scene.sound_profile) {
        throw InputError({arguments.mission.file.string()},
                         "the report measures straight paths of sound; leave water.profile out");
    }
    const double assembled_s = seconds_now() - start;
    log_warnings(reading_warnings(assembly.scene));

    ReportOptions options = arguments.report;
    if (arguments.quick) {
        options.poses = std::min(options.poses, 3);
        options.rounds = 2;
        options.reference_moved = 0.005;
        options.reference_rays = std::min(options.reference_rays, std::uint64_t{50'000'000});
    }
    const auto progress = [](const std::string& what) { spdlog::info("{}", what); };
    const std::vector<Setting> settings = settings_of(arguments, mission, assembly);
    progress("each setting in a process of its own");
    const std::vector<ColdStart> cold =
        measure_cold_starts(mission, assembly, settings, options, assembled_s);
    Report result = make_report(mission, assembly, settings, cold, options, progress);
    result.multipath = measure_multipath(mission, assembly, options, progress);
    result.labels = measure_labels(mission, assembly, options, progress);
    if (arguments.scale) {
        result.growth =
            measure_growth(mission, assembly, arguments.most_triangles, options, progress);
    }
    if (!arguments.mission.out.empty()) write_files(result, mission.output.folder);
    if (!arguments.json_file.empty()) write_file(arguments.json_file, report_json(result));
    if (!arguments.log.quiet) fmt::print("{}", report_text(result));
    return exit_done;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "report", "Measures what each engine costs this mission, in time and in error");
    add_examples(command, {"sonarsim report mission.yaml", "sonarsim report --hard"});
    auto arguments = std::make_shared<ReportArguments>();
    add_mission_options(command, arguments->mission);
    command.get_option("mission")->required(false);
    command
        .add_option(
            "--json", arguments->json_file,
            "Writes the report to this file; with --out, JSON, CSV and Markdown to a folder")
        ->type_name("FILE");
    command.add_flag("--quick", arguments->quick, "Fewer settings, poses and rounds");
    command.add_option("--poses", arguments->report.poses, "Poses, spread along the trajectory")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("--reference-rays", arguments->report.reference_rays,
                    "Largest number of rays per image of the reference")
        ->check(CLI::Range(std::uint64_t{1'000'000}, std::uint64_t{1'000'000'000'000}))
        ->capture_default_str();
    command
        .add_option("--engines", arguments->engines,
                    "Engines to measure, separated by commas: rays, slices, octree, literal, auto")
        ->delimiter(',')
        ->check(CLI::IsMember({"rays", "slices", "octree", "literal", "auto"}))
        ->type_name("NAMES");
    add_threads_option(command, arguments->report.threads,
                       "Threads for pings/s (default: one per core)");
    command.add_flag("--scale", arguments->scale,
                     "Measures how the cost grows with the scene, in detail and in area");
    command
        .add_option("--most-triangles", arguments->most_triangles,
                    "The largest scene that --scale makes")
        ->capture_default_str();
    command
        .add_option("--hard", arguments->hard_name,
                    "Runs the catalogue of hard cases instead, or those with NAME in their name; "
                    "needs no mission")
        ->expected(0, 1)
        ->type_name("[NAME]");
    add_log_options(command, arguments->log, LogResult::text);
    command.callback([arguments, &command, &exit_code] {
        arguments->hard = command.count("--hard") > 0;
        exit_code = report(*arguments);
    });
}

}  // namespace sonarsim
