#include "run/checks/measured_error.h"

#include <utility>

#include "core/ordered_pipeline.h"
#include "core/text.h"
#include "simulate/assembly/poses.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/strips/strips.h"

namespace sonarsim {

namespace {

constexpr std::size_t max_measured_pings = 3;

/// Noise of a reference by an error that can be measured with it.
constexpr double measurable = 0.5;

/// No engine refines images much beyond a third of this goal.
constexpr double min_refined_goal = 0.01;

// A count and not a time, so that the numbers are the same on every machine.
constexpr std::uint64_t mean_rays_max = 6'000'000;
constexpr std::uint64_t energy_rays_max = 3'000'000;  // an echo costs as much as its ray

/// Chosen: of 5.7 rays in a bin the noise of energies was 16 to 35 % in three poses of one job.
constexpr std::uint64_t min_energy_rays_per_bin = 8;

/// The cell of a sonar's range noise; 1 cm^2 without that noise, but at most half of a bin in the
/// middle of the ranges: of finer bins few would hold a cell. A cell above 1 cm^2 is at most a
/// tenth of that bin: the noise of the reference decides which bins hold a cell of their own size.
double cell_m2_of(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const double across_rad =
        view.shape == ViewShape::fan ? view.azimuth_rad / view.beams : view.elevation_rad;
    const double middle_m = 0.5 * (view.range_min_m + view.range_max_m);
    const double bin_m2 = view.bin_m() * across_rad * middle_m;
    const double usual_m2 = std::min(1e-4, 0.5 * bin_m2);
    const NoiseConfig& noise = sonar.config.noise;
    if (sonar.config.model != ModelKind::paper || !(noise.range_lambda_m > 0.0)) return usual_m2;
    return std::min(noise.scatterer_m * noise.scatterer_m, std::max(0.1 * bin_m2, usual_m2));
}

/// A reference with a bounded number of rays; one without casts if they could not suffice.
Reference affordable_reference(const Caster& caster, const Scene& scene, const Sonar& sonar,
                               const Pose& T_world_sensor, double goal) {
    const View& view = sonar.settings.view;
    const bool energies = sonar.settings.model->info.energies_add;
    const auto bins = static_cast<std::uint64_t>(view.range_bins) * view.beams;
    if (energies && energy_rays_max < min_energy_rays_per_bin * bins) {
        Reference none;
        none.intensity.resize(bins);
        return none;
    }
    return cast_reference(caster, scene, sonar, T_world_sensor,
                          {.noise = measurable * goal,
                           .rays_per_bin = 4.0,
                           .rays_max = energies ? energy_rays_max : mean_rays_max,
                           .gives_up = true});
}

/// The change of the image, relative L1, from the mission's goal to a finer one. `direct`: the
/// image of the direct echoes alone, which is that of the goal where there is no multipath.
double change_when_finer(PingSettings settings, double finer, const Scene& scene,
                         const VisibilityEngine& engine, const Pose& T_world_sensor,
                         const Ping& direct) {
    constexpr Terms terms{.water = false, .random = 0};
    const auto image = [&] {
        const TracedPing traced = trace_ping(settings, scene, engine, T_world_sensor, terms);
        return form_image(traced, settings, scene, {}, terms).intensity;
    };
    const std::vector<float> coarse = settings.multipath.on ? image() : direct.intensity;
    settings.view.relative_l1 *= finer;
    return image_error(coarse, image()).relative_l1;
}

PingError measure(const Mission& mission, const Assembly& assembly, const Caster& caster,
                  const VisibilityEngine& engine, const PingId& id) {
    const Scene& scene = assembly.scene;
    const std::uint32_t pose = id.pose;
    const TimedPose& at = assembly.trajectory[pose];
    const SonarAtPose sonar(mission, assembly.sonars[id.sensor], pose);
    const Pose T_world_sensor = sensor_pose(*sonar, at.T_world_vehicle, pose);
    const std::vector<Pose> bodies = body_poses(assembly, at.t_s);
    const Caster placed = bodies.empty() ? caster : caster.moved(bodies);
    const double goal = mission.accuracy.relative_l1;
    Reference truth = affordable_reference(placed, scene, *sonar, T_world_sensor, goal);
    if (goal < min_refined_goal && truth.noise > measurable * goal)
        truth = affordable_reference(placed, scene, *sonar, T_world_sensor, min_refined_goal);
    const std::shared_ptr<const VisibilityEngine> then =
        engine_at(engine, assembly.motions, at.t_s);
    const Ping ping = direct_image(*sonar, scene, *then, T_world_sensor);
    const bool has_truth = std::ranges::max(truth.intensity) > 0.0F;
    if (!has_truth && !(std::ranges::max(ping.intensity) > 0.0F)) return {pose, {}, 0.0};
    const double direct = error_without_noise(ping.intensity, truth);
    const auto change = [&](double finer) {
        return change_when_finer(sonar->settings, finer, scene, *then, T_world_sensor, ping);
    };
    // The reference holds no multipath.
    const bool many_paths = sonar->settings.multipath.on;
    const double with_paths = many_paths ? change(0.1) : 0.0;
    const double error = std::max(direct, with_paths);
    const bool is_scored = std::ranges::find(truth.scored, 1) != truth.scored.end();
    if (is_scored && truth.noise <= measurable * std::max(goal, error))
        return {pose, error, truth.noise};
    // In bins that are all smaller than a cell, a finer image may be as wrong.
    const bool unknown = (has_truth && !is_scored) || goal < min_refined_goal;
    if (unknown || mission.engine == EngineKind::octree) return {pose, {}, truth.noise};
    // The noise may be all of `direct`.
    return {pose, many_paths ? with_paths : change(1.0 / 3.0), truth.noise, true};
}

/// The key that lowers the error, as the imperative of a sentence.
std::string cure_of(const Mission& mission, double worst) {
    if (mission.engine == EngineKind::octree) return "use engine: auto";
    constexpr const char* another = "use the engine with the least error in `sonarsim report`";
    // Errors fall about as fast as the goal, or more slowly; a rounded number must be lower.
    const double goal = mission.accuracy.relative_l1;
    const double finest =
        mission.engine == EngineKind::rays ? AccuracyConfig::min_relative_l1 : finest_goal;
    if (goal <= finest) return another;
    const double lower = std::max(std::min(goal * goal / worst, 0.5 * goal), finest);
    return "lower accuracy.relative_l1 to " + short_text(lower) +
           (mission.engine == EngineKind::automatic ? "" : std::string(", or ") + another);
}

}  // namespace

std::optional<double> MeasuredError::mean() const {
    double sum = 0.0;
    int measured = 0;
    for (const PingError& ping : pings) {
        sum += ping.relative_l1.value_or(0.0);
        measured += ping.relative_l1.has_value();
    }
    if (measured == 0) return {};
    return sum / measured;
}

std::optional<PingError> MeasuredError::worst() const {
    const auto worst = std::ranges::max_element(pings, {}, &PingError::relative_l1);
    if (worst == pings.end() || !worst->relative_l1) return {};
    return *worst;
}

double MeasuredError::min_measurable() const {
    double noise = 0.0;
    for (const PingError& ping : pings) {
        if (!ping.relative_l1) noise = std::max(noise, ping.noise);
    }
    return noise / measurable;
}

Reference cast_reference(const Caster& caster, const Scene& scene, const Sonar& sonar,
                         const Pose& T_world_sensor, ReferenceGoal goal) {
    goal.cell_m2 = cell_m2_of(sonar);
    const PingSettings& settings = sonar.settings;
    return settings.model->info.energies_add
               ? cast_energy_reference(caster, scene, settings, T_world_sensor, goal)
               : cast_reference(caster, scene, settings.view, T_world_sensor, goal);
}

Ping direct_image(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                  const Pose& T_world_sensor) {
    const TracedPing traced =
        trace_ping(sonar.settings, scene, engine, T_world_sensor, surface_alone);
    return form_image(traced, sonar.settings, scene, {}, surface_alone);
}

std::vector<std::optional<MeasuredError>> measure_errors(const Mission& mission,
                                                         const Assembly& assembly,
                                                         const VisibilityEngine& engine) {
    std::vector<std::optional<MeasuredError>> errors(mission.sensors.size());
    if (assembly.scene.sound_profile) return errors;
    std::vector<PingId> tasks;
    for (std::uint32_t i = 0; i < assembly.sonars.size(); ++i) {
        for (const std::uint32_t pose : sample_pings(
                 assembly.trajectory.size(), assembly.sonars[i].config.every, max_measured_pings))
            tasks.push_back({pose, i});
    }
    const Caster caster = assembly.make_caster();
    std::vector<PingError> found(tasks.size());
    in_parallel(tasks.size(), [&](std::size_t k) {
        found[k] = measure(mission, assembly, caster, engine, tasks[k]);
    });
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        std::optional<MeasuredError>& error = errors[tasks[k].sensor];
        if (!error) error.emplace();
        error->pings.push_back(found[k]);
    }
    return errors;
}

Json json_of(const std::optional<MeasuredError>& error) {
    if (!error) return nullptr;
    constexpr double steps = 1e5;  // a thousandth of a percent
    Json pings = Json::array();
    for (const PingError& ping : error->pings) {
        pings.push_back({{"pose", ping.pose},
                         {"relative_l1", rounded(ping.relative_l1, steps)},
                         {"reference_noise", rounded(ping.noise, steps)},
                         {"by", ping.by_finer_image ? "finer image" : "reference"}});
    }
    const std::optional<PingError> worst = error->worst();
    return {{"mean", rounded(error->mean(), steps)},
            {"worst", worst ? rounded(worst->relative_l1, steps) : Json()},
            {"pings", std::move(pings)}};
}

std::vector<Warning> error_warnings(const Mission& mission,
                                    std::span<const std::optional<MeasuredError>> errors) {
    const double goal = mission.accuracy.relative_l1;
    std::vector<Warning> warnings;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const std::optional<PingError> worst = errors[i] ? errors[i]->worst() : std::nullopt;
        if (!worst || *worst->relative_l1 <= goal) continue;
        warnings.push_back(make_warning(
            WarningCode::goal_missed, about_sensor(mission.sensors[i].name),
            short_text(100.0 * *errors[i]->mean()), short_text(100.0 * *worst->relative_l1),
            worst->pose, short_text(100.0 * goal, 4), cure_of(mission, *worst->relative_l1)));
    }
    return warnings;
}

}  // namespace sonarsim
