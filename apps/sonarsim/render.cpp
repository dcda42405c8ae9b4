#include <spdlog/spdlog.h>

#include <system_error>

#include "commands.h"
#include "core/error.h"
#include "core/text.h"
#include "mission_options.h"
#include "run/checks/find_warnings.h"
#include "run/job/run_job.h"
#include "run/job/variants.h"

namespace sonarsim {

namespace {

constexpr const char* run_again =
    "written files are complete; run the same command again to continue";

struct RenderArguments {
    MissionOptions mission;
    RenderOptions render;
    bool no_files = false;
    bool strict = false;
    LogOptions log;
};

/// Takes the shard "2/4" of the command line, where shards count from 1.
void take_shard(const std::string& text, RenderOptions& options) {
    constexpr std::int64_t max_shards = 1'000'000;
    const std::size_t slash = text.find('/');
    const auto shard = parse_integer(text.substr(0, slash));
    const auto shards =
        slash == std::string::npos ? std::nullopt : parse_integer(text.substr(slash + 1));
    if (!shard || !shards || *shard < 1 || *shard > *shards || *shards > max_shards)
        throw CLI::ValidationError("--shard", "'" + text + "' is not of the form 1/4 to 4/4");
    options.shard = static_cast<int>(*shard - 1);
    options.shards = static_cast<int>(*shards);
}

double pings_per_s(const RenderSummary& summary) {
    return summary.seconds > 0.0 ? static_cast<double>(summary.pings) / summary.seconds : 0.0;
}

/// The stages of the work and their seconds.
std::vector<std::pair<std::string_view, double>> stage_seconds(const RenderSummary& summary) {
    std::vector<std::pair<std::string_view, double>> stages;
    stages.reserve(std::size(ping_timers) + 3);
    for (const auto& timer : ping_timers)
        stages.emplace_back(timer.name, summary.stages.*timer.member);
    stages.emplace_back("label", summary.label_seconds);
    stages.emplace_back("encode", summary.encode_seconds);
    stages.emplace_back("write", summary.write_seconds);
    return stages;
}

void print_table(const RenderSummary& summary) {
    const auto stages = stage_seconds(summary);
    double sum = 0.0;
    for (const auto& stage : stages)
        sum += stage.second;
    fmt::print("pings       {:>8}\npings/s     {:>8.0f}\n", summary.pings, pings_per_s(summary));
    for (const auto& [name, seconds] : stages)
        fmt::print("{:<12}{:>6.1f} %\n", name, sum > 0.0 ? 100.0 * seconds / sum : 0.0);
}

void print_json(const RenderSummary& summary, const Mission& mission,
                std::span<const Warning> warnings) {
    Json json;
    json["pings"] = summary.pings;
    json["skipped"] = summary.skipped;
    json["complete"] = summary.complete;
    json["seconds"] = summary.seconds;
    json["pings_per_s"] = pings_per_s(summary);
    for (const auto& [name, seconds] : stage_seconds(summary))
        json["thread_seconds"][name] = seconds;
    json["samples"] = summary.counts.samples;
    json["echoes"] = summary.counts.echoes;
    json["clipped_pixels"] = summary.clipped_pixels;
    for (std::size_t i = 0; i < summary.sensors.size(); ++i) {
        const SensorSummary& sensor = summary.sensors[i];
        json["sensors"][mission.sensors[i].name] = {{"pings", sensor.pings},
                                                    {"dark_pings", sensor.dark_pings},
                                                    {"brightest", sensor.brightest}};
    }
    json["warnings"] = Json::array();
    for (const Warning& warning : warnings)
        json["warnings"].push_back(sentence(warning));
    fmt::print("{}\n", json_line(json));
}

/// Logs dropped echoes by reason. A usual run has many; warnings report those that matter.
void log_dropped(const PingCounts& counts) {
    for (const auto& counter : ping_counters) {
        const std::uint64_t count = counts.*counter.member;
        if (counter.is_a_loss && count > 0) spdlog::debug("{} {}", count, counter.text);
    }
    if (counts.multipath.samples > 0)
        spdlog::debug("multipath: {}", sentence(multipath_counters, counts.multipath));
}

/// The first picture of a dataset, or of its first variant; "" where it has none.
std::filesystem::path picture_of(const Mission& mission) {
    std::filesystem::path folder = mission.output.folder;
    if (mission.variants > 0) folder /= variant_folder(0);
    for (const SonarConfig& sonar : mission.sensors) {
        for (const char* name :
             {"fan/000000.png", "waterfall_view.png", "echogram_view.png", "scan_0000.png"}) {
            const std::filesystem::path picture = folder / sonar.name / name;
            if (std::filesystem::exists(picture))
                return picture.lexically_proximate(std::filesystem::current_path());
        }
    }
    return {};
}

void log_outcome(const RenderSummary& summary, const Mission& mission, bool files) {
    const std::string folder = mission.output.folder.string();
    if (files && summary.complete) {
        spdlog::info("{}: complete; {}", folder, made_text(summary.pings, summary.skipped));
        const std::string picture = picture_of(mission).string();
        if (!picture.empty()) spdlog::info("open {}", picture);
    } else if (files && !summary.stopped) {
        spdlog::info("{}: the pings of other shards are still missing", folder);
    }
    log_dropped(summary.counts);
}

/// A dataset's own mission.resolved.yaml may be rendered again; overwriting would replace it.
void refuse_overwriting_mission(const std::filesystem::path& file, const Mission& mission) {
    const std::filesystem::path written = mission.output.folder / mission_name;
    std::error_code absent;
    if (!std::filesystem::equivalent(written, file, absent)) return;
    throw InputError({file.string()},
                     "--overwrite would replace the mission itself; copy it out of the folder "
                     "first, or choose another --out");
}

struct Outcome {
    RenderSummary summary;
    std::vector<Warning> before;  ///< logged before the first ping
};

/// Logs the warnings that need no ping, and the size of the mission.
std::vector<Warning> warn_before(const Mission& mission, const Assembly& assembly) {
    std::vector<Warning> warnings = warnings_before_pings(mission, assembly);
    log_warnings(warnings);
    spdlog::info("{}: {} triangles, {} poses", mission.name, assembly.scene.triangles.size(),
                 assembly.trajectory.size());
    const SceneRejects& rejects = assembly.scene.rejects;
    if (rejects.degenerate_triangles > 0)
        spdlog::debug("{} triangles without area are left out", rejects.degenerate_triangles);
    return warnings;
}

Outcome render_one(const RenderArguments& arguments, const Mission& mission,
                   const std::atomic<bool>& stop) {
    Outcome out;
    SceneStore models;
    models.announce = [](const std::string& what) { spdlog::info("{}", what); };
    const Assembly assembly = assemble(mission, models);
    out.before = warn_before(mission, assembly);
    ProgressLine line(arguments.log);
    out.summary = run_job(
        mission, assembly, arguments.render,
        [&](const RenderSummary& so_far, std::uint64_t total) { line.show(so_far.pings, total); },
        stop);
    append(out.summary.warnings, image_warnings(mission, assembly, out.summary.sensors));
    return out;
}

Outcome render_variants(const RenderArguments& arguments, const Mission& mission,
                        const Variants& variants, const std::atomic<bool>& stop) {
    spdlog::info("{}: {} variants", mission.name, variants.size());
    Outcome out;
    ProgressLine line(arguments.log, "variants");
    // Warnings about the first scene hold for most others, so they are not repeated.
    bool first = true;
    const auto begin = [&](const Mission& variant, const Assembly& assembly) {
        if (std::exchange(first, false)) out.before = warn_before(variant, assembly);
    };
    out.summary = run_variants(mission, variants, arguments.render, begin, line.callback(), stop);
    return out;
}

int render(const RenderArguments& given) {
    RenderArguments arguments = given;
    arguments.render.files = !arguments.no_files;
    const std::atomic<bool>& stop =
        stop_on_signal(warning_line(arguments.log, std::string("stopped at once; ") + run_again));
    const Mission mission = load(arguments.mission);
    if (arguments.render.overwrite) refuse_overwriting_mission(arguments.mission.file, mission);
    const Variants variants = load_variants(arguments.mission, mission);
    auto [summary, warnings] = variants.size() == 0
                                   ? render_one(arguments, mission, stop)
                                   : render_variants(arguments, mission, variants, stop);
    std::vector<Warning>& after = summary.warnings;
    if (summary.unlocked)
        after.insert(after.begin(),
                     make_warning(WarningCode::no_locks, mission.output.folder.string()));
    log_outcome(summary, mission, arguments.render.files);
    constexpr std::size_t max_listed = 20;  // warnings of all variants that are printed
    log_warnings(std::span(after).first(std::min(max_listed, after.size())));
    if (after.size() > max_listed)
        spdlog::warn("and {} warnings more like these", after.size() - max_listed);
    append(warnings, after);
    if (arguments.log.json) {
        print_json(summary, mission, warnings);
    } else if (arguments.log.prints_result()) {
        print_table(summary);
    }
    if (!summary.stopped) return arguments.strict && !warnings.empty() ? exit_warned : exit_done;
    spdlog::warn("stopped after {} pings; {}", summary.pings, run_again);
    return exit_code_of_signal();
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
    auto [command, arguments] =
        add_command(app, exit_code, "render",
                    "Renders a mission into its dataset, or resumes an interrupted one", "Make",
                    {"sonarsim render mission.yaml",
                     "sonarsim render mission.yaml --out out/far --set sensors.fls.range_max_m=20",
                     "sonarsim render mission.yaml --shard 2/8 --out out/part2"},
                    render);
    add_mission_options(command, arguments.mission);
    add_threads_option(command, arguments.render.threads);
    command
        .add_option_function<std::string>(
            "--shard",
            [&options = arguments.render](const auto& text) { take_shard(text, options); },
            "Renders the I-th of N parts, counted from 1")
        ->type_name("I/N");
    command.add_flag("--overwrite", arguments.render.overwrite,
                     "Replaces another dataset in the output folder: removes the folders of its "
                     "sensors and the files of the dataset next to them, and keeps all others");
    command
        .add_option("--checkpoint", arguments.render.checkpoint_s,
                    "Seconds between checkpoints, the most that a power cut costs (default: 5)")
        ->check([](const std::string& seconds) {  // CLI::Range passes NaN
            const double s = parse_number(seconds).value_or(0.0);
            return s >= 0.01 && s <= 3600.0 ? "" : seconds + " is not from 0.01 to 3600";
        })
        ->type_name("S");
    command.add_flag("--no-files", arguments.no_files, "Writes nothing, to measure the speed");
    command.add_flag("--strict", arguments.strict, "Exit code 3 where there was a warning");
    add_log_options(command, arguments.log);
}

}  // namespace sonarsim
