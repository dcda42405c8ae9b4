#include "visibility/caster.h"

#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
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

/// Without what rounding has left of a zero. Embree sorts coherent rays into octants by the signs
/// of their components, but takes one that is nearer to zero than 1e-18 for +1e-18 where it divides
/// by it: all rays of the packet that share the octant of a ray with -1e-19 would meet nothing. A
/// ray is turned by 1e-9 at most, a micrometre in a kilometre; what is left of a product of two
/// numbers that pass stays above that limit.
float without_rest(float component) {
    constexpr float rest = 1e-9F;
    return std::fabs(component) < rest ? 0.0F : component;
}

/// Puts a tree into another, as its `index`-th instance.
void add_instance(RTCDevice device, const EmbreeTree& into, unsigned int index,
                  const EmbreeTree& tree, Eigen::Matrix<float, 3, 4> transform) {
    transform.leftCols<3>() = transform.leftCols<3>().unaryExpr(&without_rest).eval();
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, tree.get());
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(into.get(), instance, index);
    rtcReleaseGeometry(instance);
}

/// Traces rays in packets; `origin_of(i)` gives the start of ray i. Where the tree has instances,
/// the numbers of instance k's facets start at `first_facet[k]`.
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
            rays.ray.dir_x[k] = without_rest(directions[i].x());
            rays.ray.dir_y[k] = without_rest(directions[i].y());
            rays.ray.dir_z[k] = without_rest(directions[i].z());
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

/// What does not change: a tree of the scene's own triangles, one of each body and one of each
/// shared mesh, the latter two in frames of their own.
struct Caster::Trees {
    /// Where a copy of a shared mesh stands, scene-local.
    struct PlacedCopy {
        std::uint32_t tree;
        std::uint32_t instance;
        Eigen::Matrix<float, 3, 4> T_local_mesh;
    };

    RTCDevice device = nullptr;
    std::vector<EmbreeTree> trees;
    std::vector<Facet> facets;
    std::vector<std::uint32_t> first_of_tree;  ///< index into `facets`, and their end
    std::size_t bodies = 0;
    std::vector<PlacedCopy> copies;

    ~Trees() {
        trees.clear();
        if (device) rtcReleaseDevice(device);
    }

    std::uint32_t size(std::size_t tree) const {
        return first_of_tree[tree + 1] - first_of_tree[tree];
    }

    template <class Mesh, class InstanceOf>
    void add(const Mesh& mesh, const InstanceOf& instance_of) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            facets.push_back(make_facet(mesh, i, instance_of(i)));
        first_of_tree.push_back(static_cast<std::uint32_t>(facets.size()));
        trees.push_back(make_tree(device, mesh));
    }
};

/// Where everything is at one moment: the scene's own triangles, the bodies, then the copies.
struct Caster::Moment {
    EmbreeTree tree;
    std::vector<std::uint32_t> first_facet;  ///< the numbers that each one's facets have
    std::vector<std::uint32_t> tree_of;      ///< index into Trees::trees
    std::vector<Eigen::Matrix<float, 3, 4>> transforms;

    void add(const Trees& trees, std::uint32_t placed, const Eigen::Matrix<float, 3, 4>& T) {
        const std::uint32_t next =
            first_facet.empty() ? 0 : first_facet.back() + trees.size(tree_of.back());
        add_instance(trees.device, tree, static_cast<unsigned int>(first_facet.size()),
                     trees.trees[placed], T);
        first_facet.push_back(next);
        tree_of.push_back(placed);
        transforms.push_back(T);
    }
};

Caster::Caster(std::shared_ptr<const Trees> trees, std::unique_ptr<Moment> moment)
    : trees_(std::move(trees)),
      moment_(std::move(moment)),
      facets_(trees_->facets.data()),
      still_(trees_->size(0)) {
    if (!moment_ && !trees_->copies.empty()) moment_ = place(*trees_, {});
}

Caster::Caster(const Scene& scene) : Caster(make_trees(scene), nullptr) {}
Caster::Caster(Caster&&) noexcept = default;
Caster::~Caster() = default;

std::shared_ptr<const Caster::Trees> Caster::make_trees(const Scene& scene) {
    auto made = std::make_shared<Trees>();
    // Pinned to AVX2: another instruction set may order equal distances otherwise.
    made->device = rtcNewDevice("isa=avx2,max_isa=avx2");
    check_embree(made->device, "starting");
    std::size_t facets = scene.triangles.size();
    for (const Body& body : scene.bodies)
        facets += body.triangles.size();
    for (const SharedMesh& mesh : scene.shared_meshes)
        facets += mesh.triangles.size();
    made->facets.reserve(facets);
    made->first_of_tree.push_back(0);
    made->add(scene, [&](std::size_t i) { return scene.triangle_instance[i]; });
    for (const Body& body : scene.bodies)
        made->add(body, [&](std::size_t) { return body.instance; });
    made->bodies = scene.bodies.size();
    for (const SharedMesh& mesh : scene.shared_meshes)
        made->add(mesh, [](std::size_t) { return 0U; });
    for (const MeshCopy& copy : scene.copies) {
        Eigen::Affine3d T_local_mesh = copy.T_world_mesh;
        T_local_mesh.translation() -= scene.origin;
        made->copies.push_back({static_cast<std::uint32_t>(1 + made->bodies + copy.mesh),
                                copy.instance, T_local_mesh.matrix().topRows<3>().cast<float>()});
    }
    return made;
}

std::unique_ptr<Caster::Moment> Caster::place(const Trees& trees,
                                              std::span<const Pose> T_local_body) {
    auto moment = std::make_unique<Moment>(Moment{EmbreeTree(trees.device), {}, {}, {}});
    Eigen::Matrix<float, 3, 4> transform = Eigen::Matrix<float, 3, 4>::Identity();
    moment->add(trees, 0, transform);
    for (std::size_t k = 0; k < T_local_body.size(); ++k) {
        transform << T_local_body[k].rotation.toRotationMatrix().cast<float>(),
            T_local_body[k].translation.cast<float>();
        moment->add(trees, static_cast<std::uint32_t>(1 + k), transform);
    }
    for (const Trees::PlacedCopy& copy : trees.copies)
        moment->add(trees, copy.tree, copy.T_local_mesh);
    // A thread that waits for Embree must not begin another ping meanwhile.
    tbb::this_task_arena::isolate([&] { rtcCommitScene(moment->tree.get()); });
    check_embree(trees.device, "placing bodies and copies");
    return moment;
}

Caster Caster::moved(std::span<const Pose> T_local_body) const {
    return {trees_, place(*trees_, T_local_body)};
}

Facet Caster::placed_facet(std::uint32_t index) const {
    const auto& first = moment_->first_facet;
    const auto next = std::upper_bound(first.begin(), first.end(), index);
    const auto placed = static_cast<std::size_t>(next - first.begin()) - 1;
    const auto stored = trees_->first_of_tree[moment_->tree_of[placed]];
    Facet facet = facets_[stored + (index - first[placed])];
    const Eigen::Matrix<float, 3, 4>& T = moment_->transforms[placed];
    facet.vertex = T.leftCols<3>() * facet.vertex + T.col(3);
    facet.normal = T.leftCols<3>() * facet.normal;
    const std::size_t first_copy = first.size() - trees_->copies.size();
    if (placed < first_copy) return facet;
    facet.normal.normalize();  // a copy may be scaled
    facet.instance = trees_->copies[placed - first_copy].instance;
    return facet;
}

void Caster::cast(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                  float reach_m, std::span<std::uint32_t> facets) const {
    const auto origin_of = [&](std::size_t) -> const Eigen::Vector3f& { return origin; };
    moment_
        ? trace(moment_->tree.get(), moment_->first_facet, origin_of, directions, reach_m, facets)
        : trace(trees_->trees[0].get(), {}, origin_of, directions, reach_m, facets);
}

void Caster::cast(std::span<const Eigen::Vector3f> origins,
                  std::span<const Eigen::Vector3f> directions,
                  std::span<std::uint32_t> facets) const {
    constexpr float reach_m = std::numeric_limits<float>::infinity();
    const auto origin_of = [&](std::size_t i) -> const Eigen::Vector3f& { return origins[i]; };
    moment_
        ? trace(moment_->tree.get(), moment_->first_facet, origin_of, directions, reach_m, facets)
        : trace(trees_->trees[0].get(), {}, origin_of, directions, reach_m, facets);
}

}  // namespace sonarsim
