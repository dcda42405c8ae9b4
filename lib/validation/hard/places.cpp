#include <algorithm>

#include "core/units.h"
#include "validation/hard/tools.h"
#include "validation/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

Scene inside_sphere() {
    Scene scene = empty_scene();
    add_sphere(scene, {0, 0, 0}, 5.0F, add_material(scene, 0.7F), 512);
    return scene;
}

HardTrial in_the_centre(SonarKind kind, const Tweak& tweak) {
    HardTrial trial = over_floor(kind, tweak);
    trial.T_world_vehicle.translation.setZero();
    return trial;
}

/// All of a sphere about the sonar is seen face on, at its radius: R in that bin, else nothing. The
/// facets' middles lie 5 (1 - cos(pi / 256)) < 0.4 mm nearer, well within the bin of 77 mm.
std::vector<float> sphere_law(const HardLook& look) {
    const View& view = look.trial.sonar.settings.view;
    std::vector<float> truth(look.ping.intensity.size(), 0.0F);
    const auto bin = static_cast<std::size_t>((5.0 - view.range_min_m) / view.bin_m());
    std::fill_n(truth.begin() + static_cast<std::ptrdiff_t>(bin * view.beams), view.beams, 0.7F);
    return truth;
}

HardTrial on_the_floor(SonarKind kind) {
    HardTrial trial = over_floor(kind, [](SonarConfig& c) { c.range_min_m = 0.0; });
    trial.T_world_vehicle.translation.z() = 0.0;
    return trial;
}

/// Sonar and floor turned about the sonar, so that rounding puts it above, on or below the plane.
Scene turned_floor() {
    Scene scene = plain_floor();
    add_quad(scene, {3, -9, -9}, {3, 9, -9}, {3, 9, 9}, {3, -9, 9}, 0);
    const Eigen::Matrix3f R = rotation_from_rpy(0.3, 0.7, 1.1).toRotationMatrix().cast<float>();
    for (Eigen::Vector3f& p : scene.vertices)
        p = R * (p - Eigen::Vector3f(0.31F, 0.17F, 0.0F));
    return scene;
}

HardTrial on_turned_floor(SonarKind kind) {
    HardTrial trial = on_the_floor(kind);
    trial.T_world_vehicle.translation.setZero();
    return trial;
}

HardTrial plain(SonarKind kind) {
    return over_floor(kind);
}

}  // namespace

std::vector<HardCase> hard_places() {
    return {
        {"on a surface",
         "height 0: no direction to the nearest point",
         "invariants",
         plain_floor,
         on_the_floor,
         {},
         {}},
        {"on a turned surface",
         "height 0 up to rounding",
         "invariants",
         turned_floor,
         on_turned_floor,
         {},
         {}},
        {"inside a solid",
         "walls 5 cm away all round, below range_min",
         "dark: all is nearer than range_min",
         [] {
             Scene scene = empty_scene();
             add_box(scene, {0.26F, 0.12F, 2.95F}, {0.36F, 0.22F, 3.05F},
                     add_material(scene, 0.5F));
             return scene;
         },
         plain,
         dark,
         {0.0, 0.0}},
        {"empty scene", "no triangle", "dark", [] { return empty_scene(); }, plain, dark, {0, 0}},
        {"empty field of view",
         "all surface behind the sonar",
         "dark",
         [] {
             Scene scene = empty_scene();
             add_floor(scene, 30.0F, 8.0F, add_material(scene, 0.5F));
             return scene;
         },
         plain,
         dark,
         {0, 0}},
        {"a closed mesh from inside",
         "two-sided surfaces, all round",
         "R in one bin",
         inside_sphere,
         [](SonarKind kind) { return in_the_centre(kind, {}); },
         sphere_law,
         {0.001, 0.02}},
    };
}

}  // namespace sonarsim
