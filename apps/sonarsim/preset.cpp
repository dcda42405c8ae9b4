#include "input/mission/preset.h"

#include <spdlog/fmt/fmt.h>

#include "commands.h"
#include "core/units.h"
#include "input/mission/parse.h"
#include "simulate/calibrated/equation/expected_echo.h"
#include "simulate/calibrated/model.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

namespace {

constexpr double sphere_db = -20.0;

/// A path as missions have it, or the name of a preset of the program. InputError if neither.
std::string preset_path(const std::string& name) {
    for (const std::string& path : {name, std::string(sensor_presets) + "/" + name + ".yaml"}) {
        const std::filesystem::path file = preset_file(path, std::filesystem::current_path());
        if (!file.empty()) return file.string();
    }
    refuse({name}, "is not a file, and no preset of this name came with the program{}",
           shipped_hint(name));
}

/// A mission of the preset alone, whose scene is never opened.
Mission mission_of(const std::string& name, const std::vector<std::string>& settings) {
    const std::string text =
        "scene: {file: none.glb, materials: none.csv}\n"
        "trajectory: {file: none.csv}\n"
        "sensors: {sonar: {preset: " +
        quoted_text(preset_path(name)) + "}}\n";
    Mission mission = parse_mission(text, name, {}, settings, sonar_keys());
    if (mission.sensors.front().model != ModelKind::calibrated)
        throw InputError(Location{name}, "has no levels: they belong to model: calibrated");
    return mission;
}

/// The ranges at which mean echoes are as strong as the noise in a beam.
Json noise_ranges(const ExpectedEcho& echo, const InstrumentLevels& levels) {
    const double level_db = levels.noise_db - levels.source_level_db;
    Json ranges;
    for (const Material& bottom : example_bottoms()) {
        const double strength_db = bottom_strength_db(echo, bottom);
        ranges[bottom.name] = range_of_level(
            [&](double r) { return bottom_echo_db(echo, strength_db, r); }, level_db);
    }
    ranges["sphere"] =
        range_of_level([&](double r) { return target_echo_db(echo, sphere_db, r); }, level_db);
    return ranges;
}

Json preset_json(const std::string& name, const Mission& mission) {
    const Sonar sonar = make_sonar(mission.sensors.front(), mission.accuracy, mission.water);
    const SonarConfig& config = sonar.config;
    const auto& model = dynamic_cast<const CalibratedModel&>(*sonar.settings.model);
    const InstrumentLevels& levels = model.levels;
    const InstrumentConfig& instrument = config.instrument;
    const ExpectedEcho echo = expected_echo(instrument, mission.water, sonar.settings.view);
    Json ranges = noise_ranges(echo, levels);
    const auto given = [](const std::optional<double>& value) { return value ? "given" : "auto"; };
    return {{"preset", name},
            {"frequency_hz", instrument.frequency_hz},
            {"range_max_m", config.range_max_m},
            {"level_unit", levels.relative ? "dB re the source level" : "dB re 1 uPa"},
            {"source_level_db", levels.source_level_db},
            {"source_level", given(instrument.source_level_db)},
            {"noise_db", levels.noise_db},
            {"noise", given(instrument.receiver.noise_db)},
            {"full_scale_db", levels.full_scale_db},
            {"full_scale", given(instrument.receiver.full_scale_db)},
            {"thermal_noise_db", levels.thermal_noise_db},
            {"wind_noise_db", levels.wind_noise_db},
            {"noise_bandwidth_hz", levels.noise_hz},
            {"receiving_directivity_db", levels.receiving_directivity_db},
            {"transmitting_directivity_db", levels.transmitting_directivity_db},
            {"absorption_db_per_m", model.absorption_db_per_m},
            {"grazing_angle_deg", degrees(echo.grazing_rad)},
            {"noise_range_m", std::move(ranges)}};
}

void print_preset(const Json& preset) {
    const auto number = [&](const char* key) { return preset[key].get<double>(); };
    const auto text = [&](const char* key) { return preset[key].get<std::string>(); };
    const auto level = [&](const char* key, const char* origin) {
        return fmt::format("{:.1f} {}, {}", number(key), text("level_unit"), text(origin));
    };
    const bool upright = number("grazing_angle_deg") == 90.0;
    print_result("preset", text("preset"));
    print_result("frequency", fmt::format("{:.4g} kHz", 1e-3 * number("frequency_hz")));
    print_result("range", fmt::format("{:.4g} m", number("range_max_m")));
    print_result("source", level("source_level_db", "source_level"));
    print_result("noise", level("noise_db", "noise"));
    print_result("", fmt::format("spectrum: thermal {:.1f}, wind {:.1f} dB re 1 uPa^2/Hz",
                                 number("thermal_noise_db"), number("wind_noise_db")));
    print_result(
        "", fmt::format("bandwidth {:.4g} kHz, directivity index: receiver {:.4g} dB, "
                        "transmitter {:.4g} dB",
                        1e-3 * number("noise_bandwidth_hz"), number("receiving_directivity_db"),
                        number("transmitting_directivity_db")));
    print_result("full scale", level("full_scale_db", "full_scale"));
    print_result("absorption", fmt::format("{:.4g} dB/m", number("absorption_db_per_m")));
    print_result("", fmt::format("Mean echo and noise are equal at (bottoms {})",
                                 upright ? "at normal incidence" : "at 20 degrees of grazing"));
    for (const auto& [what, range] : preset["noise_range_m"].items())
        print_result(what, fmt::format("{:.4g} m{}", range.get<double>(),
                                       what == "sphere" ? ", of -20 dB" : ""));
}

/// A table for a terminal of 80 columns.
std::string presets_text(const std::vector<Json>& presets) {
    constexpr const char* row = "{:33}{:>6}{:>9}{:>7}{:>7}{:>7}{:>8}\n";
    const auto number = [](const Json& value) {
        const double metres = value.get<double>();
        return metres < 1000.0 ? fmt::format("{:.3g}", metres) : fmt::format("{:.0f}", metres);
    };
    std::string text = fmt::format(fmt::runtime(row), "preset", "kHz", "range, m", "mud", "sand",
                                   "rock", "sphere");
    for (const Json& preset : presets) {
        const Json& ranges = preset["noise_range_m"];
        text += fmt::format(fmt::runtime(row), preset["preset"].get<std::string>(),
                            fmt::format("{:.4g}", 1e-3 * preset["frequency_hz"].get<double>()),
                            fmt::format("{:.4g}", preset["range_max_m"].get<double>()),
                            number(ranges["mud"]), number(ranges["sand"]), number(ranges["rock"]),
                            number(ranges["sphere"]));
    }
    return text + "\nmud to sphere: the range in m at which its mean echo equals the noise\n";
}

struct PresetArguments {
    std::string name;  ///< "": all that come with the program
    std::vector<std::string> settings;
    bool json = false;
};

int print_presets(const PresetArguments& arguments) {
    const bool one = !arguments.name.empty();
    std::vector<Json> presets;
    for (const std::string& name : one ? std::vector{arguments.name} : shipped_presets())
        presets.push_back(preset_json(name, mission_of(name, arguments.settings)));
    if (arguments.json) {
        fmt::print("{}\n", json_line(one ? presets.front() : Json(presets)));
    } else if (one) {
        print_preset(presets.front());
    } else {
        fmt::print("{}", presets_text(presets));
    }
    return exit_done;
}

}  // namespace

void add_preset(CLI::App& app, int& exit_code) {
    auto [command, arguments] = add_command(
        app, exit_code, "preset",
        "Prints the levels of an instrument and the ranges at which it sees", "Learn",
        {"sonarsim preset gemini_720is", "sonarsim preset mine.yaml --json", "sonarsim preset"},
        print_presets);
    command.add_option("preset", arguments.name,
                       "A file of a sensor's keys, or the name of a preset of configs/sensors "
                       "(default: a table of all of them)");
    command
        .add_option("--set", arguments.settings,
                    "Sets a key, as water.temperature_c=20 or sensors.sonar.range_max_m=20")
        ->allow_extra_args(false)
        ->type_name("KEY=VALUE");
    command.add_flag("--json", arguments.json, "Prints JSON instead of text");
}

}  // namespace sonarsim
