#include "simulate/calibrated/equation/patches.h"

namespace sonarsim {

PieceStrengths::PieceStrengths(const TracedPing& traced, const Scene& scene, ViewShape shape)
    : maps_(traced.map_strengths == MapStrengths::at_points && scene.maps &&
                    scene.maps->have_strengths()
                ? scene.maps.get()
                : nullptr),
      places_{traced.T_world_sensor, scene.sound_profile.get(), traced.motion, shape},
      R_(traced.T_world_sensor.rotation.toRotationMatrix().topRows<2>()) {}

Eigen::Vector2d PieceStrengths::ground_of(const Eigen::Vector3f& point) const {
    const Eigen::Vector3d measured = point.cast<double>();
    if (!places_.is_measured()) return places_.of(measured).head<2>();
    return R_ * measured + places_.T_world_sensor.translation.head<2>();
}

/// Half of the box around a piece, seen from above.
Eigen::Vector2d PieceStrengths::half_of_piece(const Sample& sample,
                                              const PointLimits& limits) const {
    const Arrival at = arrival_of(sample.position);
    const auto half_of = [&](const Eigen::Vector3f& edge) -> Eigen::Vector2d {
        const int parts = patches_along(extents_of(edge, at.direction), at.range_m, limits);
        return (R_ * edge.cast<double>()).cwiseAbs() / parts;
    };
    return half_of(sample.edge_u) + half_of(sample.edge_v);
}

void PieceStrengths::apply(std::span<const Sample> surface, const PatchBlock& pieces,
                           const PointLimits* limits, PatchBlock::Array<float>& power) const {
    if (!maps_) return;
    const Sample* last_sample = nullptr;
    Eigen::Vector2d half_m = Eigen::Vector2d::Zero();
    for (int k = 0; k < pieces.count; ++k) {
        const Sample& sample = surface[pieces.sample[k]];
        if (sample.kind == SampleKind::target || !(power[k] > 0.0F) ||
            !maps_->lie_on(sample.instance))
            continue;
        if (limits && &sample != last_sample) {
            last_sample = &sample;
            half_m = half_of_piece(sample, *limits);
        }
        const Eigen::Vector3f point{pieces.x[k], pieces.y[k], pieces.z[k]};
        power[k] *= maps_->strength_over(sample.instance, ground_of(point), half_m);
    }
}

float PieceStrengths::at(const Sample& sample) const {
    if (!maps_ || sample.kind == SampleKind::target) return 1.0F;
    return maps_->strength_over(sample.instance, ground_of(sample.position),
                                Eigen::Vector2d::Zero());
}

}  // namespace sonarsim
