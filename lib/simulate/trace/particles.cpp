#include "simulate/trace/particles.h"

#include <cmath>

namespace sonarsim {

Eigen::Vector3d place_at(const Particle& particle, double time_s) {
    Eigen::Vector3d place = particle.start_m + time_s * particle.velocity_m_s;
    const double height = particle.top_m - particle.bottom_m;
    if (height > 0.0) {
        const double turns = (place.z() - particle.bottom_m) / height;
        place.z() = particle.bottom_m + (turns - std::floor(turns)) * height;
    }
    return place;
}

namespace {

/// Moves a point to where the sonar measures it.
void move_point(const PingMotion& motion, ViewShape shape, Sample& sample) {
    sample.position = measured_place(motion, shape, sample.position.cast<double>()).cast<float>();
    sample.height_m = sample.position.norm();
    sample.normal = -sample.position / sample.height_m;
}

}  // namespace

void add_particles(const Particles& particles, double time_s, const View& view,
                   const VisibilityEngine& engine, const Pose& T_world_sensor,
                   const PingMotion& motion, Samples& samples) {
    const GuardedField field(view);
    const Eigen::Quaterniond to_sensor = T_world_sensor.rotation.conjugate();
    std::vector<Sample> points;
    std::vector<SightPoint> sights;
    for (std::uint32_t k = 0; k < particles.all.size(); ++k) {
        const Particle& particle = particles.all[k];
        const Eigen::Vector3f place =
            (to_sensor * (place_at(particle, time_s) - T_world_sensor.translation)).cast<float>();
        const float range = place.norm();
        if (!(range > 0.0F && range < static_cast<float>(view.range_max_m)) ||
            !field.contains(place))
            continue;
        sights.push_back({place});
        points.push_back({.position = place,
                          .edge_u = Eigen::Vector3f::Zero(),
                          .edge_v = Eigen::Vector3f::Zero(),
                          .normal = -place / range,
                          .height_m = range,
                          .area_m2 = particle.section_m2,
                          .material = particle.material,
                          .instance = particle.instance,
                          .number = k,
                          .kind = SampleKind::particle});
    }
    const std::vector<bool> visible = engine.visible(T_world_sensor, sights);
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (!visible[k]) continue;
        samples.items.push_back(points[k]);
        if (!motion.is_still()) move_point(motion, view.shape, samples.items.back());
    }
}

}  // namespace sonarsim
