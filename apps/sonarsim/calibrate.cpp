#include "calibrate/calibrate.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "core/units.h"
#include "logging.h"
#include "mission/parse.h"
#include "mission/preset.h"
#include "recording/read_recording.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

struct CalibrateArguments {
    std::filesystem::path recording;
    std::string preset;
    std::filesystem::path out;
    std::filesystem::path report;  ///< "": none
    std::vector<std::string> settings;
    double slope_deg = 0.0;
    RecordingOptions reading;
    CalibrationOptions options;
    LogOptions log;
};

/// The file of the preset to start with: a path, or the name of one that comes with the program.
std::filesystem::path start_file(const std::string& name) {
    const bool is_name = name.find('/') == std::string::npos && !name.ends_with(".yaml");
    std::filesystem::path file = preset_file(is_name ? "sensors/" + name + ".yaml" : name, "");
    if (!file.empty()) return file;
    throw InputError(
        Location{name},
        "is no file, and no preset of this name came with the program" + shipped_hint(name));
}

/// A mission of the preset alone, whose scene is never opened.
Mission mission_of_start(const std::filesystem::path& file,
                         const std::vector<std::string>& settings) {
    const std::string text =
        "scene: {file: none.glb, materials: none.csv}\n"
        "trajectory: {file: none.csv}\n"
        "sensors: {sonar: {preset: " +
        quoted_text(file.string()) + "}}\n";
    Mission mission = parse_mission(text, file.string(), {}, settings, sonar_keys());
    if (mission.sensors.front().model != ModelKind::calibrated) {
        throw InputError(Location{file.string()},
                         "has nothing to calibrate: only model: calibrated has an instrument");
    }
    return mission;
}

std::string preset_head(const Calibration& calibration, const std::string& start) {
    return fmt::format(
        "# Fitted by sonarsim calibrate to {} pings of {}, from {}.\n"
        "# A number with `fit` was estimated, with its interval of 95 %; `file` is the shape of "
        "the "
        "pings.\n# All others are those of the start, whose own head follows.\n#\n",
        calibration.pings_fitted, calibration.name, start);
}

int calibrate_command(const CalibrateArguments& arguments) {
    start_logging(arguments.log);
    const std::filesystem::path file = start_file(arguments.preset);
    const Mission mission = mission_of_start(file, arguments.settings);
    const Recording recording = load_recording(arguments.recording, arguments.reading);
    CalibrationOptions options = arguments.options;
    options.slope_rad = radians(arguments.slope_deg);
    const Calibration calibration =
        calibrate(recording, mission.sensors.front(), mission.water, options);
    constexpr std::size_t largest_preset = std::size_t{1} << 20;
    const std::string preset =
        with_values(read_file(file, largest_preset), file.string(), calibration.preset);
    write_file(arguments.out, preset_head(calibration, arguments.preset) + preset);
    if (!arguments.report.empty())
        write_file(arguments.report, json_line(calibration_json(calibration)));
    if (arguments.log.json) {
        fmt::print("{}", json_line(calibration_json(calibration)));
    } else if (arguments.log.prints_result()) {
        fmt::print("{}", calibration_text(calibration));
    }
    return exit_done;
}

void add_calibrate_options(CLI::App& command, CalibrateArguments& arguments) {
    command
        .add_option("recording", arguments.recording,
                    "The pings: a folder with recording.yaml, or a dataset")
        ->required()
        ->type_name("REAL");
    command
        .add_option("--preset", arguments.preset,
                    "The preset to start with: a file, or the name of one of configs/sensors")
        ->required()
        ->type_name("START");
    command.add_option("--out", arguments.out, "The preset to write")
        ->required()
        ->type_name("PRESET");
    command.add_option("--report", arguments.report, "Writes all numbers as JSON")
        ->type_name("FILE");
    command
        .add_option("--judge", arguments.options.judged_share,
                    "The share of the pings that is judged and not fitted, the last ones")
        ->type_name("SHARE")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 0.99));
    command.add_flag("--reverse", arguments.options.reversed,
                     "Judges the first pings and fits the last ones");
    command
        .add_option("--slope-deg", arguments.slope_deg,
                    "Slope of the bottom across the track, positive down to port; for soundings")
        ->type_name("DEG");
    command
        .add_option("--sensor", arguments.reading.sensor, "The sensor of a dataset with several")
        ->type_name("NAME");
    command
        .add_option(
            "--set", arguments.settings,
            "Sets a key, as water.temperature_c=20 or sensors.sonar.instrument.beam.width_deg=1")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    add_log_options(command, arguments.log);
}

}  // namespace

void add_calibrate(CLI::App& app, int& exit_code) {
    CLI::App& command = *app.add_subcommand(
        "calibrate", "Fits a preset to pings of a real sonar and judges it by other pings");
    add_examples(
        command,
        {"sonarsim calibrate pings --preset oculus_m1200d_2100khz --out mine.yaml",
         "sonarsim calibrate pings --preset start.yaml --out mine.yaml --report report.json"});
    auto arguments = std::make_shared<CalibrateArguments>();
    add_calibrate_options(command, *arguments);
    command.callback([arguments, &exit_code] { exit_code = calibrate_command(*arguments); });
}

}  // namespace sonarsim
