#pragma once

#include <immintrin.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

// Arrivals: the range and the direction that a sonar measures of sound from a point. All code after
// the trace takes ranges and directions from here; no other code derives them from positions.
// Positions are apparent places (simulate/visibility/engine.h): half of the two-way time at one
// speed, in the direction of arrival. So paths are straight here, and the same out and back, even
// where a profile bends the sound; simulate/trace/ping_motion.h gives the place in the world.

namespace sonarsim {

/// The arrival of the sound that a point sends back.
struct Arrival {
    float range_m;              ///< one-way equivalent slant range, m: half of the two-way path
    Eigen::Vector3f direction;  ///< unit, sensor frame: of departure and of return
};

/// The range of a point in the sensor frame, m.
inline float arrival_range(const Eigen::Vector3f& point) {
    return point.norm();
}

inline Arrival arrival_of(const Eigen::Vector3f& point) {
    const float range = arrival_range(point);
    return {range, point / range};
}

/// The extents of an edge: in range, and across it along y and z, m. All have signs.
struct EdgeExtents {
    float depth, y, z;
};
inline EdgeExtents extents_of(const Eigen::Vector3f& edge, const Eigen::Vector3f& direction) {
    const float depth = edge.dot(direction);
    return {depth, edge.y() - depth * direction.y(), edge.z() - depth * direction.z()};
}

/// The range of a two-way path of out_m + back_m, m.
inline float arrival_range(float out_m, float back_m) {
    return 0.5F * (out_m + back_m);
}

/// An arrival in a loop over arrays: the same numbers as arrival_of().
struct ArrivalLane {
    float range_m, x, y, z;
};
inline ArrivalLane arrival_at(float x, float y, float z) {
    const float range = std::sqrt(x * x + (y * y + z * z));
    return {range, x / range, y / range, z / range};
}

// Ranges of pieces of footprints, in fused arithmetic: as arrival_range() to the last bit or two.
inline float piece_range(float x, float y, float z) {
    return std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
}
inline double piece_range(double x, double y, double z) {
    return std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
}
inline __m256 piece_range(__m256 x, __m256 y, __m256 z) {
    return _mm256_sqrt_ps(_mm256_fmadd_ps(x, x, _mm256_fmadd_ps(y, y, _mm256_mul_ps(z, z))));
}

/// The sine of a piece's angle to the plane across an axis of the sensor, by its coordinate there.
inline float piece_sine(float coordinate_m, float range_m) {
    return coordinate_m * (1.0F / range_m);
}

/// The extent of a patch in range before and after the range of its centre.
struct RangeExtent {
    float before;
    float after;
};

/// Along a half edge e of depth d the range is r + d s + c s^2, s in [-1, 1], with c = (e^2 - d^2)
/// / (2 r): both ends are farther than the depth alone predicts, and if the foot of the
/// perpendicular lies on the edge, the nearest point is there and not at an end.
inline RangeExtent extent_of(float squared_edge, float depth_m, float range_m) {
    const float bend = std::max(squared_edge - depth_m * depth_m, 0.0F) / (2.0F * range_m);
    const float before_foot = 0.25F * depth_m * depth_m / bend;
    return {.before = depth_m >= 2.0F * bend ? depth_m - bend : before_foot,
            .after = depth_m + bend};
}

}  // namespace sonarsim
