#include <algorithm>

#include "core/units.h"
#include "hard/tools.h"
#include "support/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

Scene inside_sphere() {
    Scene scene = empty_scene();
    add_sphere(scene, {0, 0, 0}, 5.0F, add_material(scene, 0.7F), 512);
    return scene;
}

HardTrial in_the_centre(SonarKind kind) {
    HardTrial trial = over_floor(kind);
    trial.T_world_vehicle.translation.setZero();
    return trial;
}

/// A sphere about the sonar is at normal incidence everywhere: R in the bin of its radius, else
/// nothing. The facets' middles lie 5 (1 - cos(pi / 256)) < 0.4 mm nearer, well within the bin of
/// 77 mm.
std::vector<float> sphere_law(const HardContext& context) {
    const View& view = context.trial.sonar.settings.view;
    std::vector<float> truth(context.ping.intensity.size(), 0.0F);
    const auto bin = static_cast<std::size_t>((5.0 - view.range_min_m) / view.bin_m());
    std::fill_n(truth.begin() + static_cast<std::ptrdiff_t>(bin * view.beams), view.beams, 0.7F);
    return truth;
}

/// The scene of a sonar on a floor, rotated about the sonar, so that rounding puts the sonar above,
/// on or below the plane.
Scene turned_floor() {
    Scene scene = plain_floor();
    add_quad(scene, {3, -9, -9}, {3, 9, -9}, {3, 9, 9}, {3, -9, 9}, 0);
    const Eigen::Matrix3f R = rotation_from_rpy(0.3, 0.7, 1.1).toRotationMatrix().cast<float>();
    for (Eigen::Vector3f& p : scene.vertices)
        p = R * (p - Eigen::Vector3f(0.31F, 0.17F, 0.0F));
    return scene;
}

HardTrial on_turned_floor(SonarKind kind) {
    HardTrial trial = over_floor(kind, [](SonarConfig& c) { c.range_min_m = 0.0; });
    trial.T_world_vehicle.translation.setZero();
    return trial;
}

/// A wall along the boresight, so near that specular reflections from the floor run along the wall.
Scene wall_along() {
    Scene scene = plain_floor();
    add_quad(scene, {-9, 0.4F, 0}, {20, 0.4F, 0}, {20, 0.4F, 6}, {-9, 0.4F, 6}, 0);
    return scene;
}

}  // namespace

std::vector<HardCase> hard_places() {
    return {{.name = "on a turned surface",
             .stresses = "height 0 up to rounding",
             .scene = turned_floor,
             .trial = on_turned_floor},
            {.name = "inside a solid",
             .stresses = "walls 5 cm away all round, below range_min",
             .scene =
                 [] {
                     Scene scene = empty_scene();
                     add_box(scene, {0.26F, 0.12F, 2.95F}, {0.36F, 0.22F, 3.05F},
                             add_material(scene, 0.5F));
                     return scene;
                 },
             .truth = dark,
             .bounds = {0.0}},
            {.name = "empty scene",
             .stresses = "no triangle",
             .scene = [] { return empty_scene(); },
             .truth = dark,
             .bounds = {0}},
            {.name = "empty field of view",
             .stresses = "all surface behind the sonar",
             .scene =
                 [] {
                     Scene scene = empty_scene();
                     add_floor(scene, 30.0F, 8.0F, add_material(scene, 0.5F));
                     return scene;
                 },
             .truth = dark,
             .bounds = {0}},
            {.name = "a closed mesh from inside",
             .stresses = "two-sided surfaces, all round",
             .scene = inside_sphere,
             .trial = in_the_centre,
             .truth = sphere_law,
             .bounds = {0.001}},
            {.name = "multipath on a surface",
             .stresses = "sources without a direction",
             .scene = wall_along,
             .trial = [](SonarKind kind) {
                 HardTrial trial = over_floor(
                     kind, [](SonarConfig& c) { c.multipath.method = MultipathMethod::cluster; });
                 trial.T_world_vehicle = {
                     rotation_from_rpy(0.0, looks_forward(kind) ? radians(30.0) : 0.0, 0.0),
                     {0.0, 0.39, 0.0}};
                 return trial;
             }}};
}

}  // namespace sonarsim
