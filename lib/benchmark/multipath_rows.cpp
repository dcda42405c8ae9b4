#include "benchmark/multipath_rows.h"

#include <algorithm>

#include "assembly/engine_probes.h"
#include "benchmark/timed_pings.h"
#include "core/in_parallel.h"
#include "validation/image_error.h"

namespace sonarsim {

namespace {

constexpr MultipathConfig none{MultipathMethod::none, 0, 0.0};

/// The exact method with the same number of columns per beam.
MultipathConfig exact(const MultipathConfig& config) {
    return {MultipathMethod::exact, 0, 0.0, config.columns_per_beam};
}

/// The exact method ignores epsilon and delta, so one setting stands for all of them.
MultipathConfig canonical(const MultipathConfig& config) {
    return config.method == MultipathMethod::exact ? exact(config) : config;
}

/// A sonar with one multipath method, and its times so far.
struct MultipathTrial {
    Sonar sonar;
    std::vector<PoseTimes> poses;
};

MultipathTrial trial_of(const Sonar& sonar, const MultipathConfig& multipath,
                        const Mission& mission, const PingSet& pings) {
    SonarConfig config = sonar.config;
    config.multipath = multipath;
    return {make_sonar(config, mission.accuracy, mission.water),
            std::vector<PoseTimes>(pings.poses.size())};
}

/// Traces the visible surface at each pose, without multipath.
std::vector<TracedPing> trace_surfaces(const PingSet& pings, const Sonar& sonar,
                                       const VisibilityEngine& engine) {
    std::vector<TracedPing> traced(pings.poses.size());
    in_parallel(traced.size(), [&](std::size_t p) {
        traced[p] = trace(*pings.at_pose(sonar, p), pings.scene, engine, pings.poses[p],
                          pings.indices[p], {.multipath = false});
    });
    return traced;
}

/// The multipath echoes only, of all poses one after the other. Keeps the surface in `traced` and
/// replaces its multipath by that of the sonar's method.
std::vector<float> multipath_images(const PingSet& pings, const Sonar& sonar,
                                    const VisibilityEngine& engine,
                                    std::vector<TracedPing>& traced) {
    std::vector<std::vector<float>> images(traced.size());
    in_parallel(images.size(), [&](std::size_t p) {
        const SonarAtPose then = pings.at_pose(sonar, p);
        const PingSettings& settings = then->settings;
        trace_multipath(settings, pings.scene, engine, traced[p]);
        images[p] = form_image(traced[p], settings, pings.scene, {}, multipath_alone).intensity;
    });
    std::vector<float> all;
    for (const std::vector<float>& image : images)
        all.insert(all.end(), image.begin(), image.end());
    return all;
}

void take_turns(const PingSet& pings, const VisibilityEngine& engine,
                std::span<MultipathTrial> trials) {
    for (std::size_t p = 0; p < pings.poses.size(); ++p) {
        for (MultipathTrial& trial : trials)
            visit_pose(pings, trial.sonar, engine, p, trial.poses[p]);
    }
}

/// All multipath methods on one sonar.
std::vector<MultipathRow> measure_sonar(const Mission& mission, const PingSet& pings,
                                        const Sonar& sonar, const VisibilityEngine& engine,
                                        int rounds, const ReportProgress& progress) {
    const std::string& name = sonar.config.name;
    const std::vector<MultipathConfig> settings = multipath_settings(sonar.config.multipath);
    std::vector<MultipathTrial> trials{
        trial_of(sonar, none, mission, pings)};  // then the exact method, then the others
    for (const MultipathConfig& setting : settings)
        trials.push_back(trial_of(sonar, setting, mission, pings));

    progress(name + ": multipath, error");
    std::vector<TracedPing> traced = trace_surfaces(pings, sonar, engine);
    const std::vector<float> truth = multipath_images(pings, trials[1].sonar, engine, traced);
    std::vector<MultipathRow> rows;
    for (std::size_t k = 0; k < settings.size(); ++k) {
        MultipathRow& row = rows.emplace_back();
        row.sensor = name;
        row.setting = settings[k];
        row.current = settings[k] == canonical(sonar.config.multipath);
        row.exact_bins = std::ranges::count_if(truth, [](float x) { return x > 0.0F; });
        const ImageError error =
            image_error(multipath_images(pings, trials[k + 1].sonar, engine, traced), truth);
        row.relative_l1 = error.relative_l1;
        row.recall = 1.0 - error.miss_rate;
        row.precision = 1.0 - error.false_rate;
    }
    for (int round = 0; round < rounds; ++round) {
        progress(name + ": multipath, timing, round " + std::to_string(round + 1) + " of " +
                 std::to_string(rounds));
        take_turns(pings, engine, trials);
    }
    const double ms_exact = over_poses(trials[1].poses, &PingSeconds::multipath).centre;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        MultipathRow& row = rows[k];
        row.ms_multipath = over_poses(trials[k + 1].poses, &PingSeconds::multipath);
        row.ms_per_ping = over_poses(trials[k + 1].poses, &PoseTimes::ping_ms);
        row.ms_without = over_poses(trials[0].poses, &PoseTimes::ping_ms).centre;
        row.speed_up = ms_exact / row.ms_multipath.centre;
    }
    return rows;
}

}  // namespace

std::vector<MultipathConfig> multipath_settings(const MultipathConfig& own) {
    std::vector<MultipathConfig> settings{exact(own)};
    for (const int epsilon : {1, 3, 5, 9}) {
        for (const double delta : {5.0, 15.0, 30.0})
            settings.push_back({MultipathMethod::cluster, epsilon, delta, own.columns_per_beam});
    }
    if (std::ranges::find(settings, canonical(own)) == settings.end()) settings.push_back(own);
    return settings;
}

std::vector<MultipathRow> measure_multipath(const Mission& mission, const Assembly& assembly,
                                            const ReportOptions& options,
                                            const ReportProgress& progress) {
    const auto has_multipath = [](const Sonar& sonar) { return sonar.settings.multipath.on; };
    std::vector<MultipathRow> out;
    if (std::ranges::none_of(assembly.sonars, has_multipath)) return out;
    const PingSet pings = make_ping_set(mission, assembly, options.poses);
    const auto engine = make_engine(assembly.scene, engine_settings(mission, assembly));
    for (const Sonar& sonar : assembly.sonars) {
        if (!has_multipath(sonar)) continue;
        const std::vector<MultipathRow> rows =
            measure_sonar(mission, pings, sonar, *engine, options.rounds, progress);
        out.insert(out.end(), rows.begin(), rows.end());
    }
    return out;
}

}  // namespace sonarsim
