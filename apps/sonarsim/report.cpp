#include "run/report/report.h"

#include <spdlog/spdlog.h>

#include <set>

#include "commands.h"
#include "core/error.h"
#include "core/file.h"
#include "mission_options.h"
#include "run/checks/find_warnings.h"

namespace sonarsim {

namespace {

struct ReportArguments {
    MissionOptions mission;
    std::filesystem::path json_file;
    ReportOptions report;
    bool quick = false;
    std::vector<std::string> engines;
    LogOptions log;
};

/// The mission without the scattering of the water's volume.
Mission without_water_echoes(Mission mission) {
    mission.water.content = WaterContent::none;
    mission.water.scattering_db_per_m3.reset();
    mission.water.layers.clear();
    return mission;
}

/// The settings to measure: the requested engines that support the mission's scene.
std::vector<Setting> settings_of(const ReportArguments& arguments, const Mission& mission,
                                 const Assembly& assembly) {
    std::vector<Setting> settings = make_settings(mission, arguments.quick);
    std::set<std::string> refusals;
    std::erase_if(settings, [&](const Setting& setting) {
        if (!arguments.engines.empty() && !contains(arguments.engines, setting.engine)) return true;
        const std::string refusal = unsupported(setting, assembly);
        if (refusal.empty()) return false;
        if (refusals.insert(refusal).second) spdlog::info("left out: {}", refusal);
        return true;
    });
    if (settings.empty()) {
        refuse({arguments.mission.file.string()}, "{}",
               refusals.empty() ? "--engines: no setting of these engines suits the range "
                                  "bins of this mission; add another engine"
                                : *refusals.begin());
    }
    return settings;
}

int report(const ReportArguments& arguments) {
    const Mission whole = load(arguments.mission);
    const Mission mission = without_water_echoes(whole);
    const Location where{arguments.mission.file.string()};
    if (mission.variants > 0)
        refuse(where,
               "the report measures one scene, and this mission has variants; give it the "
               "mission.resolved.yaml of one of them, or --set variants=0 --set vary=[]");
    const Assembly assembly = assemble(mission);
    if (!assembly.scene.bodies.empty())
        throw InputError(where,
                         "the report measures scenes that stand still; leave the trajectories of "
                         "objects out");
    if (assembly.scene.sound_profile)
        refuse(where, "the report measures straight paths of sound; leave water.profile out");
    log_warnings(reading_warnings(assembly.scene));

    ReportOptions options = arguments.report;
    if (arguments.quick) {
        options.poses = std::min(options.poses, 3);
        options.rounds = 2;
        options.reference_noise = 0.005;
        options.reference_rays = std::min(options.reference_rays, std::uint64_t{50'000'000});
    }
    const auto progress = [](const std::string& what) { spdlog::info("{}", what); };
    const std::vector<Setting> settings = settings_of(arguments, mission, assembly);
    Json result = make_report(mission, assembly, settings, options, progress);
    result["multipath_rows"] = measure_multipath(mission, assembly, options, progress);
    progress("the job with labels and files");
    result["job"] = measure_job(whole, result["rows"].at(0).at("ms_131k_rays"), options);
    if (!arguments.mission.out.empty()) {
        const std::filesystem::path& folder = mission.output.folder;
        std::filesystem::create_directories(folder);
        write_file(folder / "report.json", report_json(result));
        write_file(folder / "report.md", report_markdown(result));
    }
    if (!arguments.json_file.empty()) write_file(arguments.json_file, report_json(result));
    if (!arguments.log.quiet) fmt::print("{}", report_markdown(result));
    return exit_done;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
    auto [command, arguments] =
        add_command(app, exit_code, "report",
                    "Measures what each engine costs this mission, in time and in error", "Check",
                    {"sonarsim report mission.yaml --quick --out out/report"}, report);
    add_mission_options(command, arguments.mission);
    command
        .add_option("--json", arguments.json_file,
                    "Writes the report to this file; with --out, JSON and Markdown to a folder")
        ->type_name("FILE");
    command.add_flag("--quick", arguments.quick, "Fewer settings, poses and rounds");
    command.add_option("--poses", arguments.report.poses, "Poses, spread along the trajectory")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("--reference-rays", arguments.report.reference_rays,
                    "Largest number of rays per image of the reference")
        ->check(CLI::Range(std::uint64_t{1'000'000}, std::uint64_t{1'000'000'000'000}))
        ->capture_default_str();
    command
        .add_option("--engines", arguments.engines,
                    "Engines to measure, separated by commas: rays, strips, octree, auto")
        ->delimiter(',')
        ->check(CLI::IsMember({"rays", "strips", "octree", "auto"}))
        ->type_name("NAMES");
    add_threads_option(command, arguments.report.threads,
                       "Threads for pings/s (default: one per core)");
    add_log_options(command, arguments.log, LogResult::text);
}

}  // namespace sonarsim
