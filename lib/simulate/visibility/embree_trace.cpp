#include "simulate/visibility/embree_trace.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace sonarsim {

namespace {

constexpr int packet = 8;
constexpr std::uint32_t no_hit = RTC_INVALID_GEOMETRY_ID;

/// A facet that a ray meets.
struct Candidate {
    float distance_m;
    float rounding_m;  ///< bound of the distance's error
    std::uint32_t facet;
    Eigen::Vector3f normal;

    bool operator<(const Candidate& other) const {
        return distance_m < other.distance_m ||
               (distance_m == other.distance_m && facet < other.facet);
    }

    /// True if both facets are parts of one plane, to within rounding.
    bool coincides(const Candidate& other) const {
        return std::fabs(distance_m - other.distance_m) <= rounding_m + other.rounding_m &&
               normal.cross(other.normal).lpNorm<1>() < 0x1p-18F;
    }
};

/// A ray and the nearest facets that it has met.
struct TracedRay {
    // At a place where more facets meet, the nearest of them count.
    static constexpr int most = 8;

    Eigen::Vector3f origin, direction;
    float origin_m;  ///< sum of the origin's absolute coordinates
    float reach_m;
    int count;
    float nearest_m;
    std::array<Candidate, most> met;

    /// Largest difference of Embree's distance of a facet, and of another facet that coincides,
    /// from ours. Rounding alone is a thousandth of it, except at an incidence of 0.05 degrees.
    float slack(float distance_m) const { return 0x1p-11F * distance_m + 0x1p-19F * origin_m; }

    /// The reach of Embree's ray that finds all facets that may be the nearest.
    float embree_reach(float distance_m) const { return distance_m + 2.0F * slack(distance_m); }

    Candidate candidate(const Facet& facet, std::uint32_t number, float embree_m) const {
        const Eigen::Vector3f to_vertex = facet.vertex - origin;
        const float along = facet.normal.dot(direction);
        const float off_m = slack(embree_m);
        const float to_plane = facet.normal.dot(to_vertex) / along;
        // In this order a number that is none, of a facet that is edge-on, becomes a limit.
        const float distance = std::min(std::max(embree_m - off_m, to_plane), embree_m + off_m);
        const float size = to_vertex.lpNorm<1>() + origin_m + std::fabs(distance);
        return {distance, std::min(slack(distance), 0x1p-21F * size / std::fabs(along)), number,
                facet.normal};
    }

    /// True if the candidate is the nearest so far.
    bool take(const Candidate& found) {
        const bool nearest = count == 0 || found.distance_m < nearest_m;
        if (nearest) {
            if (count > 0 && embree_reach(found.distance_m) < nearest_m) count = 0;
            nearest_m = found.distance_m;
        } else if (found.distance_m > embree_reach(nearest_m)) {
            return false;
        }
        if (count < most) {
            met[count++] = found;
        } else {
            Candidate& farthest = *std::ranges::max_element(met, std::less<>());
            if (found < farthest) farthest = found;
        }
        return nearest;
    }

    std::uint32_t facet() const {
        if (count == 0) return no_hit;
        const auto found = std::span(met).first(count);
        const Candidate& nearest = *std::ranges::min_element(found, std::less<>());
        std::uint32_t first = nearest.facet;
        for (const Candidate& one : found) {
            if (one.coincides(nearest)) first = std::min(first, one.facet);
        }
        return first;
    }
};

/// The data of the filter. Embree hands the address of its first member on.
struct Query {
    QueryContext context;
    const TracedLayer* layer;
    std::array<TracedRay, packet> rays;
};

}  // namespace

void keep_hits(const RTCFilterFunctionNArguments* hits) {
    auto& query = *reinterpret_cast<Query*>(
        const_cast<QueryContext*>(reinterpret_cast<const QueryContext*>(hits->context)));
    for (unsigned int k = 0; k < packet; ++k) {
        if (!hits->valid[k]) continue;
        TracedRay& ray = query.rays[k];
        const unsigned int instance = RTCHitN_instID(hits->hit, packet, k, 0);
        const TracedMesh& mesh =
            query.layer
                ->meshes[instance == no_hit ? RTCHitN_geomID(hits->hit, packet, k) : instance];
        const std::uint32_t triangle = RTCHitN_primID(hits->hit, packet, k);
        float& embree_m = RTCRayN_tfar(hits->ray, packet, k);
        const Candidate found =
            ray.candidate(mesh.facet(triangle), mesh.first_facet + triangle, embree_m);
        if (found.distance_m <= ray.reach_m && ray.take(found))
            embree_m = ray.embree_reach(found.distance_m);
        else
            hits->valid[k] = 0;
    }
}

void trace_packets(std::span<const TracedLayer> layers, const RayList& list,
                   std::span<std::uint32_t> facets) {
    alignas(64) RTCRayHit8 rays;
    alignas(64) int valid[packet];
    Query query;
    for (int k = 0; k < packet; ++k) {
        rays.ray.tnear[k] = 0.0F;
        rays.ray.time[k] = 0.0F;
        rays.ray.mask[k] = 0xFFFFFFFFU;
        rays.ray.id[k] = 0;
        rays.ray.flags[k] = 0;
    }
    for (std::size_t first = 0; first < list.directions.size(); first += packet) {
        const int count =
            static_cast<int>(std::min<std::size_t>(packet, list.directions.size() - first));
        for (int k = 0; k < packet; ++k) {
            // A short packet repeats its last ray, so the idle lanes are harmless.
            const std::size_t i = first + std::min(k, count - 1);
            TracedRay& own = query.rays[k];
            own.origin = list.origins.of(i);
            own.direction = list.directions[i].unaryExpr(&flush_to_zero);
            own.origin_m = own.origin.lpNorm<1>();
            own.reach_m = list.reach_m.of(i);
            own.count = 0;
            rays.ray.org_x[k] = own.origin.x();
            rays.ray.org_y[k] = own.origin.y();
            rays.ray.org_z[k] = own.origin.z();
            rays.ray.dir_x[k] = own.direction.x();
            rays.ray.dir_y[k] = own.direction.y();
            rays.ray.dir_z[k] = own.direction.z();
            rays.ray.tfar[k] = own.embree_reach(own.reach_m);
            valid[k] = k < count ? -1 : 0;
        }
        for (const TracedLayer& layer : layers) {
            query.layer = &layer;
            for (int k = 0; k < packet; ++k) {
                rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
                rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            }
            trace_8(valid, layer.tree, list.any_hit, list.spread == RaySpread::close, rays,
                    query.context);
        }
        for (int k = 0; k < count; ++k)
            facets[first + k] = query.rays[k].facet();
    }
}

}  // namespace sonarsim
