#include "visibility/caster.h"

#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "visibility/embree.h"

namespace sonarsim {

namespace {

constexpr int packet = 8;

/// The normal from edges in double: in float, a needle's cross product is mostly cancellation.
template <class Mesh>
Facet make_facet(const Mesh& mesh, std::size_t triangle, std::uint32_t instance) {
    const auto& corners = mesh.triangles[triangle];
    const Eigen::Vector3d a = mesh.vertices[corners[0]].template cast<double>();
    const Eigen::Vector3d b = mesh.vertices[corners[1]].template cast<double>();
    const Eigen::Vector3d c = mesh.vertices[corners[2]].template cast<double>();
    return {mesh.vertices[corners[0]], mesh.triangle_material[triangle],
            (b - a).cross(c - a).normalized().template cast<float>(), instance};
}

void check_embree(RTCDevice device, const char* doing) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error != RTC_ERROR_NONE) {
        throw std::runtime_error(std::string("Embree failed while ") + doing + ", error " +
                                 std::to_string(static_cast<int>(error)));
    }
}

template <class Mesh>
EmbreeTree make_tree(RTCDevice device, const Mesh& scene) {
    EmbreeTree tree(device);
    if (!scene.triangles.empty()) {
        RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
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
            rtcAttachGeometryByID(tree.get(), mesh, 0);
        }
        rtcReleaseGeometry(mesh);
        check_embree(device, "copying the scene");
    }
    rtcCommitScene(tree.get());
    check_embree(device, "building its tree");
    return tree;
}

/// Puts a tree into another, as its `index`-th instance.
void add_instance(RTCDevice device, const EmbreeTree& into, unsigned int index,
                  const EmbreeTree& tree, const Eigen::Matrix<float, 3, 4>& transform) {
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, tree.get());
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(into.get(), instance, index);
    rtcReleaseGeometry(instance);
}

/// Traces rays in packets; `origin_of(i)` gives the start of ray i. Where the tree has instances,
/// the facets of instance k start at `first_facet[k]`.
template <class OriginOf>
void trace(RTCScene tree, std::span<const std::uint32_t> first_facet, OriginOf origin_of,
           std::span<const Eigen::Vector3f> directions, float reach_m,
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
            rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.primID[k] = Caster::nothing;
            valid[k] = k < count ? -1 : 0;
        }
        intersect_coherent_8(valid, tree, rays);
        std::copy_n(rays.hit.primID, count, facets.begin() + static_cast<std::ptrdiff_t>(first));
        if (first_facet.empty()) continue;
        for (int k = 0; k < count; ++k) {
            if (facets[first + k] != Caster::nothing)
                facets[first + k] += first_facet[rays.hit.instID[0][k]];
        }
    }
}

}  // namespace

/// What does not change: a tree of what stands still and one of each body, in its own frame.
struct Caster::Trees {
    RTCDevice device = nullptr;
    std::vector<EmbreeTree> trees;
    std::vector<Facet> facets;
    std::vector<std::uint32_t> first_facet;  ///< of each tree

    ~Trees() {
        trees.clear();
        if (device) rtcReleaseDevice(device);
    }
};

/// Where the bodies are at one moment.
struct Caster::Moment {
    EmbreeTree tree;
    std::vector<Eigen::Matrix3f> rotations;  ///< R_local_body
    std::vector<Eigen::Vector3f> positions;
};

Caster::Caster(std::shared_ptr<const Trees> trees, std::unique_ptr<Moment> moment)
    : trees_(std::move(trees)),
      moment_(std::move(moment)),
      facets_(trees_->facets.data()),
      still_(trees_->first_facet.size() > 1 ? trees_->first_facet[1]
                                            : static_cast<std::uint32_t>(trees_->facets.size())) {}

Caster::Caster(const Scene& scene) : Caster(make_trees(scene), nullptr) {}
Caster::Caster(Caster&&) noexcept = default;
Caster::~Caster() = default;

std::shared_ptr<const Caster::Trees> Caster::make_trees(const Scene& scene) {
    auto made = std::make_shared<Trees>();
    std::size_t facets = scene.triangles.size();
    for (const Body& body : scene.bodies)
        facets += body.triangles.size();
    made->facets.reserve(facets);
    made->first_facet.push_back(0);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        made->facets.push_back(make_facet(scene, i, scene.triangle_instance[i]));
    for (const Body& body : scene.bodies) {
        made->first_facet.push_back(static_cast<std::uint32_t>(made->facets.size()));
        for (std::size_t i = 0; i < body.triangles.size(); ++i)
            made->facets.push_back(make_facet(body, i, body.instance));
    }
    // Pinned to AVX2: another instruction set may order equal distances otherwise.
    made->device = rtcNewDevice("isa=avx2,max_isa=avx2");
    check_embree(made->device, "starting");
    made->trees.push_back(make_tree(made->device, scene));
    for (const Body& body : scene.bodies)
        made->trees.push_back(make_tree(made->device, body));
    return made;
}

Caster Caster::moved(std::span<const Pose> T_local_body) const {
    auto moment = std::make_unique<Moment>(Moment{EmbreeTree(trees_->device), {}, {}});
    Eigen::Matrix<float, 3, 4> transform = Eigen::Matrix<float, 3, 4>::Identity();
    add_instance(trees_->device, moment->tree, 0, trees_->trees[0], transform);
    for (std::size_t k = 0; k < T_local_body.size(); ++k) {
        moment->rotations.push_back(T_local_body[k].rotation.toRotationMatrix().cast<float>());
        moment->positions.push_back(T_local_body[k].translation.cast<float>());
        transform << moment->rotations.back(), moment->positions.back();
        add_instance(trees_->device, moment->tree, static_cast<unsigned int>(k + 1),
                     trees_->trees[k + 1], transform);
    }
    // A thread that waits for Embree must not begin another ping meanwhile.
    tbb::this_task_arena::isolate([&] { rtcCommitScene(moment->tree.get()); });
    check_embree(trees_->device, "moving the bodies");
    return {trees_, std::move(moment)};
}

Facet Caster::moved_facet(std::uint32_t index) const {
    Facet facet = facets_[index];
    const auto& first = trees_->first_facet;
    const auto next = std::upper_bound(first.begin(), first.end(), index);
    const auto body = static_cast<std::size_t>(next - first.begin()) - 2;
    facet.vertex = moment_->rotations[body] * facet.vertex + moment_->positions[body];
    facet.normal = moment_->rotations[body] * facet.normal;
    return facet;
}

void Caster::cast(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                  float reach_m, std::span<std::uint32_t> facets) const {
    const auto origin_of = [&](std::size_t) -> const Eigen::Vector3f& { return origin; };
    moment_
        ? trace(moment_->tree.get(), trees_->first_facet, origin_of, directions, reach_m, facets)
        : trace(trees_->trees[0].get(), {}, origin_of, directions, reach_m, facets);
}

void Caster::cast(std::span<const Eigen::Vector3f> origins,
                  std::span<const Eigen::Vector3f> directions,
                  std::span<std::uint32_t> facets) const {
    constexpr float reach_m = std::numeric_limits<float>::infinity();
    const auto origin_of = [&](std::size_t i) -> const Eigen::Vector3f& { return origins[i]; };
    moment_
        ? trace(moment_->tree.get(), trees_->first_facet, origin_of, directions, reach_m, facets)
        : trace(trees_->trees[0].get(), {}, origin_of, directions, reach_m, facets);
}

}  // namespace sonarsim
