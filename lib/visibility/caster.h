#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"

namespace sonarsim {

struct RayOrigins;

/// What is needed of a triangle once a ray has met it; 32 bytes, half a cache line.
struct Facet {
    Eigen::Vector3f vertex;  ///< one of its corners, scene-local, m
    std::uint32_t material;
    Eigen::Vector3f normal;  ///< unit
    std::uint32_t instance;
};

/// Embree behind one question: which triangle does a ray meet first? Distances are not Embree's
/// (its reciprocals differ between makers of processors) but come from the facet's plane.
class Caster {
  public:
    static constexpr std::uint32_t nothing = 0xFFFFFFFFU;

    /// Builds the tree over `scene`, and one over each of its bodies and shared meshes. Bodies are
    /// not met before `moved` has put them somewhere.
    explicit Caster(const Scene& scene);
    ~Caster();
    Caster(Caster&&) noexcept;
    Caster(const Caster&) = delete;
    Caster& operator=(const Caster&) = delete;

    /// The same trees, with the bodies at these poses. Takes time for each body, not for its
    /// triangles nor for copies of shared meshes. Scene-local frame.
    Caster moved(std::span<const Pose> T_local_body) const;

    /// Rays from one point: `facets[i]` is what direction i meets within `reach_m`, or `nothing`.
    /// Neighbours in the list should be neighbours in space. Scene-local frame.
    void cast(const Eigen::Vector3f& origin, std::span<const Eigen::Vector3f> directions,
              float reach_m, std::span<std::uint32_t> facets) const;

    /// Rays from many points. Neighbours should be neighbours in space here, too: what a surface
    /// mirrors stays together.
    void cast(std::span<const Eigen::Vector3f> origins, std::span<const Eigen::Vector3f> directions,
              std::span<std::uint32_t> facets) const;

    /// Whether a ray may meet anything: not when it is outside of the box around all there is and
    /// leads away from it.
    bool may_meet(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
        const auto beyond = origin.array() > high_ && direction.array() >= 0.0F;
        const auto below = origin.array() < low_ && direction.array() <= 0.0F;
        return !(beyond || below).any();
    }

    /// Where it is now, in the scene-local frame. Copies of a mesh have numbers of their own.
    Facet facet(std::uint32_t index) const {
        return index < still_ ? facets_[index] : placed_facet(index);
    }

    /// Fetches a facet that is soon asked for; `nothing` is allowed.
    void prefetch(std::uint32_t index) const {
        if (index < still_) __builtin_prefetch(&facets_[index]);
    }

  private:
    struct Trees;
    struct Moment;
    Caster(std::shared_ptr<const Trees> trees, std::vector<std::shared_ptr<const Moment>> moments);
    static std::shared_ptr<const Trees> make_trees(const Scene& scene);
    void cast_from(const RayOrigins& origins, std::span<const Eigen::Vector3f> directions,
                   float reach_m, std::span<std::uint32_t> facets) const;
    Facet placed_facet(std::uint32_t index) const;
    void find_box();

    std::shared_ptr<const Trees> trees_;
    /// Where things are. Empty: the scene's own triangles are all there is; two: what stands still
    /// with the copies, then the bodies.
    std::vector<std::shared_ptr<const Moment>> moments_;
    const Facet* facets_ = nullptr;  ///< of the scene's own triangles, then of each other tree
    std::uint32_t still_ = 0;        ///< how many are the scene's own
    Eigen::Array3f low_, high_;      ///< of the box around all there is, scene-local, m
};

}  // namespace sonarsim
