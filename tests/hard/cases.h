#pragma once

#include "simulate/sonar/sonar.h"
#include "simulate/trace/ping.h"
#include "support/test.h"

namespace sonarsim {

// Scenes that are hard on the arithmetic, each with its expected result. Every case is run for all
// kinds of sonar, with rays and strips and both echo models.

/// One sonar in the scene of a case.
struct HardTrial {
    Sonar sonar;
    Pose T_world_vehicle;
};

/// A change that a case makes to the sonar.
using ConfigChange = std::function<void(SonarConfig&)>;

/// A small noise-free sonar with a gain of 1, from 0.2 to 10 m: three metres over z = 0, pitched
/// down by 30 degrees if it looks forward, or in the tank of shapes.h.
HardTrial over_floor(SonarKind kind, const ConfigChange& change = {});
HardTrial in_tank(SonarKind kind, const ConfigChange& change = {});

/// True for a sonar whose default mount looks forward.
bool looks_forward(SonarKind kind);

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

/// The largest permitted error of each engine, sum |A - B| / sum B.
struct HardBounds {
    double rays = 0.0;
    double strips = -1.0;  ///< below 0: the same as for rays
};

struct HardCase {
    std::string name;
    Scene scene;
    bool starts_in_tank = false;  ///< the trial is in_tank(), else over_floor()
    ConfigChange change = {};
    std::function<void(SonarKind, Pose&)> move = {};  ///< moves the vehicle from its place there
    /// The expected image, [range_bins, beams]; none: only the invariants are checked.
    std::function<std::vector<float>(const HardContext&)> truth = {};
    HardBounds bounds = {};
    /// True if every echo model must give the expected image, not only the paper's. The image of
    /// another model is compared without its random terms.
    bool truth_of_any_model = false;
    bool rays_fail = false;  ///< a known fault

    HardTrial trial(SonarKind kind) const;
};

/// Floors, walls and rooms; triangles that are odd; the tank, changed without changing an image.
std::vector<HardCase> hard_places();
std::vector<HardCase> hard_geometry();
std::vector<HardCase> hard_invariances();

/// A floor of 60 m at z = 0, R = 0.5.
Scene plain_floor();

/// The image of a plane at distance H: v . n = H / r, so R H / r in the middle of each bin with an
/// echo, to second order in bin / r. Not checked: dark pixels, and the first and the last filled
/// bin of a beam, which the plane fills in part.
std::vector<float> plane_law(const HardContext& context, double reflection, double height_m);

/// plane_law() at three metres over plain_floor().
std::vector<float> floor_law(const HardContext& context);

/// The brute-force reference after settling to 0.2 % or after two million rays.
std::vector<float> settled_reference(const HardContext& context);

/// The image of any scene with an engine and an echo model, to compare others with; without the
/// random terms of the calibrated model.
std::vector<float> image_of(const Scene& scene, const HardTrial& trial, EngineKind engine,
                            ModelKind model = ModelKind::paper);

/// The image of the tank from in_tank(), with the engine and the model of the context.
std::vector<float> tank_image(const HardContext& context);

/// The same sonar with another echo model. Its calibrated receiver has neither noise nor
/// quantization that would hide a difference of images.
HardTrial with_model(HardTrial trial, ModelKind model);

}  // namespace sonarsim
