#include "visibility/caster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "visibility/embree.h"

namespace sonarsim {

namespace {

constexpr int packet = 8;

/// The normal from edges in double: in float, a needle's cross product is mostly cancellation.
Facet make_facet(const Scene& scene, std::size_t triangle) {
    const auto& corners = scene.triangles[triangle];
    const Eigen::Vector3d a = scene.vertices[corners[0]].cast<double>();
    const Eigen::Vector3d b = scene.vertices[corners[1]].cast<double>();
    const Eigen::Vector3d c = scene.vertices[corners[2]].cast<double>();
    return {scene.vertices[corners[0]], scene.triangle_material[triangle],
            (b - a).cross(c - a).normalized().cast<float>(), scene.triangle_instance[triangle]};
}

/// Traces rays in packets; `origin_of(i)` gives the start of ray i.
template <class OriginOf>
void trace(RTCScene tree, OriginOf origin_of, std::span<const Eigen::Vector3f> directions,
           float reach_m, std::span<std::uint32_t> facets) {
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
            // A short packet repeats its last ray: whatever the idle lanes hold is then harmless.
            const std::size_t i = first + std::min(k, count - 1);
            const Eigen::Vector3f& origin = origin_of(i);
            rays.ray.org_x[k] = origin.x();
            rays.ray.org_y[k] = origin.y();
            rays.ray.org_z[k] = origin.z();
            rays.ray.dir_x[k] = directions[i].x();
            rays.ray.dir_y[k] = directions[i].y();
            rays.ray.dir_z[k] = directions[i].z();
            rays.ray.tfar[k] = reach_m;
            rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.primID[k] = Caster::nothing;
            valid[k] = k < count ? -1 : 0;
        }
        intersect_coherent_8(valid, tree, rays);
        std::copy_n(rays.hit.primID, count, facets.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

}  // namespace

struct Caster::Embree {
    RTCDevice device = nullptr;
    RTCScene tree = nullptr;

    ~Embree() {
        if (tree) rtcReleaseScene(tree);
        if (device) rtcReleaseDevice(device);
    }

    void check(const char* doing) const {
        const RTCError error = rtcGetDeviceError(device);
        if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        if (error != RTC_ERROR_NONE) {
            throw std::runtime_error(std::string("Embree failed while ") + doing + ", error " +
                                     std::to_string(static_cast<int>(error)));
        }
    }
};

Caster::Caster(const Scene& scene) : embree_(std::make_unique<Embree>()) {
    facets_.reserve(scene.triangles.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        facets_.push_back(make_facet(scene, i));
    }
    // Pinned to AVX2: another instruction set may order equal distances otherwise.
    embree_->device = rtcNewDevice("isa=avx2,max_isa=avx2");
    embree_->check("starting");
    embree_->tree = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->tree, RTC_SCENE_FLAG_ROBUST);
    if (!scene.triangles.empty()) {
        RTCGeometry mesh = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                 sizeof(Eigen::Vector3f), scene.vertices.size());
        void* indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                sizeof(scene.triangles[0]), scene.triangles.size());
        if (vertices && indices) {
            std::copy(scene.vertices.begin(), scene.vertices.end(),
                      static_cast<Eigen::Vector3f*>(vertices));
            std::copy(scene.triangles.begin(), scene.triangles.end(),
                      static_cast<std::array<std::uint32_t, 3>*>(indices));
            rtcCommitGeometry(mesh);
            rtcAttachGeometryByID(embree_->tree, mesh, 0);
        }
        rtcReleaseGeometry(mesh);
        embree_->check("copying the scene");
    }
    rtcCommitScene(embree_->tree);
    embree_->check("building its tree");
}

Caster::~Caster() = default;

void Caster::cast(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                  float reach_m, std::span<std::uint32_t> facets) const {
    trace(
        embree_->tree, [&](std::size_t) -> const Eigen::Vector3f& { return origin; }, directions,
        reach_m, facets);
}

void Caster::cast(std::span<const Eigen::Vector3f> origins,
                  std::span<const Eigen::Vector3f> directions,
                  std::span<std::uint32_t> facets) const {
    trace(
        embree_->tree, [&](std::size_t i) -> const Eigen::Vector3f& { return origins[i]; },
        directions, std::numeric_limits<float>::infinity(), facets);
}

}  // namespace sonarsim
