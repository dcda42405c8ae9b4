#include "trace/buried.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// The angle to the normal, in the water, of the refracted path that ends `across_m` along the
/// plane. This distance grows with the angle, to infinity at the critical angle or at 90 degrees.
double refraction_angle(double speed_ratio, double height_m, double depth_m, double across_m) {
    double low = 0.0;
    double high = 1.0;  // as a share of the greatest sine
    const double most = std::min(1.0, 1.0 / speed_ratio);
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        const double sine = middle * most;
        const double below = speed_ratio * sine;
        const double reached = height_m * sine / std::sqrt((1.0 - sine) * (1.0 + sine)) +
                               depth_m * below / std::sqrt((1.0 - below) * (1.0 + below));
        (reached < across_m ? low : high) = middle;
    }
    return arctan2(low * most, std::sqrt((1.0 - low * most) * (1.0 + low * most)));
}

/// The path of sound to a buried place.
struct BuriedSight {
    Eigen::Vector3d leaves;   ///< direction in which sound leaves for it
    Eigen::Vector3d arrives;  ///< direction in which that sound arrives there
    double range_m;           ///< half of the two-way time times the speed of sound in water
    double echo;              ///< echo_through_bottom()
};

/// `along_m`: the distance at which the straight line to the place meets the bottom.
std::optional<BuriedSight> sight_of(std::span<const SedimentPath> sediments,
                                    const Eigen::Vector3d& place, double along_m,
                                    const Intersection& hit) {
    const double range = place.norm();
    if (!(along_m > 0.0 && along_m < range) || hit.material >= sediments.size())
        return std::nullopt;
    const SedimentPath& sediment = sediments[hit.material];
    if (sediment.speed_ratio == 0.0) return std::nullopt;
    const Eigen::Vector3d normal = hit.normal.cast<double>();
    const double cosine = -normal.dot(place) / range;
    const Eigen::Vector3d along = place + range * cosine * normal;
    const double across = along.norm();
    const WayIntoBottom way =
        way_into_bottom(sediment, along_m * cosine, (range - along_m) * cosine, across);
    const auto direction = [&](double sine) -> Eigen::Vector3d {
        const Eigen::Vector3d down =
            -std::sqrt(std::max((1.0 - sine) * (1.0 + sine), 0.0)) * normal;
        return across > 0.0 ? down + sine / across * along : down;
    };
    const double sine = sincos(way.angle_rad).sin;
    return BuriedSight{direction(sine), direction(std::min(sediment.speed_ratio * sine, 1.0)),
                       way.range_m(sediment), echo_through_bottom(sediment, way)};
}

}  // namespace

WayIntoBottom way_into_bottom(const SedimentPath& sediment, double height_m, double depth_m,
                              double across_m) {
    const double n = sediment.speed_ratio;
    const double angle = refraction_angle(n, height_m, depth_m, across_m);
    const SinCos water = sincos(angle);
    const double sine = n * water.sin;
    const double cosine = std::sqrt(std::max((1.0 - sine) * (1.0 + sine), 1e-12));
    WayIntoBottom way{};
    way.angle_rad = angle;
    way.in_water_m = height_m / water.cos;
    way.in_sediment_m = depth_m / cosine;
    // The ring of angles from t to t + dt has the solid angle 2 pi sin(t) dt. Its area at the place
    // is 2 pi x dx cos(t'), with x = h tan(t) + d tan(t') and cos(t') dt' = n cos(t) dt. The ratio
    // x / sin(t) is finite at t = 0.
    const double x_by_sine = height_m / water.cos + depth_m * n / cosine;
    const double dx =
        height_m / (water.cos * water.cos) + depth_m * n * water.cos / (cosine * cosine * cosine);
    way.spread_m2 = x_by_sine * dx * cosine;
    const double impedance = sediment.density_ratio * n * water.cos / cosine;  // the water's is 1
    const double reflected = (impedance - 1.0) / (impedance + 1.0);
    way.transmitted = 1.0 - reflected * reflected;
    return way;
}

double echo_through_bottom(const SedimentPath& sediment, const WayIntoBottom& way) {
    const double range2 = way.range_m(sediment) * way.range_m(sediment);
    const double one_way = way.transmitted * sediment.speed_ratio * range2 / way.spread_m2;
    return one_way * one_way * exponential(-sediment.loss_per_m * way.in_sediment_m);
}

double most_distance_by_range(std::span<const SedimentPath> sediments) {
    double most = 1.0;
    for (const SedimentPath& sediment : sediments)
        most = std::max(most, sediment.speed_ratio);
    return most;
}

std::optional<Sample> seen_buried(std::span<const SedimentPath> sediments, const Sample& point,
                                  const Intersection& hit) {
    const auto sight = sight_of(sediments, point.position.cast<double>(), hit.distance_m, hit);
    if (!sight) return std::nullopt;
    Sample seen = point;
    seen.position = (sight->range_m * sight->leaves).cast<float>();
    seen.normal = -sight->leaves.cast<float>();
    seen.height_m = static_cast<float>(sight->range_m);
    seen.area_m2 = static_cast<float>(point.area_m2 * sight->echo);
    return seen;
}

std::optional<TargetFacet> seen_buried(std::span<const SedimentPath> sediments,
                                       const TargetFacet& part, const Ray& ray,
                                       const Intersection& hit) {
    const Eigen::Vector3f middle = (part.corners[0] + part.corners[1] + part.corners[2]) / 3.0F;
    const Eigen::Vector3d place = middle.cast<double>();
    // The straight line to the part itself meets the bottom here.
    const Eigen::Vector3d normal = hit.normal.cast<double>();
    const double along =
        ray.direction.cast<double>().dot(normal) / place.normalized().dot(normal) * hit.distance_m;
    const auto sight = sight_of(sediments, place, along, hit);
    if (!sight) return std::nullopt;
    const Eigen::Matrix3f turn = Eigen::Quaterniond::FromTwoVectors(sight->arrives, sight->leaves)
                                     .toRotationMatrix()
                                     .cast<float>();
    const Eigen::Vector3f seen_middle = (sight->range_m * sight->leaves).cast<float>();
    TargetFacet seen = part;
    seen.normal = turn * part.normal;
    if (!(seen.normal.dot(seen_middle) < 0.0F)) return std::nullopt;
    for (int k = 0; k < 3; ++k) {
        seen.corners[k] = seen_middle + turn * (part.corners[k] - middle);
        seen.normals[k] = turn * part.normals[k];
    }
    seen.strength *= static_cast<float>(sight->echo);
    seen.buried = true;
    return seen;
}

}  // namespace sonarsim
