#include "trace/ball_in_view.h"

#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

Containment ball_in_view(const View& view, const View& widened, bool guarded,
                         const TargetBall& ball) {
    const Eigen::Vector3f& centre = ball.centre;
    const float radius = ball.radius_m;
    const auto compare = [](float angle, double full, float margin) {
        const auto half = static_cast<float>(0.5 * full);
        if (angle > half + margin) return Containment::outside;
        return angle + margin < half ? Containment::inside : Containment::partly;
    };
    const auto angle = [](float height, float ahead) {
        return std::fabs(arctan2_float(height, ahead));
    };
    // The angle between the middle of a ball and its edge.
    const auto margin = [&](float distance) {
        return angle(radius, std::sqrt(distance * distance - radius * radius));
    };
    const float ground = std::sqrt(centre.x() * centre.x() + centre.y() * centre.y());
    if (view.shape == ViewShape::cone) {
        const float off = std::sqrt(centre.y() * centre.y() + centre.z() * centre.z());
        return compare(angle(off, centre.x()), view.azimuth_rad, margin(ball.range_m));
    }
    const Containment by_elevation =
        compare(angle(centre.z(), ground), widened.elevation_rad, margin(ball.range_m));
    const Containment by_azimuth = ground <= radius ? Containment::partly
                                                    : compare(angle(centre.y(), centre.x()),
                                                              widened.azimuth_rad, margin(ground));
    if (by_elevation == Containment::outside || by_azimuth == Containment::outside)
        return Containment::outside;
    const bool inside =
        by_elevation == Containment::inside && by_azimuth == Containment::inside && !guarded;
    return inside ? Containment::inside : Containment::partly;
}

}  // namespace sonarsim
