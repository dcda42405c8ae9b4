#include "validation/hard/cases.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

#include "core/clock.h"
#include "core/error.h"
#include "sonar/engine_settings.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

/// Describes the first invariant that the image breaks.
std::string broken_invariant(const Ping& ping, double brightest) {
    for (const float x : ping.intensity) {
        if (!std::isfinite(x)) return "a pixel is not finite";
        if (x < 0.0F) return "a pixel is negative";
        if (x > brightest) return fmt::format("a pixel is {}, above {}", x, brightest);
    }
    if (ping.counts.occupied_bins > ping.intensity.size()) return "more occupied bins than bins";
    return "";
}

double brightest_of(const HardCase& hard, const Scene& scene) {
    if (hard.noisy) return std::numeric_limits<double>::max();
    double most = hard.brightest;
    if (most == 0.0) {
        for (const Material& material : scene.materials)
            most = std::max(most, static_cast<double>(material.reflection));
    }
    // The margin covers the rounding of a mean: that of many thousand echoes is off by this much in
    // float.
    return most * (1.0 + 5e-5);
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

/// The error bound of an engine, and its known fault.
struct Standard {
    std::string engine;
    double bound;
    std::string known_fault;
};

Standard standard_of(const HardCase& hard, EngineKind engine) {
    const HardBounds& bounds = hard.bounds;
    switch (engine) {
        case EngineKind::octree:
            return {"octree", bounds.octree, hard.known.octree};
        case EngineKind::slices:
            return {"slices", bounds.slices < 0.0 ? bounds.rays : bounds.slices, hard.known.slices};
        default:
            return {"rays", bounds.rays, hard.known.rays};
    }
}

HardResult run(const HardCase& hard, const Scene& scene, EngineKind engine_kind) {
    const Standard standard = standard_of(hard, engine_kind);
    HardResult result{hard.name, hard.stresses, hard.expected, standard.engine};
    result.bound = standard.bound;
    result.known_fault = standard.known_fault;
    const double brightest = brightest_of(hard, scene);
    const EngineSettings settings = engine_settings(engine_kind);
    const std::unique_ptr<VisibilityEngine> engine = make_engine(scene, settings);
    for (const SonarKind kind :
         {SonarKind::imaging, SonarKind::profiling, SonarKind::sidescan, SonarKind::echosounder}) {
        const HardTrial trial = hard.trial(kind);
        const std::string refused = unsupported(settings, trial.sonar.settings.view);
        if (!refused.empty()) {
            result.refused = refused;
            if (engine_kind != EngineKind::octree || !hard.octree_may_refuse)
                result.broken = "refused: " + refused;
            continue;
        }
        Stopwatch watch;
        const Ping ping = render_ping(trial.sonar, scene, *engine, trial.T_world_vehicle, {1, 0});
        const double ms = 1e3 * watch.lap();
        result.slowest_ms = std::max(result.slowest_ms, ms);
        const std::string broken = broken_invariant(ping, brightest);
        if (!broken.empty()) result.broken = std::string(name_of(kind)) + ": " + broken;
        if (!hard.truth) continue;
        const Difference apart = compare(ping, hard.truth({scene, trial, kind, engine_kind, ping}));
        result.largest_difference = std::max(result.largest_difference, apart.largest);
        if (result.sonar.empty() || apart.relative > result.error) {
            result.error = apart.relative;
            result.sonar = name_of(kind);
        }
    }
    return result;
}

std::string verdict(const HardResult& result) {
    if (result.holds() && !result.refused.empty()) return "refused: " + result.refused;
    if (result.holds()) return result.known_fault.empty() ? "holds" : "holds, though known to fail";
    if (!result.known_fault.empty()) return "known fault: " + result.known_fault;
    return result.broken.empty() ? "FAILS" : "FAILS: " + result.broken;
}

}  // namespace

std::vector<HardCase> hard_cases() {
    std::vector<HardCase> all;
    for (std::vector<HardCase>& some :
         std::array{hard_places(), hard_geometry(), hard_numbers(), hard_sonar_limits(),
                    hard_noise(), hard_invariances()}) {
        std::move(some.begin(), some.end(), std::back_inserter(all));
    }
    return all;
}

std::vector<HardResult> run_hard_case(const HardCase& hard) {
    const Scene scene = hard.scene();
    return {run(hard, scene, EngineKind::rays), run(hard, scene, EngineKind::octree),
            run(hard, scene, EngineKind::slices)};
}

std::string hard_table(const std::vector<HardResult>& results) {
    std::string text =
        fmt::format("{:<32}{:<8}{:<50}{:>10}{:>10} {:<13}{:>9}{:>9}  {}\n", "case", "engine",
                    "stresses", "error", "bound", "worst", "max diff", "ms", "verdict");
    for (const HardResult& r : results) {
        const bool bounded = !r.sonar.empty();
        text += fmt::format("{:<32}{:<8}{:<50}{:>10}{:>10} {:<13}{:>9}{:>9.1f}  {}\n", r.name,
                            r.engine, r.stresses, bounded ? fmt::format("{:.2g}", r.error) : "-",
                            bounded ? fmt::format("{:.2g}", r.bound) : "-", r.sonar,
                            bounded ? fmt::format("{:.1e}", r.largest_difference) : "-",
                            r.slowest_ms, verdict(r));
    }
    const auto failed = std::ranges::count_if(
        results, [](const HardResult& r) { return !r.holds() && r.known_fault.empty(); });
    const auto known = std::ranges::count_if(
        results, [](const HardResult& r) { return !r.holds() && !r.known_fault.empty(); });
    const auto refused = std::ranges::count_if(
        results, [](const HardResult& r) { return r.holds() && !r.refused.empty(); });
    return text + fmt::format(
                      "{} verdicts: {} fail, {} are known faults, {} refused. An error is the "
                      "worst of the four sonars, sum |A - B| / sum B.\n",
                      results.size(), failed, known, refused);
}

}  // namespace sonarsim
