#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/pose.h"
#include "mission/mission.h"
#include "scene/scene.h"
#include "sonar/sonar.h"
#include "trace/ping.h"

namespace sonarsim {

// Scenes that are hard on the arithmetic, each with its expected result. Every case is run for all
// kinds of sonar, with all engines and both echo models.

/// One sonar in the scene of a case.
struct HardTrial {
    Sonar sonar;
    Pose T_world_vehicle;
};

/// A sonar of hard/tools.h three metres over z = 0.
HardTrial plain_sonar_over_floor(SonarKind kind);

/// The inputs of a case's expected image.
struct HardContext {
    const Scene& scene;
    const HardTrial& trial;
    SonarKind kind;
    EngineKind engine;
    ModelKind model;
    const Ping& ping;
};

/// Marks pixels of an expected image that are not checked.
inline constexpr float unchecked = -1.0F;

/// The largest permitted error of each engine.
struct HardBounds {
    double rays = 0.0;
    double slices = -1.0;  ///< below 0: the same as for rays
};

struct HardCase {
    std::string name;
    std::string stresses;
    std::function<Scene()> scene;
    std::function<HardTrial(SonarKind)> trial = plain_sonar_over_floor;
    /// The expected image, [range_bins, beams]; none: only the invariants are checked.
    std::function<std::vector<float>(const HardContext&)> truth = {};
    HardBounds bounds = {};
    /// True if every echo model must give the expected image, not only the paper's. The image of
    /// another model is compared without its random terms.
    bool truth_of_any_model = false;
    std::string known_fault_of_rays = {};  ///< empty: none
};

/// One case with one engine and one echo model; the worst of the sonars.
struct HardResult {
    std::string name, stresses, engine, model;
    std::string sonar = {};  ///< the sonar with the largest error
    double error = 0.0;      ///< sum |A - B| / sum B over the pixels that are checked
    double bound = 0.0;
    double largest_difference = 0.0;  ///< largest difference of a pixel, max |A - B|
    double slowest_ms = 0.0;          ///< slowest of the pings
    std::string broken = {};          ///< the broken invariant; empty: none
    std::string known_fault = {};

    bool holds() const { return broken.empty() && error <= bound; }
};

/// All cases, in the order of their subjects.
std::vector<HardCase> hard_cases();
std::vector<HardCase> hard_places();
std::vector<HardCase> hard_geometry();
std::vector<HardCase> hard_numbers();
std::vector<HardCase> hard_sonar_limits();
std::vector<HardCase> hard_invariances();

/// The same sonar with another echo model. Its calibrated receiver has neither noise nor
/// quantization that would hide a difference of images.
HardTrial with_model(HardTrial trial, ModelKind model);

/// The terms of an echo model in an image that is compared with an expected one.
Terms compared_terms(ModelKind model);

/// Runs a case with the rays and the slices, and with every echo model; a model for
/// which the case has no expected image runs with the rays alone. Invariants of every image: no
/// pixel is NaN, infinite, negative or brighter than physics allows.
std::vector<HardResult> run_hard_case(const HardCase& hard);

/// The results as a table: case, what it stresses, error, bound, verdict.
std::string hard_table(const std::vector<HardResult>& results);

}  // namespace sonarsim
