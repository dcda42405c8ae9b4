#include "benchmark/report.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "benchmark/settings.h"
#include "benchmark/thread_clock.h"
#include "benchmark/timed_pings.h"
#include "benchmark/view_rays.h"
#include "core/clock.h"
#include "core/in_parallel.h"
#include "scene/copies.h"
#include "validation/energy_reference.h"
#include "validation/fit.h"
#include "validation/image_error.h"
#include "validation/reference.h"
#include "visibility/local_pose.h"

namespace sonarsim {

namespace {

/// A sonar with a setting, and its times so far.
struct Trial {
    Sonar sonar;
    const EngineSettings* engine_settings = nullptr;
    const VisibilityEngine* engine = nullptr;
    std::vector<PoseTimes> poses;
    std::vector<double> pings_per_s;
};

/// The common inputs of all trials.
struct Comparison {
    PingSet pings;
    const Caster& caster;
    ReportOptions options;  ///< with the actual number of threads
};

/// Milliseconds of bare Embree: rays from the sensor to every sample, in the order of the samples.
double bare_ms(const Comparison& comparison, const TracedPing& traced, double range_max_m) {
    const Pose& T_world_sensor = traced.T_world_sensor;
    const std::vector<Sample>& samples = traced.samples.items;
    const Eigen::Matrix3f R = T_world_sensor.rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f origin =
        (T_world_sensor.translation - comparison.pings.scene.origin).cast<float>();
    std::vector<Eigen::Vector3f> directions(samples.size());
    std::vector<std::uint32_t> facets(samples.size());
    for (std::size_t i = 0; i < directions.size(); ++i) {
        directions[i] = R * samples[i].position.normalized();
    }
    const auto reach = static_cast<float>(range_max_m) * 1.01F;
    Stopwatch watch;
    comparison.caster.cast(origin, directions, reach, facets);
    return 1e3 * watch.lap();
}

/// Times Embree alone on rays over the view: once to warm the caches, then once per ping of a
/// visit.
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
        pings.render(trial.sonar, *trial.engine, k % pings.poses.size());
    });
    return count / (seconds_now() - start);
}

/// The reference at each pose.
std::vector<Reference> cast_references(const Comparison& comparison, const Sonar& sonar) {
    const PingSet& pings = comparison.pings;
    const ReportOptions& options = comparison.options;
    std::vector<Reference> references(pings.poses.size());
    in_parallel(references.size(), [&](std::size_t p) {
        const PingSettings& settings = sonar.settings;
        const Pose T_world_sensor =
            sensor_pose(*pings.at_pose(sonar, p), pings.poses[p], pings.indices[p]);
        const ReferenceGoal goal{options.reference_moved, 64.0, options.reference_rays};
        references[p] = settings.model->energies_add()
                            ? cast_energy_reference(comparison.caster, pings.scene, settings,
                                                    T_world_sensor, goal)
                            : cast_reference(comparison.caster, pings.scene, settings.view,
                                             T_world_sensor, goal);
    });
    return references;
}

ReferenceQuality quality(const std::string& sensor, const std::vector<Reference>& references) {
    std::vector<double> moved;
    std::vector<double> apart;
    std::vector<double> rays;
    for (const Reference& reference : references) {
        moved.push_back(reference.moved);
        apart.push_back(reference.apart);
        rays.push_back(reference.rays_per_bin);
    }
    return {sensor, mean_summary(moved), mean_summary(apart), mean_summary(rays)};
}

/// Uses a new engine, so that its warnings are about these pings only.
void measure_errors(const PingSet& pings, const Trial& trial,
                    const std::vector<Reference>& references, ReportRow& row) {
    const auto engine = make_engine(pings.scene, *trial.engine_settings);
    const std::size_t poses = references.size();
    std::vector<double> l1(poses);
    std::vector<double> l2(poses);
    std::vector<double> miss(poses);
    std::vector<double> false_bins(poses);
    std::vector<double> samples(poses);
    std::vector<double> estimated_l1(poses);
    in_parallel(poses, [&](std::size_t p) {
        Sonar sonar = *pings.at_pose(trial.sonar, p);
        sonar.settings.coherent = nullptr;  // the reference has no coherent echoes
        const Ping ping = render_ping(sonar, pings.scene, *engine, pings.poses[p], pings.key(p),
                                      direct_echoes_alone);
        const ImageError error = image_error(ping.intensity, references[p].intensity);
        l1[p] = error.relative_l1;
        l2[p] = error.relative_l2;
        miss[p] = error.miss_rate;
        false_bins[p] = error.false_rate;
        samples[p] = static_cast<double>(ping.counts.samples);
        estimated_l1[p] = ping.estimated_l1;
    });
    const double goal = trial.sonar.settings.view.relative_l1;
    row.warned = !engine->warnings().empty() ||
                 std::ranges::any_of(estimated_l1, [&](double error) { return error > goal; });
    row.relative_l1 = mean_summary(l1);
    row.relative_l2 = mean_summary(l2);
    row.miss_rate = mean_summary(miss);
    row.false_rate = mean_summary(false_bins);
    row.samples_per_ping = mean_summary(samples);
}

void summarise_times(const Trial& trial, ReportRow& row) {
    row.ms_per_ping = over_poses(trial.poses, &PoseTimes::ping_ms);
    for (const auto& timer : ping_timers)
        row.stages.*timer.member = 1e-3 * over_poses(trial.poses, timer.member).centre;
    row.ms_bare = over_poses(trial.poses, &PoseTimes::bare_ms).centre;
    row.ms_rays = over_poses(trial.poses, &PoseTimes::rays_thread_ms).centre;
    std::vector<double> times_rays;
    for (const PoseTimes& pose : trial.poses) {
        times_rays.push_back(median_summary(pose.ping_thread_ms).centre /
                             median_summary(pose.rays_thread_ms).centre);
    }
    row.times_rays = median_summary(times_rays).centre;
    row.pings_per_s = median_summary(trial.pings_per_s).centre;
}

void mark_front(std::vector<ReportRow>& rows, const std::string& sensor) {
    std::vector<ReportRow*> own;
    std::vector<double> cost;
    std::vector<double> error;
    for (ReportRow& row : rows) {
        if (row.sensor != sensor) continue;
        own.push_back(&row);
        cost.push_back(row.ms_per_ping.centre);
        error.push_back(row.relative_l1.centre);
    }
    const std::vector<bool> front = pareto_front(cost, error);
    for (std::size_t i = 0; i < own.size(); ++i)
        own[i]->on_front = front[i];
}

/// The engines of all settings.
struct Engines {
    std::vector<EngineSettings> settings;
    std::vector<std::shared_ptr<const VisibilityEngine>> made;
};

Engines make_engines(const Mission& mission, const Assembly& assembly,
                     std::span<const Setting> settings) {
    std::shared_ptr<const VisibilityEngine> rays;  // one tree serves every error goal
    Engines engines;
    for (const Setting& setting : settings) {
        engines.settings.push_back(engine_settings(setting, mission, assembly));
        const bool again = setting.kind == EngineKind::rays && rays;
        engines.made.push_back(again ? rays : make_engine(assembly.scene, engines.settings.back()));
        if (setting.kind == EngineKind::rays) rays = engines.made.back();
    }
    return engines;
}

/// All settings on one sonar.
void report_sonar(const Comparison& comparison, std::size_t index, const Assembly& assembly,
                  std::span<const Setting> settings, const Engines& engines,
                  std::span<const ColdStart> cold, const ReportProgress& progress, Report& report) {
    const PingSet& pings = comparison.pings;
    const int rounds = comparison.options.rounds;
    const Sonar& sonar = assembly.sonars[index];
    const std::string& name = sonar.config.name;
    progress(name + ": casting the reference");
    const std::vector<Reference> references = cast_references(comparison, sonar);
    report.references.push_back(quality(name, references));

    const std::vector<Eigen::Vector3f> over_view = view_rays(sonar.settings.view);
    std::vector<Trial> trials;
    std::vector<ReportRow> rows;
    for (std::size_t s = 0; s < settings.size(); ++s) {
        progress(name + ": " + settings[s].engine + " " + settings[s].name + ", error");
        trials.push_back({with_setting(sonar, settings[s]),
                          &engines.settings[s],
                          engines.made[s].get(),
                          std::vector<PoseTimes>(pings.poses.size()),
                          {}});
        ReportRow& row = rows.emplace_back();
        row.sensor = name;
        row.setting = settings[s];
        if (!cold.empty()) row.cold = cold[s * assembly.sonars.size() + index];
        measure_errors(pings, trials.back(), references, row);
    }
    for (int round = 0; round < rounds; ++round) {
        progress(name + ": timing, round " + std::to_string(round + 1) + " of " +
                 std::to_string(rounds));
        for (std::size_t p = 0; p < pings.poses.size(); ++p) {
            for (Trial& trial : trials) {
                PoseTimes& times = trial.poses[p];
                const TracedPing traced = visit_pose(pings, trial.sonar, *trial.engine, p, times);
                const double range_max_m = trial.sonar.settings.view.range_max_m;
                times.bare_ms.push_back(bare_ms(comparison, traced, range_max_m));
                time_view_rays(comparison, over_view, traced, range_max_m, times);
            }
        }
        for (Trial& trial : trials)
            trial.pings_per_s.push_back(rate(comparison, trial));
    }
    for (std::size_t s = 0; s < rows.size(); ++s)
        summarise_times(trials[s], rows[s]);
    mark_front(rows, name);
    report.rows.insert(report.rows.end(), rows.begin(), rows.end());
}

}  // namespace

Sonar with_setting(const Sonar& sonar, const Setting& setting) {
    Sonar out = sonar;
    out.settings.view.relative_l1 = setting.relative_l1;
    return out;
}

Report make_report(const Mission& mission, const Assembly& assembly,
                   std::span<const Setting> settings, std::span<const ColdStart> cold,
                   const ReportOptions& options, const ReportProgress& progress) {
    const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(threads);
    Report report;
    report.mission = mission.name;
    report.triangles = all_triangles(assembly.scene);
    report.threads = threads;
    report.goal = mission.accuracy.relative_l1;
    ::getloadavg(&report.load, 1);
    arena.execute([&] {
        const Caster caster(assembly.scene);
        Comparison comparison{make_ping_set(mission, assembly, options.poses), caster, options};
        comparison.options.threads = threads;
        report.poses = static_cast<int>(comparison.pings.poses.size());
        const Engines engines = make_engines(mission, assembly, settings);
        for (std::size_t i = 0; i < assembly.sonars.size(); ++i) {
            report_sonar(comparison, i, assembly, settings, engines, cold, progress, report);
        }
    });
    return report;
}

}  // namespace sonarsim
