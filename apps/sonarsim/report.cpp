#include "study/report.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "commands.h"
#include "core/file.h"
#include "dataset/png.h"
#include "logging.h"
#include "mission_options.h"
#include "study/bench.h"
#include "study/cold_start.h"
#include "study/ladder.h"
#include "study/multipath_rows.h"
#include "study/report_files.h"
#include "study/report_plot.h"
#include "study/report_text.h"
#include "study/scaling.h"

namespace sonarsim {

namespace {

struct ReportArguments {
    MissionOptions mission;
    std::filesystem::path json_file;
    ReportOptions report;
    bool quick = false;
    bool scale = false;
    std::size_t most_triangles = 5'000'000;
    LogOptions log;
};

void write_plot(const std::filesystem::path& stem, const Plot& plot) {
    const Drawing drawing = draw_log_log(plot);
    write_file(stem.string() + ".svg", svg_text(drawing));
    write_file(stem.string() + ".png",
               png_bytes(raster(drawing), drawing.width, drawing.height, 3));
}

void write_files(const Report& report, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    write_file(folder / "report.json", report_json(report));
    write_file(folder / "report.csv", report_csv(report));
    if (!report.multipath.empty()) write_file(folder / "multipath.csv", multipath_csv(report));
    write_file(folder / "report.md", report_markdown(report));
    for (const ReferenceQuality& reference : report.references) {
        const std::string& sensor = reference.sensor;
        write_plot(folder / ("error_" + sensor), error_plot(report, sensor));
        if (!report.growth.empty()) {
            write_plot(folder / ("growth_" + sensor), growth_plot(report, sensor));
        }
    }
}

int report(const ReportArguments& arguments) {
    const double start = seconds_now();
    start_logging(arguments.log);
    const Mission mission = load(arguments.mission);
    const Assembly assembly = assemble(mission);
    const double assembled_s = seconds_now() - start;
    warn_about(assembly.scene.rejects);

    ReportOptions options = arguments.report;
    if (arguments.quick) {
        options.poses = std::min(options.poses, 3);
        options.rounds = 2;
        options.reference_moved = 0.005;
        options.reference_rays = 50'000'000;
    }
    const auto progress = [](const std::string& what) { spdlog::info("{}", what); };
    const std::vector<Setting> ladder = make_ladder(mission, arguments.quick);
    progress("each setting in a process of its own");
    const std::vector<ColdStart> cold =
        measure_cold_starts(mission, assembly, ladder, options, assembled_s);
    Report result = make_report(mission, assembly, ladder, cold, options, progress);
    result.multipath = measure_multipath(mission, assembly, options, progress);
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
    auto arguments = std::make_shared<ReportArguments>();
    add_mission_options(command, arguments->mission);
    command
        .add_option("--json", arguments->json_file,
                    "Writes the report to this file; with --out, JSON, CSV and plots to a folder")
        ->type_name("FILE");
    command.add_flag("--quick", arguments->quick, "Fewer settings, poses and rounds");
    command.add_option("--poses", arguments->report.poses, "Poses, spread along the trajectory")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("-j,--threads", arguments->report.threads,
                    "Threads for pings/s (default: one per core)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    command.add_flag("--scale", arguments->scale,
                     "Measures how the cost grows with the scene, in detail and in area");
    command
        .add_option("--most-triangles", arguments->most_triangles,
                    "The largest scene that --scale makes")
        ->capture_default_str();
    command.add_option("--log-level", arguments->log.level, "trace, debug, info, warning or error")
        ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error"}))
        ->capture_default_str();
    command.add_flag("-q,--quiet", arguments->log.quiet, "Only warnings and errors");
    command.callback([arguments, &exit_code] { exit_code = report(*arguments); });
}

}  // namespace sonarsim
