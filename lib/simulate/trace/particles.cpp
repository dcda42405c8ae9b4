#include "simulate/trace/particles.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/decibel.h"
#include "simulate/trace/visible_surface.h"

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

void Particles::add(const TraceContext& context, const PingMotion& motion, std::uint32_t pose,
                    Samples& samples) const {
    const auto& [view, scene, engine, T_world_sensor] = context;
    const GuardedField field(view);
    const Eigen::Quaterniond to_sensor = T_world_sensor.rotation.conjugate();
    std::vector<Sample> points;
    std::vector<SightPoint> sights;
    for (std::uint32_t k = 0; k < all_.size(); ++k) {
        const Particle& particle = all_[k];
        const Eigen::Vector3d at = place_at(particle, time_s(pose));
        if (scene.water_surface && at.z() > scene.water_surface->height_m) continue;
        const Eigen::Vector3f place = (to_sensor * (at - T_world_sensor.translation)).cast<float>();
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

void Particles::describe(const Samples& samples, const Scene& scene, std::uint32_t pose,
                         nlohmann::ordered_json& ping) const {
    struct Sum {
        int count = 0;
        double section_m2 = 0.0;
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
    };
    std::map<std::uint32_t, Sum> sums;  // keyed by instance
    for (const Sample& sample : samples.in_no_beam()) {
        if (sample.kind != SampleKind::particle) continue;
        Sum& sum = sums[sample.instance];
        ++sum.count;
        sum.section_m2 += all_[sample.number].section_m2;
        sum.place += place_at(all_[sample.number], time_s(pose));
    }
    nlohmann::ordered_json& json = ping["particles"] = nlohmann::ordered_json::object();
    for (const auto& [instance, sum] : sums) {
        const Eigen::Vector3d place = sum.place / sum.count;
        // To a hundredth of a decibel, since the cross-sections are floats.
        const double strength_db = std::round(100.0 * db_of_power(sum.section_m2)) / 100.0;
        json[scene.instances[instance]] = {{"count", sum.count},
                                           {"position_m", {place.x(), place.y(), place.z()}},
                                           {"target_strength_db", strength_db}};
    }
}

}  // namespace sonarsim
