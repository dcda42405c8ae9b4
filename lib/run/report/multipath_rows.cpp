#include <algorithm>

#include "core/ordered_pipeline.h"
#include "run/report/report.h"
#include "simulate/reference/reference.h"

namespace sonarsim {

namespace {

/// The exact method ignores epsilon and delta, so one setting stands for all of them.
MultipathConfig canonical(const MultipathConfig& config) {
    if (config.method != MultipathMethod::exact) return config;
    return {MultipathMethod::exact, 0, 0.0};
}

/// A sonar with a method, its multipath echoes of all poses one after the other, and its times.
struct MultipathTrial {
    Sonar sonar;
    std::vector<float> echoes;
    std::vector<PoseTimes> poses;
};

/// Makes the echoes of all trials. The visible surface of a pose is traced once.
void make_echoes(const PingSet& pings, const VisibilityEngine& engine,
                 std::vector<MultipathTrial>& trials) {
    const std::size_t poses = pings.poses.size();
    std::vector<std::vector<std::vector<float>>> images(poses);
    in_parallel(poses, [&](std::size_t p) {
        TracedPing traced = trace(*pings.at_pose(trials[0].sonar, p), pings.scene, engine,
                                  pings.poses[p], pings.indices[p], {.multipath = false});
        for (const MultipathTrial& trial : trials) {
            const SonarAtPose then = pings.at_pose(trial.sonar, p);
            trace_multipath(then->settings, pings.scene, engine, traced);
            images[p].push_back(
                form_image(traced, then->settings, pings.scene, {}, multipath_alone).intensity);
        }
    });
    for (std::size_t k = 0; k < trials.size(); ++k) {
        for (const auto& image : images)
            trials[k].echoes.insert(trials[k].echoes.end(), image[k].begin(), image[k].end());
    }
}

/// All multipath methods on one sonar. The first trial has the exact method, the last one none.
void measure_sonar(const PingSet& pings, const Sonar& sonar, const VisibilityEngine& engine,
                   int rounds, std::vector<Json>& rows) {
    std::vector<MultipathConfig> settings = multipath_settings(sonar.config.multipath);
    settings.push_back({MultipathMethod::none, 0, 0.0});
    std::vector<MultipathTrial> trials;
    for (const MultipathConfig& setting : settings) {
        SonarConfig config = sonar.config;
        config.multipath = setting;
        trials.push_back({make_sonar(config, pings.mission.accuracy, pings.mission.water),
                          {},
                          std::vector<PoseTimes>(pings.poses.size())});
        prepare_for(pings.scene, trials.back().sonar);
    }
    make_echoes(pings, engine, trials);
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t p = 0; p < pings.poses.size(); ++p) {
            for (MultipathTrial& trial : trials)
                visit_pose(pings, trial.sonar, engine, p, trial.poses[p]);
        }
    }
    const std::vector<float>& truth = trials[0].echoes;
    for (std::size_t k = 0; k + 1 < settings.size(); ++k) {
        const ImageError error = image_error(trials[k].echoes, truth);
        const double ms_per_ping = over_poses(trials[k].poses, &PoseTimes::ping_ms);
        const double ms_without = over_poses(trials.back().poses, &PoseTimes::ping_ms);
        const bool is_exact = settings[k].method == MultipathMethod::exact;
        // Recall is the share of the exact method's bins that this one fills, precision that of
        // this method's bins that the exact one fills. Times are with noise, on one thread.
        rows.push_back(
            {{"sensor", sonar.config.name},
             {"method", is_exact ? "exact" : "cluster"},
             {"epsilon_bins", settings[k].epsilon_bins},
             {"delta_deg", settings[k].delta_deg},
             {"current", settings[k] == canonical(sonar.config.multipath)},
             {"relative_l1", error.relative_l1},
             {"recall", 1.0 - error.miss_rate},
             {"precision", 1.0 - image_error(truth, trials[k].echoes).miss_rate},
             {"exact_bins", std::ranges::count_if(truth, [](float x) { return x > 0.0F; })},
             {"ms_multipath", over_poses(trials[k].poses, &PoseTimes::multipath_ms)},
             {"ms_per_ping", ms_per_ping},
             {"times_without", ms_per_ping / ms_without}});
    }
}

}  // namespace

std::vector<MultipathConfig> multipath_settings(const MultipathConfig& own) {
    std::vector<MultipathConfig> settings{{MultipathMethod::exact, 0, 0.0}};
    for (const int epsilon : {1, 3, 5, 9}) {
        for (const double delta : {5.0, 15.0, 30.0})
            settings.push_back({MultipathMethod::cluster, epsilon, delta});
    }
    if (std::ranges::find(settings, canonical(own)) == settings.end()) settings.push_back(own);
    return settings;
}

std::vector<Json> measure_multipath(const Mission& mission, const Assembly& assembly,
                                    const ReportOptions& options, const ReportProgress& progress) {
    std::vector<Json> rows;
    const PingSet pings(mission, assembly, options.poses);
    std::unique_ptr<VisibilityEngine> engine;
    for (const Sonar& sonar : assembly.sonars) {
        if (!sonar.settings.multipath.on) continue;
        progress(sonar.config.name + ": multipath");
        if (!engine) engine = make_engine(assembly.scene, engine_settings(mission));
        measure_sonar(pings, sonar, *engine, options.rounds, rows);
    }
    return rows;
}

}  // namespace sonarsim
