#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "input/scene/mesh_topology.h"
#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/local_pose.h"
#include "simulate/visibility/view_volume.h"

namespace sonarsim {

/// The spacing of rays as angles: of the columns of a view, and of the rays of a column.
struct RaySpacing {
    float across;
    float along;
};

/// Surface that is narrower, or more sharply bent, than the columns of rays are apart: wires,
/// rails, edges of plates. A ray that meets it would stand for a cell of the view, and most rays
/// pass it. Its triangles are cut into pieces instead, and one ray decides whether a piece is seen.
/// Bodies and copies of shared meshes are left to the columns.
class FineSurface {
  public:
    /// `scene` must outlive this object.
    explicit FineSurface(const Scene& scene);

    /// True if this spacing does not resolve the facet of Caster, seen from a distance of one of
    /// its corners.
    bool has(std::uint32_t facet, float distance_m, const RaySpacing& spacing) const {
        return facet < radii_m_.size() && radii_m_[facet] < resolved_m(distance_m, spacing);
    }

    /// The pieces of it that are seen, sorted by beam.
    Samples seen(const Caster& caster, const View& view, const Pose& T_world_sensor,
                 const RaySpacing& spacing) const;

  private:
    /// Neighbouring triangles, and a ball around them.
    struct Run {
        Ball ball;
        float min_radius_m;
    };
    static constexpr std::size_t run_triangles = 32;

    static float resolved_m(float distance_m, const RaySpacing& spacing);
    void add_run(std::size_t first);
    std::vector<std::uint32_t> in_view(const ViewVolume& volume, const LocalPose& pose,
                                       float reach_m, const RaySpacing& spacing) const;

    const Scene& scene_;
    std::vector<float> radii_m_;  ///< radius of curvature, or width, by triangle
    std::vector<Run> runs_;
};

}  // namespace sonarsim
