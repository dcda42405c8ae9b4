#include "trace/mirrored_footprint.h"

#include <cmath>

namespace sonarsim {

MirroredPiece mirrored_footprint(const SecondLegs& context, const Sample& sample,
                                 const SecondHit& second) {
    // As in find_bounces: from the mirror image of the sonar through p_i sound goes straight on.
    const Eigen::Vector3f from = 2.0F * sample.normal.dot(sample.position) * sample.normal;
    const Eigen::Vector3f through = sample.position - from;
    const float along = through.dot(second.normal);
    const float t = (second.point - from).dot(second.normal) / along;
    const Eigen::Vector3f p = from + t * through;
    const Eigen::Vector3f back = p - context.sonar();
    const float first_leg = sample.position.norm();
    const float last_leg = back.norm();

    MirroredPiece out;
    out.point.at = context.seen(p);
    out.image.at = t * sample.position;
    const auto move = [&](const Eigen::Vector3f& edge, Eigen::Vector3f& of_point,
                          Eigen::Vector3f& of_image) {
        const float stretch = -t * edge.dot(second.normal) / along;
        of_point = context.seen_change(t * edge + stretch * through);
        of_image = t * edge + stretch * sample.position;
    };
    move(sample.edge_u, out.point.u, out.image.u);
    move(sample.edge_v, out.point.v, out.image.v);
    out.sine_of_image = std::fabs(along) / first_leg;
    out.sine_of_point = -second.normal.dot(back) / last_leg;
    const Eigen::Vector3f midway = through / first_leg + back / last_leg;
    out.sine_between = (out.sine_of_image + out.sine_of_point) / midway.norm();
    out.area_m2 = sample.area_m2 * sample.height_m / first_leg * t * t / out.sine_of_image;
    out.reflection = context.materials[sample.material].reflection * second.mirrored;
    out.material = second.material;
    return out;
}

}  // namespace sonarsim
