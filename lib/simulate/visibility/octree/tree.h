#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// A half-open cube [min, min + edge), scene-local, m.
struct Cube {
    Eigen::Vector3d min;
    double edge;
};

/// The position of a node: cube (x, y, z) of the 8^level cubes of its level.
struct CubeIndex {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    int level = 0;

    CubeIndex child(int octant) const {
        return {2 * x + (octant & 1), 2 * y + (octant >> 1 & 1), 2 * z + (octant >> 2), level + 1};
    }
};

/// The surface inside the cube (x, y, z) of a tile: of the direction and material with most area.
struct Leaf {
    Eigen::Vector3f normal;  ///< area-weighted mean, unit, scene-local
    std::uint32_t triangle;  ///< the largest of its triangles, for material and instance
    std::uint16_t x, y, z;
};

/// The leaves of a tile in the view of a ping, which do not change.
struct TileInView {
    Eigen::Vector3f corner;  ///< relative to the sonar, local axes
    Containment containment;
    std::shared_ptr<const std::vector<Leaf>> leaves;
};

/// The error message for a scene that is more than 2^30 leaves long; empty otherwise.
std::string too_small_leaves(double length_m, double leaf_m);

/// The octree of a scene, which grows where a sonar looks: its upper part divides the scene until a
/// cube holds few triangles, a tile, and the leaves of a tile are made when it first comes into
/// view. Any number of threads may use it.
class Octree {
  public:
    /// `scene` and `caster` must outlive it. InputError with too_small_leaves().
    Octree(const Scene& scene, const Caster& caster, double leaf_m);

    /// The tiles in view, the near ones first.
    std::vector<TileInView> tiles_in_view(const ViewVolume& volume);

    double leaf_m() const { return leaf_m_; }

  private:
    struct Node {
        CubeIndex index;
        bool is_tile = false;
        bool is_split = false;
        std::array<Node*, 8> children{};  ///< one for each octant; null: no surface
        std::uint64_t last_use = 0;       ///< number of the ping
        std::vector<std::uint32_t> triangles;
        std::shared_ptr<const std::vector<Leaf>> leaves;  ///< null: not made, or not a tile
    };

    Cube cube(const CubeIndex& index) const;
    std::vector<std::uint32_t> inside(const std::vector<std::uint32_t>& triangles,
                                      const Cube& cube) const;
    Node* add_node(const CubeIndex& index, std::vector<std::uint32_t> triangles);
    void split(Node& node);
    void add_leaves(const CubeIndex& tile, const CubeIndex& at,
                    const std::vector<std::uint32_t>& triangles, std::vector<Leaf>& leaves) const;
    void find_tiles(Node& node, Containment containment, const ViewVolume& volume,
                    std::vector<TileInView>& tiles);

    const Scene& scene_;
    const Caster& caster_;
    double leaf_m_;
    int leaf_level_ = 0;
    double edge_m_ = 0.0;  ///< edge of the cube around the scene
    Eigen::Vector3d min_;
    std::mutex growing_;
    std::deque<Node> nodes_;
    std::uint64_t pings_ = 0;
    std::size_t bytes_ = 0;  ///< memory of all leaves
};

/// Makes the paper's octree as printed, the baseline of comparisons: every leaf in view stands for
/// its surface with its cube's centre and one vote. In every pixel of azimuth and elevation the
/// leaves are sorted by range, and the first cluster, which ends at a gap of more than four leaves,
/// hides the others. The tree grows as pings come; a ping does not depend on earlier ones.
/// `leaf_m`: the edge of leaves. `scene` must outlive the engine. InputError with
/// too_small_leaves().
std::unique_ptr<VisibilityEngine> make_octree_engine(const Scene& scene, double leaf_m);

}  // namespace sonarsim
