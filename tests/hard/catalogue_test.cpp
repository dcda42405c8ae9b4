#include "hard/cases.h"
#include "input/mission/instrument.h"
#include "simulate/paper/echoes.h"
#include "simulate/reference/reference.h"
#include "simulate/sonar/kinds.h"

namespace {

/// No pixel is NaN, infinite, negative or brighter than physics allows. The margin is that of the
/// rounding of a mean of echoes in float.
void check_invariants(const Ping& ping, const Scene& scene, ModelKind model, double margin) {
    // Echoes of the calibrated model have no limit, and it also counts the bins of guard beams.
    double brightest = std::numeric_limits<double>::max();
    if (model == ModelKind::paper) {
        brightest = 0.0;
        for (const Material& material : scene.materials)
            brightest = std::max(brightest, static_cast<double>(material.reflection));
        brightest *= 1.0 + margin;
        CHECK(ping.counts.occupied_bins <= ping.intensity.size());
    }
    CHECK(std::ranges::all_of(ping.intensity, [&](float x) {
        return std::isfinite(x) && x >= 0.0F && static_cast<double>(x) <= brightest;
    }));
}

double error_of(const std::vector<float>& image, const std::vector<float>& truth) {
    std::vector<std::uint8_t> checked;
    for (const float value : truth)
        checked.push_back(value != unchecked);
    return image_error(image, truth, checked).relative_l1;
}

void check_case(const HardCase& hard, EngineKind engine_kind, ModelKind model) {
    const Scene& scene = hard.scene;
    const bool is_compared = hard.truth && (model == ModelKind::paper || hard.truth_of_any_model);
    // The invariants of a model do not depend on the engine.
    if (!is_compared && model != ModelKind::paper && engine_kind != EngineKind::rays) return;
    CAPTURE_ALL(hard.name, static_cast<int>(engine_kind), static_cast<int>(model));
    const bool strips = engine_kind == EngineKind::strips;
    // The mean of a bin hides errors of area that a sum of energies shows.
    const double bound =
        (model == ModelKind::paper ? 1.0 : 2.0) *
        (strips && hard.bounds.strips >= 0.0 ? hard.bounds.strips : hard.bounds.rays);
    const auto engine = make_engine(scene, engine_settings(engine_kind));
    bool holds = true;
    for (const KindOfSonar& sonar_kind : kinds_of_sonar()) {
        const SonarKind kind = sonar_kind.keys.kind;
        CAPTURE(std::string(name_of(kind)));
        const HardTrial trial = with_model(hard.trial(kind), model);
        Ping ping = render_ping(trial.sonar, scene, *engine, trial.T_world_vehicle, {1, 0});
        check_invariants(ping, scene, model, 5e-5);
        if (!is_compared) continue;
        if (model != ModelKind::paper)
            ping = render_ping(trial.sonar, scene, *engine, trial.T_world_vehicle, {1, 0},
                               without_random_terms);
        const double error =
            error_of(ping.intensity, hard.truth({scene, trial, kind, engine_kind, model, ping}));
        holds = holds && error <= bound;
        if (!hard.rays_fail || strips) CHECK(error <= bound);
    }
    // A known fault must still exist: a fixed one must leave the list.
    if (is_compared && hard.rays_fail && !strips) CHECK(!holds);
}

/// The number of samples that the sonars of a turned floor drop.
std::uint64_t dropped_by(const VisibilityEngine& engine, const Scene& scene,
                         const Eigen::Quaterniond& R, ModelKind model) {
    std::uint64_t dropped = 0;
    for (const KindOfSonar& kind : kinds_of_sonar()) {
        const auto from_0_m = [](SonarConfig& c) { c.range_min_m = 0.0; };
        const HardTrial trial = with_model(over_floor(kind.keys.kind, from_0_m), model);
        const Pose pose{R * trial.T_world_vehicle.rotation, Eigen::Vector3d::Zero()};
        const Ping ping = render_ping(trial.sonar, scene, engine, pose, {1, 0});
        dropped += ping.counts.dropped_samples;
        check_invariants(ping, scene, model, 1e-5);
    }
    return dropped;
}

}  // namespace

TEST_CASE("hard cases: every case keeps its bound") {
    for (const std::vector<HardCase>& cases :
         {hard_places(), hard_geometry(), hard_invariances()}) {
        for (const HardCase& hard : cases) {
            for (const Choice<ModelKind>& model : echo_models) {
                for (const EngineKind engine : {EngineKind::rays, EngineKind::strips})
                    check_case(hard, engine, model.value);
            }
        }
    }
}

TEST_CASE("a sonar on a floor, turned together every way: no image is anything but an image") {
    // The sonar's height is 0 up to rounding: above the plane, on it or below it. One in 400 such
    // pings once requested a negative number of echoes.
    std::uint64_t dropped = 0;
    for (int i = 0; i < 400; ++i) {
        const Eigen::Quaterniond R = rotation_from_rpy(0.37 * i, 0.71 * i, 1.13 * i);
        Scene scene = plain_floor();
        add_rectangle(scene, {3, -9, -9}, {3, 9, 9}, 0);
        for (Eigen::Vector3f& p : scene.vertices)
            p = R.toRotationMatrix().cast<float>() * (p - Eigen::Vector3f(0.31F, 0.17F, 0.0F));
        for (const EngineKind engine_kind : {EngineKind::rays, EngineKind::strips}) {
            const auto engine = make_engine(scene, engine_settings(engine_kind));
            for (const Choice<ModelKind>& model : echo_models) {
                const bool usual =
                    engine_kind == EngineKind::rays && model.value == ModelKind::paper;
                if (usual || i % 40 == 0) dropped += dropped_by(*engine, scene, R, model.value);
            }
        }
    }
    CHECK(dropped > 0);
}

TEST_CASE("the error of rays falls with their goal") {
    struct Subject {
        const char* name;
        Scene scene;
        double pitch_deg;
        Eigen::Vector3d position;
    };
    const Subject subjects[] = {{"smooth", rough_floor(), 35.0, {0.3, 0.2, 4.0}},
                                {"edgy", tank(), 15.0, {-2.4, 0.4, 1.5}},
                                {"grazing", rough_floor(), 5.0, {0.3, 0.2, 1.3}}};
    Sonar sonar = in_tank(SonarKind::imaging).sonar;
    for (const Subject& subject : subjects) {
        CAPTURE(subject.name);
        const Pose pose{rotation_from_rpy(0.0, radians(subject.pitch_deg), 0.1), subject.position};
        const Reference truth =
            cast_reference(Caster(subject.scene), subject.scene, sonar.settings.view, pose,
                           {0.001, 256.0, 16'000'000});
        const auto engine = engine_of(subject.scene, EngineKind::rays);
        double first = 0.0;
        for (const double goal : {0.24, 0.12, 0.06, 0.03, 0.015}) {
            CAPTURE(goal);
            sonar.settings.view.relative_l1 = goal;
            const Ping ping = render_ping(sonar, subject.scene, *engine, pose, {1, 0});
            const double error = image_error(ping.intensity, truth.intensity).relative_l1;
            if (first == 0.0) first = error;
            CHECK(error < 1.2 * goal);  // a single pose may miss its goal
            // Silhouettes and bin edges limit the order of convergence to one.
            CHECK(error <= 1.1 * first * std::pow(goal / 0.24, 0.4));
        }
    }
}

TEST_CASE("an echo that is no number or out of range is dropped and counted, one across is cut") {
    const auto echoes_at = [](const std::vector<float>& range_m, const std::vector<float>& half_m) {
        Echoes echoes;
        echoes.resize(range_m.size(), false);
        for (std::size_t i = 0; i < range_m.size(); ++i) {
            echoes.range_m[i] = range_m[i];
            echoes.half_m[i] = half_m[i];
            echoes.weight[i] = echoes.intensity[i] = 1.0F;
        }
        return echoes;
    };
    BinSums sums;
    sums.clear(4);
    const float nan = std::nanf("");
    CHECK(accumulate(echoes_at({nan, INFINITY, -1.0F, 0.5F}, {0.1F, INFINITY, 0.1F, nan}),
                     {0.0F, 0.5F, 4}, sums) == 4);
    for (int i = 0; i < 4; ++i)
        CHECK(sums.weight(i) == 0.0F);
    // Bins from 2 to 3 m, 0.25 m each. Truncation towards zero would put 1.8 m into the first bin.
    CHECK(accumulate(echoes_at({1.8F, 3.2F, 3.01F, 2.0F, 2.99F}, {0.1F, 0.1F, 0.0F, 0.1F, 0.1F}),
                     {2.0F, 0.25F, 4}, sums) == 3);
    CHECK(sums.weight(0) == approx(0.5));  // the half of 1.9 to 2.1 m that is in range
    CHECK(sums.weight(1) == 0.0F);
    CHECK(sums.weight(2) == 0.0F);
    CHECK(sums.weight(3) == approx(0.55));  // the part of 2.89 to 3.09 m below 3
}
