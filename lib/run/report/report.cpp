#include "run/report/report.h"

#include <limits>
#include <memory>

#include "core/clock.h"
#include "core/ordered_pipeline.h"
#include "core/text.h"
#include "input/scene/copies.h"
#include "run/checks/measured_error.h"
#include "run/job/parallel.h"
#include "simulate/reference/reference.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

namespace {

/// The octree has no goal.
const char* goal_of(const Setting& setting, double worst_relative_l1) {
    if (setting.kind == EngineKind::octree) return "-";
    return worst_relative_l1 <= setting.relative_l1 ? "met" : "missed";
}

Setting setting_of(EngineKind kind, double goal, double leaf_m = EngineSettings{}.octree_leaf_m) {
    const bool is_octree = kind == EngineKind::octree;
    return {
        .engine = std::ranges::find(engine_names, kind, &Choice<EngineKind>::value)->name,
        .name = is_octree ? "leaf_m=" + number_text(leaf_m) : "relative_l1=" + number_text(goal),
        .kind = kind,
        .leaf_m = leaf_m,
        .relative_l1 = goal};
}

double finest_bin_m(const Mission& mission) {
    double finest = std::numeric_limits<double>::infinity();
    for (const SonarConfig& sensor : mission.sensors)
        finest = std::min(finest, (sensor.range_max_m - sensor.range_min_m) / sensor.range_bins);
    return finest;
}

/// A sonar with a setting, its errors and samples by pose, and its times so far.
struct Trial {
    Sonar sonar;
    std::shared_ptr<const VisibilityEngine> engine;
    std::vector<ImageError> errors;
    std::vector<double> samples;
    std::vector<PoseTimes> poses;
    std::vector<double> pings_per_s;
};

/// The common inputs of all trials.
struct Comparison {
    PingSet pings;
    const Caster& caster;
    ReportOptions options;  ///< with the actual number of threads
};

/// Times Embree alone on rays over the view: once to warm the caches, then once per timed ping.
void time_view_rays(const Comparison& comparison, std::span<const Eigen::Vector3f> in_sensor,
                    const TracedPing& traced, double range_max_m, PoseTimes& times) {
    constexpr int repeats = 3;
    const LocalPose pose = local_pose(traced.T_world_sensor, comparison.pings.scene.origin);
    std::vector<Eigen::Vector3f> directions(in_sensor.size());
    std::vector<std::uint32_t> facets(in_sensor.size());
    for (std::size_t i = 0; i < directions.size(); ++i)
        directions[i] = pose.rotation * in_sensor[i];
    const auto reach = static_cast<float>(range_max_m) * 1.01F;
    for (int k = 0; k <= repeats; ++k) {
        const double start = thread_seconds_now();
        comparison.caster.cast(pose.position, directions, reach, facets);
        if (k > 0) times.rays_thread_ms.push_back(1e3 * (thread_seconds_now() - start));
    }
}

/// Pings per second with all threads, measured over about a quarter of a second.
double rate(const Comparison& comparison, const Trial& trial) {
    const PingSet& pings = comparison.pings;
    const int threads = comparison.options.threads;
    const double ms = trial.poses[0].ping_ms.back();
    const int count = std::clamp(static_cast<int>(250.0 * threads / ms), 2 * threads, 2000);
    const double start = seconds_now();
    in_parallel(count, [&](std::size_t k) {
        const std::size_t p = k % pings.poses.size();
        render_ping(*pings.at_pose(trial.sonar, p), pings.scene, *trial.engine, pings.poses[p],
                    pings.key(p));
    });
    return count / (seconds_now() - start);
}

template <class Figures>
double mean_over(const std::vector<Figures>& poses, double Figures::*figure) {
    std::vector<double> values;
    std::ranges::transform(poses, std::back_inserter(values), figure);
    return mean_of(values);
}

/// The reference at each pose. Adds their noise to the report.
std::vector<Reference> cast_references(const Comparison& comparison, const Sonar& sonar,
                                       Json& report) {
    const PingSet& pings = comparison.pings;
    const ReferenceGoal goal{comparison.options.reference_noise, 64.0,
                             comparison.options.reference_rays};
    std::vector<Reference> references(pings.poses.size());
    in_parallel(references.size(), [&](std::size_t p) {
        const SonarAtPose then = pings.at_pose(sonar, p);
        references[p] = cast_reference(comparison.caster, pings.scene, *then,
                                       sensor_pose(*then, pings.poses[p], pings.indices[p]), goal);
    });
    const auto noisiest = std::ranges::max_element(references, {}, &Reference::noise);
    report["reference"].push_back(
        {{"sensor", sonar.config.name},
         {"noise_mean", mean_over(references, &Reference::noise)},
         {"noise_max", noisiest->noise},
         {"rays_per_bin_mean", mean_over(references, &Reference::rays_per_bin)}});
    return references;
}

void measure_errors(const PingSet& pings, const std::vector<Reference>& references, Trial& trial) {
    std::vector<std::uint8_t> sees(references.size());
    in_parallel(references.size(), [&](std::size_t p) {
        const SonarAtPose then = pings.at_pose(trial.sonar, p);
        const Ping ping = direct_image(*then, pings.scene, *trial.engine,
                                       sensor_pose(*then, pings.poses[p], pings.indices[p]));
        trial.errors[p] =
            image_error(ping.intensity, references[p].intensity, references[p].scored);
        trial.errors[p].relative_l1 = error_without_noise(ping.intensity, references[p]);
        trial.samples[p] = static_cast<double>(ping.counts.samples);
        const auto is_bright = [](float echo) { return echo > 0.0F; };
        sees[p] = std::ranges::any_of(references[p].intensity, is_bright) ||
                  std::ranges::any_of(ping.intensity, is_bright);
    });
    // Pings that see nothing have no error.
    std::vector<ImageError> seen;
    for (std::size_t p = 0; p < references.size(); ++p) {
        if (sees[p] != 0) seen.push_back(trial.errors[p]);
    }
    if (!seen.empty()) trial.errors = std::move(seen);
}

/// One sonar with one setting. Errors are without noise: means over the poses, and the worst. Times
/// are with noise, medians over the poses, on one thread but for `pings_per_s`. Embree and its
/// multiples are in CPU time, measured in turns.
Json row_of(const std::string& sensor, const Setting& setting, const Trial& trial) {
    std::vector<double> times_rays;
    for (const PoseTimes& pose : trial.poses)
        times_rays.push_back(median_of(pose.ping_thread_ms) / median_of(pose.rays_thread_ms));
    const double worst =
        std::ranges::max_element(trial.errors, {}, &ImageError::relative_l1)->relative_l1;
    return {{"sensor", sensor},
            {"engine", setting.engine},
            {"setting", setting.name},
            {"current", setting.current},
            {"on_front", false},
            {"ms_per_ping", over_poses(trial.poses, &PoseTimes::ping_ms)},
            {"times_131k_rays", median_of(times_rays)},
            {"pings_per_s", median_of(trial.pings_per_s)},
            {"relative_l1", mean_over(trial.errors, &ImageError::relative_l1)},
            {"worst_relative_l1", worst},
            {"goal", goal_of(setting, worst)},
            {"miss_rate", mean_over(trial.errors, &ImageError::miss_rate)},
            {"samples_per_ping", mean_of(trial.samples)},
            {"ms_131k_rays", over_poses(trial.poses, &PoseTimes::rays_thread_ms)}};
}

/// Marks the rows that no other row equals in both figures and beats in one.
void mark_front(std::vector<Json>& rows) {
    for (Json& row : rows) {
        row["on_front"] = std::ranges::none_of(rows, [&](const Json& other) {
            const bool as_fast = other.at("ms_per_ping") <= row["ms_per_ping"];
            const bool as_accurate = other.at("relative_l1") <= row["relative_l1"];
            return as_fast && as_accurate &&
                   (other.at("ms_per_ping") < row["ms_per_ping"] ||
                    other.at("relative_l1") < row["relative_l1"]);
        });
    }
}

/// A trial for each setting. One tree serves rays of every error goal.
std::vector<Trial> trials_of(const PingSet& pings, const Assembly& assembly, const Sonar& sonar,
                             std::span<const Setting> settings) {
    std::vector<Trial> trials;
    std::shared_ptr<const VisibilityEngine> rays;
    for (const Setting& setting : settings) {
        Trial& trial = trials.emplace_back();
        trial.sonar = sonar;
        trial.sonar.settings.view.relative_l1 = setting.relative_l1;
        trial.poses.resize(pings.poses.size());
        trial.errors.resize(pings.poses.size());
        trial.samples.resize(pings.poses.size());
        const bool is_rays = setting.kind == EngineKind::rays;
        trial.engine = is_rays && rays ? rays
                                       : make_engine(assembly.scene,
                                                     engine_settings(setting.kind, setting.leaf_m));
        if (is_rays) rays = trial.engine;
    }
    return trials;
}

/// All settings on one sonar.
void report_sonar(const Comparison& comparison, const Assembly& assembly, const Sonar& sonar,
                  std::span<const Setting> settings, const ReportProgress& progress, Json& report) {
    const PingSet& pings = comparison.pings;
    const std::string& name = sonar.config.name;
    progress(name + ": casting the reference");
    const std::vector<Reference> references = cast_references(comparison, sonar, report);
    std::vector<Trial> trials = trials_of(pings, assembly, sonar, settings);
    for (std::size_t s = 0; s < trials.size(); ++s) {
        progress(name + ": " + settings[s].engine + " " + settings[s].name + ", error");
        measure_errors(pings, references, trials[s]);
    }
    const std::vector<Eigen::Vector3f> over_view = view_rays(sonar.settings.view);
    for (int round = 0; round < comparison.options.rounds; ++round) {
        progress(name + ": timing, round " + std::to_string(round + 1));
        for (std::size_t p = 0; p < pings.poses.size(); ++p) {
            for (Trial& trial : trials) {
                const TracedPing traced =
                    visit_pose(pings, trial.sonar, *trial.engine, p, trial.poses[p]);
                time_view_rays(comparison, over_view, traced, sonar.settings.view.range_max_m,
                               trial.poses[p]);
            }
        }
        for (Trial& trial : trials)
            trial.pings_per_s.push_back(rate(comparison, trial));
    }
    std::vector<Json> rows;
    for (std::size_t s = 0; s < trials.size(); ++s)
        rows.push_back(row_of(name, settings[s], trials[s]));
    mark_front(rows);
    for (Json& row : rows)
        report["rows"].push_back(std::move(row));
}

}  // namespace

std::vector<Setting> make_settings(const Mission& mission, bool quick) {
    const std::vector<double> goals =
        quick ? std::vector{0.1, 0.03, 0.01} : std::vector{0.1, 0.03, 0.01, 0.003};
    const std::vector<double> leaves =
        quick ? std::vector{0.08, 0.04} : std::vector{0.08, 0.04, 0.02, 0.01};
    const double own_goal = mission.accuracy.relative_l1;
    std::vector<Setting> settings;
    for (const EngineKind kind : {EngineKind::rays, EngineKind::strips}) {
        for (const double goal : goals)
            settings.push_back(setting_of(kind, goal));
    }
    for (const double leaf : leaves) {
        if (leaf >= 0.25 * finest_bin_m(mission))
            settings.push_back(setting_of(EngineKind::octree, own_goal, leaf));
    }
    settings.push_back(setting_of(EngineKind::automatic, own_goal));
    Setting own = setting_of(mission.engine, own_goal, mission.octree_leaf_m);
    own.current = true;
    std::erase_if(settings, [&](const Setting& setting) {
        return setting.engine == own.engine && setting.name == own.name;
    });
    settings.push_back(own);
    return settings;
}

std::string unsupported(const Setting& setting, const Assembly& assembly) {
    const EngineSettings engine = engine_settings(setting.kind, setting.leaf_m);
    std::string refusal = unsupported(engine, assembly.scene);
    for (const Sonar& sonar : assembly.sonars) {
        if (refusal.empty()) refusal = unsupported(engine, sonar.settings.view);
    }
    return refusal;
}

Json make_report(const Mission& mission, const Assembly& assembly,
                 std::span<const Setting> settings, const ReportOptions& options,
                 const ReportProgress& progress) {
    double load = 0.0;
    ::getloadavg(&load, 1);
    Json report;
    on_threads(options.threads, [&](int threads) {
        const Caster caster(assembly.scene);
        Comparison comparison{PingSet(mission, assembly, options.poses), caster, options};
        comparison.options.threads = threads;
        report = {{"mission", mission.name},
                  {"triangles", all_triangles(assembly.scene)},
                  {"poses", comparison.pings.poses.size()},
                  {"threads", threads},
                  {"load", load},
                  {"rows", Json::array()},
                  {"reference", Json::array()}};
        for (const Sonar& sonar : assembly.sonars)
            report_sonar(comparison, assembly, sonar, settings, progress, report);
    });
    return report;
}

}  // namespace sonarsim
