#include "simulate/water/water_ray.h"

#include <algorithm>

#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// A ray that bends less than this, rad/m, is a line: it is off by 5 micrometres after 100 m.
constexpr double min_curvature = 1e-9;
constexpr double rounding_m = 1e-5;
// The speed changes by less than this share over a piece, so that series are exact to 1e-11.
constexpr double largest_change = 0.1;
// The least sine of elevation in the bend of a ray tube at a node; chosen. The gradient jumps at a
// node, and a ray that grazes the node would have a caustic that does not exist in the water.
constexpr double min_sine = 0.02;
// A nearly level ray may cross a node repeatedly; then it continues by this share of a piece.
constexpr double level_sine = 1e-3;
constexpr double level_share = 1e-3;

double curvature(const SoundProfile& profile, const WaterRay& ray) {
    return -profile.gradient(ray.layer) * sincos(ray.elevation_rad).cos /
           profile.speed_in(ray.layer, ray.height_m);
}

/// The length at which a ray meets the node above (side 1) or below it (side -1).
double length_to(const SoundProfile& profile, const WaterRay& ray, double node_m, double side) {
    const SinCos at = sincos(ray.elevation_rad);
    const double bend = curvature(profile, ray);
    if (std::fabs(bend) < min_curvature) {
        const double length = (node_m - ray.height_m) / at.sin;
        return side * at.sin > 0.0 ? std::max(length, 0.0) : infinite;
    }
    // Snell: cos(elevation) / c is constant; written so that nothing cancels at grazing angles.
    const double here = profile.speed_in(ray.layer, ray.height_m);
    const double there = profile.speed_in(ray.layer, node_m);
    const double cosine = at.cos * there / here;
    const double sine2 =
        at.sin * at.sin - at.cos * at.cos * (there - here) * (there + here) / (here * here);
    if (sine2 < 0.0) return infinite;  // the ray turns before the node
    const double elevation = arctan2(side * std::sqrt(sine2), cosine);
    const double length = (elevation - ray.elevation_rad) / bend;
    // A ray that starts at the node and leads to it meets it at once, despite rounding.
    if (side * at.sin >= 0.0 && length > -rounding_m) return std::max(length, 0.0);
    return length > 0.0 ? length : infinite;
}

/// Moves a ray at a node into the next layer. The kink of the speed bends neighbours differently.
void cross(const SoundProfile& profile, bool upwards, WaterRay& ray) {
    const std::size_t node = upwards ? ray.layer : ray.layer - 1;
    ray.height_m = profile.height_m[node];
    const double jump = profile.gradient(node + 1) - profile.gradient(node);
    const SinCos at = sincos(ray.elevation_rad);
    const double c = profile.speed_m_s[node];
    ray.tube_per_m_s -=
        ray.tube_m * jump * at.cos * at.cos / (c * c * std::max(std::fabs(at.sin), min_sine));
    ray.layer = upwards ? node + 1 : node;
}

}  // namespace

WaterRay water_ray(const SoundProfile& profile, double height_m, double elevation_rad) {
    return {.height_m = height_m,
            .elevation_rad = elevation_rad,
            .tube_per_m_s = 1.0 / profile.speed_at(height_m),
            .layer = profile.layer_of(height_m)};
}

WaterRay on_arc(const SoundProfile& profile, const WaterRay& ray, double length_m) {
    const double bend = curvature(profile, ray);
    const double gradient = profile.gradient(ray.layer);
    const double half = 0.5 * bend * length_m;
    const double half2 = half * half;
    const double chord = length_m * (1.0 - half2 / 6.0 * (1.0 - half2 / 20.0));
    const SinCos middle = sincos(ray.elevation_rad + half);
    WaterRay out = ray;
    out.along_m += chord * middle.cos;
    out.height_m += chord * middle.sin;
    out.elevation_rad += bend * length_m;
    const double from = profile.speed_in(ray.layer, ray.height_m);
    const double to = profile.speed_in(ray.layer, out.height_m);
    // The time between two points is (2 / g) arsinh(g chord / (2 sqrt(c1 c2))): the distance in a
    // hyperbolic plane, whose geodesics are such arcs.
    const double mean = std::sqrt(from * to);
    const double x2 = 0.25 * gradient * gradient * chord * chord / (mean * mean);
    out.time_s +=
        chord / mean * (1.0 - x2 / 6.0 * (1.0 - x2 * (9.0 / 20.0) * (1.0 - x2 * (25.0 / 42.0))));
    // The integral of the speed along the arc is a trapezium and its first correction.
    const double speed_m2_s =
        length_m * (0.5 * (from + to) - length_m * length_m * gradient * bend * middle.cos / 12.0);
    out.tube_m += ray.tube_per_m_s * speed_m2_s;
    return out;
}

double length_with_sag(const SoundProfile& profile, const WaterRay& ray, double sag_m) {
    const double bend = std::fabs(curvature(profile, ray));
    return bend > min_curvature ? std::sqrt(8.0 * sag_m / bend) : infinite;
}

double advance(const SoundProfile& profile, double longest_m, WaterRay& ray) {
    const double gradient = std::fabs(profile.gradient(ray.layer));
    double length = longest_m;
    if (gradient > 0.0) {
        length =
            std::min(length, largest_change * profile.speed_in(ray.layer, ray.height_m) / gradient);
    }
    const auto node = [&](std::size_t k) { return profile.height_m[k]; };
    const double up = ray.layer < profile.height_m.size()
                          ? length_to(profile, ray, node(ray.layer), 1.0)
                          : infinite;
    const double down =
        ray.layer > 0 ? length_to(profile, ray, node(ray.layer - 1), -1.0) : infinite;
    const double to_node = std::min(up, down);
    if (to_node > length) {
        ray = on_arc(profile, ray, length);
        return length;
    }
    const double min_length = level_share * length;
    if (to_node < min_length && std::fabs(sincos(ray.elevation_rad).sin) < level_sine) {
        ray = on_arc(profile, ray, min_length);
        ray.layer = profile.layer_of(ray.height_m);
        return min_length;
    }
    ray = on_arc(profile, ray, to_node);
    cross(profile, up < down, ray);
    return to_node;
}

Eigen::Vector3d place_of(const SoundProfile& profile, const Eigen::Vector3d& source,
                         const Eigen::Vector3d& direction, double range_m) {
    const double level = direction.head<2>().norm();
    WaterRay ray = water_ray(profile, source.z(), arctan2(direction.z(), level));
    const double time = range_m / profile.range_speed_m_s;
    const auto length_left = [&](const WaterRay& at) {
        return (time - at.time_s) * profile.speed_in(at.layer, at.height_m);
    };
    // The speed changes little over the rest, so each step converges fast.
    for (double left = length_left(ray); std::fabs(left) > 1e-9 * range_m;
         left = length_left(ray)) {
        if (left > 0.0)
            advance(profile, left, ray);
        else
            ray = on_arc(profile, ray, left);
    }
    const Eigen::Vector2d ahead =
        level > 0.0 ? Eigen::Vector2d(direction.head<2>() / level) : Eigen::Vector2d::Zero();
    Eigen::Vector3d place;
    place << source.head<2>() + ray.along_m * ahead, ray.height_m;
    return place;
}

std::optional<ApparentPlace> apparent_place(const SoundProfile& profile,
                                            const Eigen::Vector3d& source,
                                            const Eigen::Vector3d& place) {
    constexpr int max_steps = 20;
    constexpr double step_m = 0.01;
    const auto place_at = [&](const Eigen::Vector3d& apparent) {
        return place_of(profile, source, apparent.normalized(), apparent.norm());
    };
    // The map is nearly the identity, so what a place is off by corrects the apparent one.
    Eigen::Vector3d apparent = place - source;
    const double length = apparent.norm();
    double off_m = length;
    for (int k = 0; k < max_steps && off_m > 1e-7 * length; ++k) {
        const Eigen::Vector3d off = place - place_at(apparent);
        off_m = off.norm();
        if (!(off_m < 0.5 * length)) return std::nullopt;
        apparent += off;
    }
    if (!(off_m < 1e-5 * length)) return std::nullopt;
    Eigen::Matrix3d stretch;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d step = step_m * Eigen::Vector3d::Unit(k);
        stretch.col(k) = (place_at(apparent + step) - place_at(apparent - step)) / (2.0 * step_m);
    }
    const Eigen::Vector3d along = stretch * apparent.normalized();
    const double tube = std::max(std::fabs(stretch.determinant()) / along.norm(), min_spread);
    const auto R = Eigen::Quaterniond::FromTwoVectors(along, apparent);
    return ApparentPlace{place, apparent, R, 1.0 / (tube * tube),
                         (R * stretch - Eigen::Matrix3d::Identity()).norm()};
}

}  // namespace sonarsim
