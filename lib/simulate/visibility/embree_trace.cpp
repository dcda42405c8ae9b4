#include "simulate/visibility/embree_trace.h"

#include <algorithm>
#include <limits>

namespace sonarsim {

namespace {

constexpr int packet = 8;
constexpr std::uint32_t no_hit = RTC_INVALID_GEOMETRY_ID;

/// Stores the facets that a packet has met in a layer. Embree has shortened the rays, so a hit in
/// the next layer has to be nearer.
void take_hits(RTCRayHit8& rays, int count, const TracedLayer& layer,
               std::span<std::uint32_t> facets) {
    for (int k = 0; k < count; ++k) {
        const std::uint32_t met = rays.hit.primID[k];
        if (met == no_hit) continue;
        const unsigned int instance = rays.hit.instID[0][k];
        facets[k] = met + layer.first_facet[instance == no_hit ? rays.hit.geomID[k] : instance];
    }
    for (int k = 0; k < packet; ++k) {
        rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.primID[k] = no_hit;
    }
}

}  // namespace

void trace_packets(std::span<const TracedLayer> layers, const RayOrigins& origins,
                   std::span<const Eigen::Vector3f> directions, float reach_m, RaySpread spread,
                   std::span<std::uint32_t> facets) {
    alignas(64) RTCRayHit8 rays;
    alignas(64) int valid[packet];
    for (int k = 0; k < packet; ++k) {
        rays.ray.tnear[k] = 0.0F;
        rays.ray.time[k] = 0.0F;
        rays.ray.mask[k] = 0xFFFFFFFFU;
        rays.ray.id[k] = 0;
        rays.ray.flags[k] = 0;
    }
    for (std::size_t first = 0; first < directions.size(); first += packet) {
        const int count =
            static_cast<int>(std::min<std::size_t>(packet, directions.size() - first));
        for (int k = 0; k < packet; ++k) {
            // A short packet repeats its last ray, so the idle lanes are harmless.
            const std::size_t i = first + std::min(k, count - 1);
            const Eigen::Vector3f& origin = origins.of(i);
            rays.ray.org_x[k] = origin.x();
            rays.ray.org_y[k] = origin.y();
            rays.ray.org_z[k] = origin.z();
            rays.ray.dir_x[k] = flush_to_zero(directions[i].x());
            rays.ray.dir_y[k] = flush_to_zero(directions[i].y());
            rays.ray.dir_z[k] = flush_to_zero(directions[i].z());
            rays.ray.tfar[k] = reach_m;
            rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.primID[k] = no_hit;
            valid[k] = k < count ? -1 : 0;
        }
        const auto own = facets.subspan(first, count);
        std::ranges::fill(own, no_hit);
        for (const TracedLayer& layer : layers) {
            intersect_8(valid, layer.tree, spread == RaySpread::close, rays);
            take_hits(rays, count, layer, own);
        }
    }
}

}  // namespace sonarsim
