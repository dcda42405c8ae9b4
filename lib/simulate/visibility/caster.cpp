#include "simulate/visibility/caster.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "core/error.h"
#include "input/scene/mesh_topology.h"
#include "simulate/visibility/embree_trace.h"

namespace sonarsim {

namespace {

static_assert(Caster::nothing == RTC_INVALID_GEOMETRY_ID);

// Facets of all placed trees have numbers of 32 bits, and `nothing` is none of them.
constexpr std::size_t max_facets = 0xFFFF0000U;

template <class Mesh>
Facet make_facet(const Mesh& mesh, std::size_t triangle, std::uint32_t instance) {
    const auto& corners = mesh.triangles[triangle];
    return {mesh.vertices[corners[0]], mesh.triangle_material[triangle],
            cross_of(mesh.vertices, corners).normalized().template cast<float>(), instance};
}

std::span<const Eigen::Vector3f> first_vertices(const Scene& scene) {
    return std::span(scene.vertices).first(scene.first_file_vertices);
}

std::span<const TriangleCorners> first_triangles(const Scene& scene) {
    return std::span(scene.triangles).first(scene.first_file_triangles);
}

/// True if the first file has a tree of its own. Bodies and copies have one of all surface at rest.
bool has_parts(const Scene& scene) {
    return scene.first_file_triangles > 0 && scene.first_file_triangles < scene.triangles.size() &&
           scene.bodies.empty() && scene.copies.empty();
}

}  // namespace

/// The constant parts: trees of the scene's own triangles and of each body and shared mesh.
struct Caster::Trees {
    /// A placed copy of a shared mesh, scene-local.
    struct PlacedCopy {
        std::uint32_t tree;
        std::uint32_t instance;
        Eigen::Matrix<float, 3, 4> T_local_mesh;
    };

    RTCDevice device = nullptr;
    Eigen::Vector3d origin;  ///< the scene's
    std::vector<EmbreeTree> trees;
    std::vector<Facet> facets;
    std::vector<std::uint32_t> first_of_tree;  ///< index into `facets`, with one entry for the end
    std::size_t bodies = 0;
    std::vector<PlacedCopy> copies;
    /// The first facets of the two parts of the scene's own tree; 0: there is no second.
    std::array<std::uint32_t, 2> first_of_part{};

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
        trees.push_back(make_tree(device, mesh.vertices, mesh.triangles));
    }

    /// Adds the scene's own triangles from `first_of_part[1]` on.
    void put_others(const Scene& scene) {
        const std::uint32_t first = first_of_part[1];
        if (facets.size() > first) rtcDetachGeometry(trees[0].get(), 1);
        facets.resize(first);
        for (std::size_t i = first; i < scene.triangles.size(); ++i)
            facets.push_back(make_facet(scene, i, scene.triangle_instance[i]));
        put_mesh(device, trees[0], 1, scene.vertices, std::span(scene.triangles).subspan(first));
        commit(device, trees[0]);
        first_of_tree = {0, static_cast<std::uint32_t>(facets.size())};
    }

    /// Adds the scene's own triangles in two parts. With these settings Embree builds a tree of
    /// each part and joins them, and builds none again of a part that stays.
    void add_parts(const Scene& scene) {
        RTCScene joined = trees.emplace_back(device).get();
        rtcSetSceneFlags(
            joined, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC));
        rtcSetSceneBuildQuality(joined, RTC_BUILD_QUALITY_LOW);
        first_of_part[1] = static_cast<std::uint32_t>(scene.first_file_triangles);
        for (std::size_t i = 0; i < scene.first_file_triangles; ++i)
            facets.push_back(make_facet(scene, i, scene.triangle_instance[i]));
        put_mesh(device, trees[0], 0, first_vertices(scene), first_triangles(scene));
        put_others(scene);
    }

    /// True if the first part has these triangles.
    bool has_first_file(const Scene& scene) const {
        const std::size_t count = first_of_part[1];
        if (!has_parts(scene) || scene.first_file_triangles != count) return false;
        for (std::size_t i = 0; i < count; ++i) {
            if (facets[i].material != scene.triangle_material[i] ||
                facets[i].instance != scene.triangle_instance[i])
                return false;
        }
        return has_first_mesh(trees[0], first_vertices(scene), first_triangles(scene));
    }
};

/// A tree of the scene's own triangles, bodies or both, then copies; facets count from `begin`.
struct Caster::PlacedTree {
    EmbreeTree tree;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::vector<TracedMesh> meshes;
    std::size_t first_copy = 0;  ///< index of the first copy

    /// Places the scene's own triangles, bodies and copies, as far as wanted, from `first` on.
    PlacedTree(const Trees& trees, std::uint32_t first, bool own,
               std::span<const Pose> T_world_body, bool copies)
        : tree(trees.device), begin(first), end(first) {
        Eigen::Matrix<float, 3, 4> T = Eigen::Matrix<float, 3, 4>::Identity();
        if (own) add(trees, 0, T, false);
        for (std::uint32_t k = 0; k < T_world_body.size(); ++k) {
            T << T_world_body[k].rotation.toRotationMatrix().cast<float>(),
                (T_world_body[k].translation - trees.origin).cast<float>();
            add(trees, 1 + k, T, false);
        }
        first_copy = meshes.size();
        for (std::size_t k = 0; copies && k < trees.copies.size(); ++k)
            add(trees, trees.copies[k].tree, trees.copies[k].T_local_mesh, true);
        // Isolated, so that a thread that waits for Embree does not begin another ping.
        tbb::this_task_arena::isolate([&] { rtcCommitScene(tree.get()); });
        check_embree(trees.device, "placing bodies and copies");
    }

  private:
    void add(const Trees& trees, std::uint32_t placed, const Eigen::Matrix<float, 3, 4>& T,
             bool scaled) {
        add_instance(trees.device, tree, static_cast<unsigned int>(meshes.size()),
                     trees.trees[placed], T);
        meshes.push_back(
            {end, trees.facets.data() + trees.first_of_tree[placed], placed > 0, scaled, T});
        end += trees.size(placed);
    }
};

Caster::Caster(std::shared_ptr<const Trees> trees,
               std::vector<std::shared_ptr<const PlacedTree>> placed_trees)
    : trees_(std::move(trees)),
      placed_trees_(std::move(placed_trees)),
      facets_(trees_->facets.data()),
      still_(trees_->size(0)) {
    if (placed_trees_.empty() && !trees_->copies.empty()) {
        placed_trees_.push_back(
            std::make_shared<PlacedTree>(*trees_, 0, true, std::span<const Pose>{}, true));
    }
}

Caster::Caster(const Scene& scene) : Caster(make_trees(scene), {}) {}
Caster::Caster(Caster&&) noexcept = default;
Caster::Caster(const Caster&) = default;
Caster::~Caster() = default;

Caster SharedTrees::caster(const Scene& scene) {
    const std::lock_guard lock(mutex_);
    const auto is_free = [](const auto& trees) { return trees.use_count() <= 1; };
    auto place = std::ranges::find_if(kept_, [&](const auto& trees) {
        if (!trees || !is_free(trees)) return false;
        // The count alone does not order the last use on another thread before the change.
        std::atomic_thread_fence(std::memory_order_acquire);
        return trees->has_first_file(scene);
    });
    if (place != kept_.end()) {
        (*place)->put_others(scene);
    } else {
        place = std::ranges::find_if(kept_, is_free);
        if (place == kept_.end()) place = kept_.begin();
        place->reset();  // before another takes memory
        *place = Caster::make_trees(scene);
    }
    return {*place, {}};
}

std::shared_ptr<Caster::Trees> Caster::make_trees(const Scene& scene) {
    auto made = std::make_shared<Trees>();
    // Pinned to AVX2, since another instruction set may order equal distances differently.
    made->device = rtcNewDevice("isa=avx2,max_isa=avx2");
    check_embree(made->device, "starting");
    made->origin = scene.origin;
    std::size_t facets = scene.triangles.size();
    for (const Body& body : scene.bodies)
        facets += body.triangles.size();
    for (const SharedMesh& mesh : scene.shared_meshes)
        facets += mesh.triangles.size();
    std::size_t placed = facets;
    for (const MeshCopy& copy : scene.copies)
        placed += scene.shared_meshes[copy.mesh].triangles.size();
    if (placed > max_facets) {
        throw InputError("the scene has " + std::to_string(placed) + " triangles; at most " +
                         std::to_string(max_facets) + " are supported");
    }
    made->facets.reserve(facets);
    made->first_of_tree.push_back(0);
    if (has_parts(scene))
        made->add_parts(scene);
    else
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

Caster Caster::moved(std::span<const Pose> T_world_body) const {
    // Copies are many and at rest, so the first tree holds them and is kept; bodies get their own
    // tree. Without copies one tree holds everything, which is faster to trace.
    std::vector<std::shared_ptr<const PlacedTree>> placed_trees;
    if (!trees_->copies.empty()) placed_trees.push_back(placed_trees_.front());
    placed_trees.push_back(
        std::make_shared<PlacedTree>(*trees_, placed_trees.empty() ? 0 : placed_trees.front()->end,
                                     placed_trees.empty(), T_world_body, false));
    Caster out(trees_, std::move(placed_trees));
    out.T_world_body_.assign(T_world_body.begin(), T_world_body.end());
    return out;
}

std::size_t Caster::placed_triangles() const {
    std::size_t count = 0;
    for (std::size_t tree = 0; tree <= trees_->bodies; ++tree)
        count += trees_->size(tree);
    for (const Trees::PlacedCopy& copy : trees_->copies)
        count += trees_->size(copy.tree);
    return count;
}

Facet Caster::placed_facet(std::uint32_t index) const {
    const PlacedTree& placed_tree =
        index < placed_trees_.back()->begin ? *placed_trees_.front() : *placed_trees_.back();
    const auto& meshes = placed_tree.meshes;
    const auto next = std::ranges::upper_bound(meshes, index, {}, &TracedMesh::first_facet);
    const auto placed = static_cast<std::size_t>(next - meshes.begin()) - 1;
    Facet facet = meshes[placed].facet(index - meshes[placed].first_facet);
    if (placed >= placed_tree.first_copy)
        facet.instance = trees_->copies[placed - placed_tree.first_copy].instance;
    return facet;
}

void Caster::trace(const RayList& list, std::span<std::uint32_t> facets) const {
    if (placed_trees_.empty()) {
        std::array<TracedMesh, 2> parts;
        for (std::size_t k = 0; k < parts.size(); ++k) {
            parts[k].first_facet = trees_->first_of_part[k];
            parts[k].facets = facets_ + parts[k].first_facet;
        }
        const TracedLayer own{trees_->trees[0].get(), parts};
        trace_packets({&own, 1}, list, facets);
        return;
    }
    std::array<TracedLayer, 2> layers;
    for (std::size_t k = 0; k < placed_trees_.size(); ++k)
        layers[k] = {placed_trees_[k]->tree.get(), placed_trees_[k]->meshes};
    trace_packets(std::span(layers).first(placed_trees_.size()), list, facets);
}

void Caster::cast(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                  float reach_m, std::span<std::uint32_t> facets) const {
    trace({.origins = {&origin, 0}, .directions = directions, .reach_m = {&reach_m, 0}}, facets);
}

void Caster::cast(std::span<const Eigen::Vector3f> origins,
                  std::span<const Eigen::Vector3f> directions, std::span<std::uint32_t> facets,
                  float reach_m) const {
    trace({.origins = {origins.data(), 1}, .directions = directions, .reach_m = {&reach_m, 0}},
          facets);
}

void Caster::cast_any(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                      std::span<const float> reach_m, std::span<std::uint32_t> facets) const {
    trace({.origins = {&origin, 0},
           .directions = directions,
           .reach_m = {reach_m.data(), 1},
           .any_hit = true},
          facets);
}

std::vector<MetFacet> Caster::cast_through(std::span<const Eigen::Vector3f> origins,
                                           std::span<const Eigen::Vector3f> directions,
                                           std::span<const float> reach_m) const {
    std::vector<MetFacet> met;
    trace({.origins = {origins.data(), 1},
           .directions = directions,
           .reach_m = {reach_m.data(), 1},
           .all = &met},
          {});
    std::ranges::sort(met);
    return met;
}

}  // namespace sonarsim
