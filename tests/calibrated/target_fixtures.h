#pragma once

#include "core/decibel.h"
#include "simulate/ping/sonar.h"
#include "support/calibrated.h"
#include "support/patches.h"

namespace sonarsim::test {

inline constexpr double slope_deg = 5.0;

/// A sonar of a kind with the beams of a usual instrument.
inline Sonar target_sonar(SonarKind kind, SpeckleMode speckle = SpeckleMode::none) {
    SonarConfig config = bare_sonar(default_sonar(kind), 9e5);
    config.instrument.speckle.mode = speckle;
    set_range(config, 0.5, 20.5, 400);
    config.azimuth_bins = 128;
    if (kind == SonarKind::sidescan) {
        config.elevation_deg = 6.0;
        config.instrument.beam.width_deg = 0.3;
        config.instrument.beam.tilt_deg = 30.0;
    }
    return make_sonar(config, {});
}

/// A scene of metal, material 0. A corner far away keeps its bounds.
inline Scene metal_scene() {
    Scene scene = empty_scene();
    scene.materials[add_material(scene, 0.8F)].slope_rms_deg = slope_deg;
    add_rectangle(scene, {-40, -40, -40}, {-39, -39, -40}, 0);
    return scene;
}

/// A sphere in a scene, and where it is.
struct BallScene {
    Scene scene = metal_scene();
    Eigen::Vector3d centre;
    double radius;

    BallScene(const Eigen::Vector3d& at, double radius_m, int sides)
        : centre(at), radius(radius_m) {
        add_sphere(scene, at.cast<float>(), static_cast<float>(radius_m), 0, sides);
    }
};

/// The energy of the direct echoes of a scene whose targets are found.
inline double energy_by(Sonar sonar, const Scene& scene, const VisibilityEngine& engine,
                        const Pose& T_world_vehicle = {}, const PingKey& key = {},
                        const Terms& terms = direct_echoes_alone) {
    find_targets({&sonar, 1}, scene);
    return total(render_ping(sonar, scene, engine, T_world_vehicle, key, terms).intensity);
}

inline double energy_by_rays(const Sonar& sonar, const Scene& scene) {
    return energy_by(sonar, scene, *engine_of(scene, EngineKind::rays));
}

/// The energy of a sphere from points on it, close together where it glints.
inline double energy_of_points(const Sonar& sonar, const BallScene& ball) {
    const Pose T_world_sensor = sensor_pose(sonar, {}, 0);
    const Eigen::Vector3d c =
        T_world_sensor.rotation.conjugate() * (ball.centre - T_world_sensor.translation);
    const Eigen::Vector3d to_sonar = -c.normalized();
    const Eigen::Vector3d across = to_sonar.unitOrthogonal();
    const Eigen::Vector3d up = to_sonar.cross(across);
    constexpr int rings = 300;
    constexpr int around = 96;
    TracedPing traced;
    traced.T_world_sensor = T_world_sensor;
    // Half of the rings lie within 5 slopes.
    const double glint = std::tan(radians(slope_deg)) * 5.0;
    const auto angle = [&](double k) {
        const double half = 0.5 * rings;
        return k < half ? glint * k / half : glint + (0.5 * pi - glint) * (k - half) / half;
    };
    for (int k = 0; k < rings; ++k) {
        const double t = angle(k + 0.5);
        const double area = 2.0 * pi * ball.radius * ball.radius *
                            (std::cos(angle(k)) - std::cos(angle(k + 1.0))) / around;
        for (int j = 0; j < around; ++j) {
            const double turn = 2.0 * pi * (j + 0.5 * (k % 2)) / around;
            const Eigen::Vector3d n = std::cos(t) * to_sonar +
                                      std::sin(t) * (std::cos(turn) * across + std::sin(turn) * up);
            const Eigen::Vector3d p = c + ball.radius * n;
            if (p.dot(n) >= 0.0 || beam_of(sonar.settings.view, p.cast<float>()) < 0) continue;
            Sample& point = traced.samples.items.emplace_back(
                patch_of(p.cast<float>(), n.cast<float>(), Eigen::Vector3f::Zero(),
                         Eigen::Vector3f::Zero()));
            point.area_m2 = static_cast<float>(area);
        }
    }
    return total(form_image(traced, sonar.settings, ball.scene, {}, direct_echoes_alone).intensity);
}

}  // namespace sonarsim::test
