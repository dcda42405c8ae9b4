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

// Scenes that are hard on the arithmetic, each with what must come out of it. Every case is run
// for all four kinds of sonar and with all engines.

/// One sonar in the scene of a case.
struct HardTrial {
    Sonar sonar;
    Pose T_world_vehicle;
};

/// What the expected image of a case may depend on.
struct HardContext {
    const Scene& scene;
    const HardTrial& trial;
    SonarKind kind;
    EngineKind engine;
    const Ping& ping;
};

/// Pixels of an expected image that may be anything.
inline constexpr float unchecked = -1.0F;

/// The largest error that each engine may make.
struct HardBounds {
    double rays = 0.0;
    double octree = 0.0;
    double slices = -1.0;  ///< below 0: that of the rays
};

/// What is known to be wrong, and why; empty: nothing.
struct KnownFaults {
    std::string rays;
    std::string octree;
    std::string slices = {};
};

struct HardCase {
    std::string name;
    std::string stresses;
    std::string expected;
    std::function<Scene()> scene;
    std::function<HardTrial(SonarKind)> trial;
    /// The image that must come out, [range_bins, beams]; none: the invariants alone are checked.
    std::function<std::vector<float>(const HardContext&)> truth = {};
    HardBounds bounds = {};
    bool noisy = false;      ///< may be brighter than the brightest material
    double brightest = 0.0;  ///< no pixel may be above; 0: the largest reflection of the scene
    KnownFaults known = {};
    bool octree_may_refuse = false;  ///< a mission that asks it for this; else it must render it
};

/// One case with one engine; of the four sonars the worst.
struct HardResult {
    std::string name, stresses, expected, engine;
    std::string sonar = {};  ///< that made the error
    double error = 0.0;      ///< sum |A - B| / sum B over the pixels that are checked
    double bound = 0.0;
    double largest_difference = 0.0;  ///< of any pixel, max |A - B|
    double slowest_ms = 0.0;          ///< of the four pings
    std::string broken = {};          ///< the invariant that does not hold; empty: all do
    std::string known_fault = {};
    std::string refused = {};  ///< why no mission may have these sonars with this engine

    bool holds() const { return broken.empty() && error <= bound; }
};

/// All cases, in the order of their subjects.
std::vector<HardCase> hard_cases();
std::vector<HardCase> hard_places();
std::vector<HardCase> hard_geometry();
std::vector<HardCase> hard_numbers();
std::vector<HardCase> hard_sonar_limits();
std::vector<HardCase> hard_noise();
std::vector<HardCase> hard_invariances();

/// Runs a case with the rays, the octree and the slices. What a mission would be refused for is
/// refused here, by the same check, and is not rendered. Invariants of every image: no NaN, nothing
/// infinite or negative, and nothing brighter than physics allows.
std::vector<HardResult> run_hard_case(const HardCase& hard);

/// The results as a table: case, what it stresses, error, bound, verdict.
std::string hard_table(const std::vector<HardResult>& results);

}  // namespace sonarsim
