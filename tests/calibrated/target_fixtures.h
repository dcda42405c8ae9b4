#pragma once

#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "core/units.h"
#include "ping/form_image.h"
#include "support/calibrated.h"
#include "support/scenes.h"

namespace sonarsim::test {

inline constexpr double slope_deg = 5.0;

inline constexpr EngineKind engine_kinds[] = {EngineKind::rays, EngineKind::slices,
                                              EngineKind::automatic};

inline double total(const std::vector<float>& image) {
    return std::accumulate(image.begin(), image.end(), 0.0);
}

inline double decibels(double ratio) {
    return 10.0 * std::log10(ratio);
}

/// A sonar of a kind with the beams of a usual instrument.
inline Sonar target_sonar(SonarKind kind) {
    SonarConfig config = calibrated(default_sonar(kind), 9e5);
    config.instrument = bare(config.instrument);
    config.range_min_m = 0.5;
    config.range_max_m = 20.0;
    config.range_bins = 400;
    config.azimuth_bins = 128;
    if (kind == SonarKind::sidescan) {
        config.elevation_deg = 6.0;
        config.instrument.beam.width_deg = 0.3;
        config.instrument.beam.tilt_deg = 30.0;
    }
    return make_sonar(config, {});
}

/// A sphere in a scene, and where it is.
struct BallScene {
    Scene scene = empty_scene();
    Eigen::Vector3d centre;
    double radius;

    BallScene(const Eigen::Vector3d& at, double radius_m, int sides)
        : centre(at), radius(radius_m) {
        const std::uint32_t metal = add_material(scene, 0.8F);
        scene.materials[metal].slope_rms_deg = slope_deg;
        add_sphere(scene, at.cast<float>(), static_cast<float>(radius_m), metal, sides);
        // A corner far away keeps the scene's bounds.
        add_quad(scene, {-40, -40, -40}, {-39, -40, -40}, {-39, -39, -40}, {-40, -39, -40}, metal);
    }
};

inline double energy_by(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                        const Pose& T_world_vehicle = {}) {
    return total(
        render_ping(sonar, scene, engine, T_world_vehicle, {}, direct_echoes_alone).intensity);
}

inline std::unique_ptr<VisibilityEngine> engine_of(const Scene& scene, EngineKind kind) {
    EngineSettings settings;
    settings.type = kind;
    return make_engine(scene, settings);
}

inline Sonar with_targets(Sonar sonar, const Scene& scene) {
    find_targets({&sonar, 1}, scene);
    return sonar;
}

/// The energy of a sphere from points on it, close together where it glints.
inline double energy_of_points(const Sonar& sonar, const BallScene& ball,
                               const Pose& T_world_vehicle = {}) {
    const Pose T_world_sensor = sensor_pose(sonar, T_world_vehicle, 0);
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
        const double low = angle(k);
        const double high = angle(k + 1.0);
        const double t = angle(k + 0.5);
        const double area =
            2.0 * pi * ball.radius * ball.radius * (std::cos(low) - std::cos(high)) / around;
        for (int j = 0; j < around; ++j) {
            const double turn = 2.0 * pi * (j + 0.5 * (k % 2)) / around;
            const Eigen::Vector3d n = std::cos(t) * to_sonar +
                                      std::sin(t) * (std::cos(turn) * across + std::sin(turn) * up);
            const Eigen::Vector3d p = c + ball.radius * n;
            const double height = -p.dot(n);
            if (height <= 0.0 || beam_of(sonar.settings.view, p.cast<float>()) < 0) continue;
            traced.samples.items.push_back({.position = p.cast<float>(),
                                            .edge_u = Eigen::Vector3f::Zero(),
                                            .edge_v = Eigen::Vector3f::Zero(),
                                            .normal = n.cast<float>(),
                                            .height_m = static_cast<float>(height),
                                            .area_m2 = static_cast<float>(area),
                                            .material = 0,
                                            .instance = 0});
        }
    }
    return total(form_image(traced, sonar.settings, ball.scene, {}, direct_echoes_alone).intensity);
}

}  // namespace sonarsim::test
