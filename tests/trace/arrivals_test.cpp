#include "simulate/trace/arrivals.h"

#include <bit>

#include "support/draws.h"

namespace {

bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

}  // namespace

// A piece's range is off by a relative error of 2^-24 each of a product, two fused sums and a root,
// of which the first three are halved by the root: 2.5 in all. In double `exact` is off as well.
TEST_CASE("arrivals: in still water they are the geometry, and those of pieces within rounding") {
    // Points from a micrometre to a thousand kilometres off, in all directions and on the axes.
    Draws draws(20);
    for (int k = 0; k < 100'000; ++k) {
        Eigen::Vector3f point = draws.in_ball();
        if (k % 7 == 0) point[k % 3] = 0.0F;
        if (k % 11 == 0) point = Eigen::Vector3f::Unit(k % 3);
        point *= draws.scale(1e-6F, 1e6F);
        const float range = point.norm();
        const Arrival arrival = arrival_of(point);
        REQUIRE(same_bits(arrival.range_m, range));
        REQUIRE(same_bits(arrival_range(point), range));
        const ArrivalLane lane = arrival_at(point.x(), point.y(), point.z());
        REQUIRE(same_bits(lane.range_m, range));
        const std::array<float, 3> lane_direction{lane.x, lane.y, lane.z};
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(same_bits(arrival.direction[axis], point[axis] / range));
            REQUIRE(same_bits(lane_direction[axis], point[axis] / range));
        }
        const Eigen::Vector3d p = point.cast<double>();
        const double exact = std::sqrt(p.x() * p.x() + p.y() * p.y() + p.z() * p.z());
        const float piece = piece_range(point.x(), point.y(), point.z());
        REQUIRE(std::fabs(piece - exact) <= 2.5 * 0x1p-24 * exact);
        alignas(32) std::array<float, 8> lanes;
        _mm256_store_ps(lanes.data(),
                        piece_range(_mm256_set1_ps(point.x()), _mm256_set1_ps(point.y()),
                                    _mm256_set1_ps(point.z())));
        for (const float one : lanes)
            REQUIRE(same_bits(one, piece));
        REQUIRE(std::fabs(piece_range(p.x(), p.y(), p.z()) - exact) <= 5.0 * 0x1p-53 * exact);
    }
}
