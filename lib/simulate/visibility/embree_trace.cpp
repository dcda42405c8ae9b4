#include "simulate/visibility/embree_trace.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

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
    static constexpr int capacity = 8;

    Eigen::Vector3f origin, direction;
    float origin_m;  ///< sum of the origin's absolute coordinates
    float reach_m;
    int count;
    float nearest_m;
    std::array<Candidate, capacity> met;

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
        if (count < capacity) {
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
    std::vector<MetFacet>* all;  ///< null: the nearest alone
    std::uint32_t first;         ///< number of the first ray
    std::array<TracedRay, packet> rays;
};

/// The filter of a mesh that trace_packets() meets: takes down Embree's hits.
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
        if (query.all) {
            if (found.distance_m <= ray.reach_m)
                query.all->push_back({query.first + k, found.distance_m, found.facet});
            hits->valid[k] = 0;
        } else if (found.distance_m <= ray.reach_m && ray.take(found)) {
            embree_m = ray.embree_reach(found.distance_m);
        } else {
            hits->valid[k] = 0;
        }
    }
}

}  // namespace

void check_embree(RTCDevice device, const char* doing) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error != RTC_ERROR_NONE) {
        throw std::runtime_error(std::string("Embree failed while ") + doing + ", error " +
                                 std::to_string(static_cast<int>(error)));
    }
}

EmbreeTree make_tree(RTCDevice device, std::span<const Eigen::Vector3f> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles) {
    EmbreeTree tree(device);
    if (!triangles.empty()) put_mesh(device, tree, 0, vertices, triangles);
    commit(device, tree);
    return tree;
}

void put_mesh(RTCDevice device, const EmbreeTree& into, unsigned int index,
              std::span<const Eigen::Vector3f> vertices,
              std::span<const std::array<std::uint32_t, 3>> triangles) {
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* points = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Eigen::Vector3f), vertices.size());
    void* corners = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(triangles[0]), triangles.size());
    if (points && corners) {
        std::copy(vertices.begin(), vertices.end(), static_cast<Eigen::Vector3f*>(points));
        std::copy(triangles.begin(), triangles.end(),
                  static_cast<std::array<std::uint32_t, 3>*>(corners));
        rtcSetGeometryIntersectFilterFunction(mesh, &keep_hits);
        rtcSetGeometryOccludedFilterFunction(mesh, &keep_hits);
        rtcCommitGeometry(mesh);
        rtcAttachGeometryByID(into.get(), mesh, index);
    }
    rtcReleaseGeometry(mesh);
    check_embree(device, "copying the scene");
}

bool has_first_mesh(const EmbreeTree& tree, std::span<const Eigen::Vector3f> vertices,
                    std::span<const std::array<std::uint32_t, 3>> triangles) {
    RTCGeometry mesh = rtcGetGeometry(tree.get(), 0);
    const auto holds = [&](RTCBufferType type, auto items) {
        return std::memcmp(rtcGetGeometryBufferData(mesh, type, 0), items.data(),
                           items.size_bytes()) == 0;
    };
    // The same triangles have the same number of vertices.
    return holds(RTC_BUFFER_TYPE_INDEX, triangles) && holds(RTC_BUFFER_TYPE_VERTEX, vertices);
}

void commit(RTCDevice device, const EmbreeTree& tree) {
    rtcCommitScene(tree.get());
    check_embree(device, "building its tree");
}

void add_instance(RTCDevice device, const EmbreeTree& into, unsigned int index,
                  const EmbreeTree& tree, Eigen::Matrix<float, 3, 4> transform) {
    transform.leftCols<3>() = transform.leftCols<3>().unaryExpr(&flush_to_zero).eval();
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, tree.get());
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(into.get(), instance, index);
    rtcReleaseGeometry(instance);
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
        query.first = static_cast<std::uint32_t>(first);
        query.all = list.all;
        for (const TracedLayer& layer : layers) {
            query.layer = &layer;
            for (int k = 0; k < packet; ++k) {
                rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
                rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            }
            trace_8(valid, layer.tree, list.any_hit, rays, query.context);
        }
        for (int k = 0; !list.all && k < count; ++k)
            facets[first + k] = query.rays[k].facet();
    }
}

}  // namespace sonarsim
