#include <cmath>

#include "core/units.h"
#include "validation/hard/tools.h"
#include "validation/shapes.h"

namespace sonarsim {

namespace {

using namespace shapes;

const Eigen::Vector3d utm(500000.0, 4800000.0, 0.0);

/// What the tank shows at home: neither a motion nor a scale can be told from an image.
std::vector<float> at_home(const HardLook& look) {
    return image_of(tank(), in_tank(look.kind), look.engine);
}

constexpr double grazing_height_m = 1.745e-3;

/// Looking along the floor: 0.01 degrees at 10 m.
HardTrial grazing(SonarKind kind) {
    HardTrial trial = over_floor(kind);
    trial.T_world_vehicle = {rotation_from_rpy(0.0, 0.0, 0.1), {0.31, 0.17, grazing_height_m}};
    return trial;
}

/// An imaging sonar sees the floor in every bin. What looks down sees none of it: within 85 degrees
/// of nadir it is nearer than 1.745 mm / cos 85 = 20 mm.
std::vector<float> grazing_law(const HardLook& look) {
    if (look.kind != SonarKind::imaging) return dark(look);
    std::vector<float> truth(look.ping.intensity.size());
    const std::vector<double>& edges = look.trial.sonar.range_edges_m;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const std::size_t i = k / static_cast<std::size_t>(look.ping.beams);
        truth[k] = static_cast<float>(0.5 * grazing_height_m / (0.5 * (edges[i] + edges[i + 1])));
    }
    return truth;
}

Scene floor_of(float reflection) {
    Scene scene = empty_scene();
    add_floor(scene, 30.0F, 0.0F, add_material(scene, reflection));
    return scene;
}

float reflection_of(double impedances) {
    const Water water;
    return static_cast<float>(
        power_reflection(impedances * water.density_kg_m3, water.sound_speed_m_s, water));
}

HardTrial plain(SonarKind kind) {
    return over_floor(kind);
}

}  // namespace

// The leaves of a scene larger than 8 m do not grow with it: in 50 km the octree may be off by
// twice its own error.
std::vector<HardCase> hard_numbers() {
    return {
        {"UTM, on the grid",
         "5e5, 4.8e6 m against the origin",
         "the image at the origin",
         [] { return moved_tank(utm); },
         [](SonarKind k) { return in_moved_tank(k, utm); },
         at_home,
         {1e-4, 1e-4}},
        {"UTM, off the grid",
         "512345.678, 4812345.678, -43.21 m",
         "the image at the origin",
         [] { return moved_tank(utm_odd); },
         [](SonarKind k) { return in_moved_tank(k, utm_odd); },
         at_home,
         {1e-4, 1e-4}},
        {"a tank of a millimetre",
         "8e-4 of its size, range 1 mm",
         "the image in full size",
         [] { return scaled_tank(1.25e-4); },
         [](SonarKind k) { return in_scaled_tank(k, 1.25e-4); },
         at_home,
         {1e-4, 1e-4}},
        {"a tank of 50 km",
         "6250 times its size, range 62 km",
         "the image in full size",
         [] { return scaled_tank(6250.0); },
         [](SonarKind k) { return in_scaled_tank(k, 6250.0); },
         at_home,
         {1e-4, 0.25}},
        {"grazing incidence",
         "down to 0.01 degrees",
         "R H / r in every bin",
         plain_floor,
         grazing,
         grazing_law,
         {0.01, 0.05}},
        {"impedance of water",
         "R = 0",
         "dark",
         [] { return floor_of(reflection_of(1.0)); },
         plain,
         dark,
         {0, 0}},
        {"1,000 times that of water",
         "R = 0.996",
         "R H / r",
         [] { return floor_of(reflection_of(1000.0)); },
         plain,
         [](const HardLook& look) { return plane_law(look, std::pow(999.0 / 1001.0, 2), 3.0); },
         {0.02, 0.02}},
    };
}

}  // namespace sonarsim
