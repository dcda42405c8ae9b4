#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/visibility/facet.h"

namespace sonarsim {

struct RayList;

/// Wraps Embree: finds the first triangle that a ray meets, the same on every processor.
class Caster {
  public:
    static constexpr std::uint32_t nothing = 0xFFFFFFFFU;

    /// Builds the tree over `scene`, joined of that of its first file and that of the others, and
    /// one over each body and shared mesh. Rays meet bodies only after moved() has placed them.
    explicit Caster(const Scene& scene);
    ~Caster();
    Caster(Caster&&) noexcept;
    Caster(const Caster&);  ///< the copy shares the trees, which never change
    Caster& operator=(const Caster&) = delete;

    /// The same trees with the bodies at these poses. The time grows with the number of bodies, but
    /// not with their triangles or with copies of shared meshes. World.
    Caster moved(std::span<const Pose> T_world_body) const;

    /// The poses of Scene::bodies that moved() was given; empty without them. World.
    std::span<const Pose> body_poses() const { return T_world_body_; }

    /// Rays from one point: `facets[i]` is the facet that direction i meets within `reach_m`, or
    /// `nothing`. Neighbours in the list should be neighbours in space.
    /// Scene-local frame.
    void cast(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
              float reach_m, std::span<std::uint32_t> facets) const;

    /// Rays from many points. Neighbours in the list should be neighbours in space here, too.
    void cast(std::span<const Eigen::Vector3f> origins, std::span<const Eigen::Vector3f> directions,
              std::span<std::uint32_t> facets,
              float reach_m = std::numeric_limits<float>::infinity()) const;

    /// Rays from one point: any facet that direction i meets within `reach_m[i]`, or `nothing`.
    void cast_any(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
                  std::span<const float> reach_m, std::span<std::uint32_t> facets) const;

    /// Rays from many points: all facets that they meet within `reach_m`, by ray and distance.
    std::vector<MetFacet> cast_through(std::span<const Eigen::Vector3f> origins,
                                       std::span<const Eigen::Vector3f> directions,
                                       std::span<const float> reach_m) const;

    /// The facet at its present pose, scene-local. Copies have facet numbers of their own.
    Facet facet(std::uint32_t index) const {
        return index < still_ ? facets_[index] : placed_facet(index);
    }

    /// The number of triangles of the scene with its bodies and all copies.
    std::size_t placed_triangles() const;

  private:
    friend class SharedTrees;
    struct Trees;
    struct PlacedTree;
    Caster(std::shared_ptr<const Trees> trees,
           std::vector<std::shared_ptr<const PlacedTree>> placed_trees);
    static std::shared_ptr<Trees> make_trees(const Scene& scene);
    void trace(const RayList& list, std::span<std::uint32_t> facets) const;
    Facet placed_facet(std::uint32_t index) const;

    std::shared_ptr<const Trees> trees_;
    /// Trees of placed objects. Empty: the scene has only its own triangles; one: everything; two:
    /// objects at rest with the copies, then the bodies.
    std::vector<std::shared_ptr<const PlacedTree>> placed_trees_;
    std::vector<Pose> T_world_body_;
    /// Facets of the scene's own triangles, then of each other tree.
    const Facet* facets_ = nullptr;
    std::uint32_t still_ = 0;  ///< number of the scene's own triangles
};

/// Makes casters over scenes that share their first file, whose tree is kept. Thread-safe.
class SharedTrees {
  public:
    /// As Caster(scene), and faster if at most one of the earlier casters is left with its copies.
    Caster caster(const Scene& scene);

  private:
    std::mutex mutex_;
    std::array<std::shared_ptr<Caster::Trees>, 2> kept_;  ///< two variants at a time need one each
};

}  // namespace sonarsim
