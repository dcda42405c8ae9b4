#include "hard/cases.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

#include "core/clock.h"
#include "core/error.h"
#include "mission/instrument.h"
#include "sonar/engine_settings.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

/// Describes the first invariant that the image breaks.
std::string broken_invariant(const Ping& ping, double brightest, ModelKind model) {
    for (const float x : ping.intensity) {
        if (!std::isfinite(x)) return "a pixel is not finite";
        if (x < 0.0F) return "a pixel is negative";
        if (x > brightest) return fmt::format("a pixel is {}, above {}", x, brightest);
    }
    // The calibrated model also counts the bins of its guard beams.
    if (model == ModelKind::paper && ping.counts.occupied_bins > ping.intensity.size())
        return "more occupied bins than bins";
    return "";
}

/// The largest reflection, with a margin for the rounding of a mean: that of many thousand echoes
/// is off by this much in float. Echoes of the calibrated model have no limit.
double brightest_of(const Scene& scene, ModelKind model) {
    if (model == ModelKind::calibrated) return std::numeric_limits<double>::max();
    float largest = 0.0F;
    for (const Material& material : scene.materials)
        largest = std::max(largest, material.reflection);
    return static_cast<double>(largest) * (1.0 + 5e-5);
}

struct Difference {
    double relative = 0.0;
    double largest = 0.0;
};

Difference compare(const Ping& ping, const std::vector<float>& truth) {
    Difference out;
    double sum = 0.0;
    double total = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        if (truth[k] == unchecked) continue;
        const double apart = std::fabs(static_cast<double>(ping.intensity[k]) - truth[k]);
        sum += apart;
        total += truth[k];
        out.largest = std::max(out.largest, apart);
    }
    out.relative = total > 0.0 ? sum / total : sum > 0.0 ? 1.0 : 0.0;
    return out;
}

HardResult run(const HardCase& hard, const Scene& scene, EngineKind engine_kind,
               const Choice<ModelKind>& model) {
    const bool slices = engine_kind == EngineKind::slices;
    HardResult result{hard.name, hard.stresses, slices ? "slices" : "rays",
                      std::string(model.name)};
    const double bound =
        slices && hard.bounds.slices >= 0.0 ? hard.bounds.slices : hard.bounds.rays;
    // The mean of a bin hides errors of area that a sum of energies shows.
    result.bound = (model.value == ModelKind::paper ? 1.0 : 2.0) * bound;
    const bool is_compared =
        hard.truth && (model.value == ModelKind::paper || hard.truth_of_any_model);
    if (is_compared && !slices) result.known_fault = hard.known_fault_of_rays;
    const double brightest = brightest_of(scene, model.value);
    const EngineSettings settings = engine_settings(engine_kind);
    const std::unique_ptr<VisibilityEngine> engine = make_engine(scene, settings);
    for (const KindOfSonar& sonar_kind : kinds_of_sonar()) {
        const SonarKind kind = sonar_kind.keys.kind;
        const HardTrial trial = with_model(hard.trial(kind), model.value);
        Stopwatch watch;
        const Ping ping = render_ping(trial.sonar, scene, *engine, trial.T_world_vehicle, {1, 0});
        const double ms = 1e3 * watch.lap();
        result.slowest_ms = std::max(result.slowest_ms, ms);
        const std::string broken = broken_invariant(ping, brightest, model.value);
        if (!broken.empty()) result.broken = std::string(name_of(kind)) + ": " + broken;
        if (!is_compared) continue;
        const Ping compared = model.value == ModelKind::paper
                                  ? ping
                                  : render_ping(trial.sonar, scene, *engine, trial.T_world_vehicle,
                                                {1, 0}, compared_terms(model.value));
        const Difference apart =
            compare(compared, hard.truth({scene, trial, kind, engine_kind, model.value, compared}));
        result.largest_difference = std::max(result.largest_difference, apart.largest);
        if (result.sonar.empty() || apart.relative > result.error) {
            result.error = apart.relative;
            result.sonar = name_of(kind);
        }
    }
    return result;
}

std::string verdict(const HardResult& result) {
    if (result.holds()) return result.known_fault.empty() ? "holds" : "holds, though known to fail";
    if (!result.known_fault.empty()) return "known fault: " + result.known_fault;
    return result.broken.empty() ? "FAILS" : "FAILS: " + result.broken;
}

}  // namespace

std::vector<HardCase> hard_cases() {
    std::vector<HardCase> all;
    for (std::vector<HardCase>& some : std::array{hard_places(), hard_geometry(), hard_numbers(),
                                                  hard_sonar_limits(), hard_invariances()}) {
        std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    return all;
}

HardTrial with_model(HardTrial trial, ModelKind model) {
    if (model == trial.sonar.config.model) return trial;
    SonarConfig config = trial.sonar.config;
    config.model = model;
    config.instrument.receiver.noise_db = -200.0;
    config.instrument.receiver.full_scale_db = -20.0;
    config.instrument.receiver.companding = Companding::linear;
    config.instrument.receiver.bits = 16;
    trial.sonar = make_sonar(config, {});
    return trial;
}

Terms compared_terms(ModelKind model) {
    return model == ModelKind::paper ? Terms{} : without_random_terms;
}

std::vector<HardResult> run_hard_case(const HardCase& hard) {
    const Scene scene = hard.scene();
    std::vector<HardResult> results;
    for (const Choice<ModelKind>& model : echo_models) {
        for (const EngineKind engine : {EngineKind::rays, EngineKind::slices}) {
            // The invariants of a model do not depend on the engine.
            const bool is_compared = model.value == ModelKind::paper || hard.truth_of_any_model;
            if (is_compared || engine == EngineKind::rays)
                results.push_back(run(hard, scene, engine, model));
        }
    }
    return results;
}

std::string hard_table(const std::vector<HardResult>& results) {
    std::string text =
        fmt::format("{:<32}{:<8}{:<11}{:<50}{:>10}{:>10} {:<13}{:>9}{:>9}  {}\n", "case", "engine",
                    "model", "stresses", "error", "bound", "worst", "max diff", "ms", "verdict");
    for (const HardResult& r : results) {
        const bool bounded = !r.sonar.empty();
        text += fmt::format(
            "{:<32}{:<8}{:<11}{:<50}{:>10}{:>10} {:<13}{:>9}{:>9.1f}  {}\n", r.name, r.engine,
            r.model, r.stresses, bounded ? fmt::format("{:.2g}", r.error) : "-",
            bounded ? fmt::format("{:.2g}", r.bound) : "-", r.sonar,
            bounded ? fmt::format("{:.1e}", r.largest_difference) : "-", r.slowest_ms, verdict(r));
    }
    const auto failed = std::ranges::count_if(
        results, [](const HardResult& r) { return !r.holds() && r.known_fault.empty(); });
    const auto known = std::ranges::count_if(
        results, [](const HardResult& r) { return !r.holds() && !r.known_fault.empty(); });
    return text + fmt::format(
                      "{} verdicts: {} fail, {} are known faults. An error is the worst of all "
                      "sonars, sum |A - B| / sum B.\n",
                      results.size(), failed, known);
}

}  // namespace sonarsim
