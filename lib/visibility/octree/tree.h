#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "visibility/octree/leaf.h"
#include "visibility/octree/leaf_size.h"
#include "visibility/octree/options.h"
#include "visibility/view_volume.h"

namespace sonarsim {

// The upper part of the tree divides the scene until a cube holds few triangles: a tile. Below, a
// tile is a chain of levels from coarse to fine; one more level takes four times the memory. A
// level never changes once it is made, so any number of pings may read it.

/// Number of levels of a tile below its own cube. With tiles of 1 to 2 m, leaves are at least 2 to
/// 4 mm.
inline constexpr int most_levels = 9;

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

/// A node of a level. Its cube may be larger than the level's: a node whose surface is one flat
/// rectangle is not split until the level is a few times finer, since its parts would add nothing.
struct LevelNode {
    std::uint16_t x, y, z;  ///< index of its cube among those of its size within the tile
    std::uint8_t level;     ///< level of its cube below the tile's
    bool flat;              ///< one flat rectangle
    std::uint32_t facets;   ///< index of its first facet
};

/// All surface of a tile in cubes of one size. Nodes are in the order of their parents, so the
/// descendants of a node are one run of nodes and of facets in every finer level.
struct Level {
    int depth = 0;                         ///< halvings of the tile's cube
    std::shared_ptr<const Level> coarser;  ///< null at depth 0
    std::vector<std::uint32_t> children;   ///< the first child here of each node of `coarser`
    std::vector<LevelNode> nodes;          ///< the last one is a sentinel, in `children` as well
    std::vector<LeafFacet> facets;
};

/// A node of the upper part.
struct UpperNode {
    CubeIndex index;
    std::vector<std::uint32_t> triangles;  ///< empty once it is split
    std::shared_ptr<const Level> own;      ///< its own cube; null if it holds no surface
    std::uint32_t children = 0;            ///< index of its first child, once it is split
    std::uint8_t octants = 0;              ///< bit of each child that exists
    bool is_tile = false;

    std::shared_ptr<const Level> finest;  ///< the finest level of a tile
    std::size_t bytes = 0;                ///< memory of its levels below `own`
    std::uint64_t last_use = 0;           ///< number of the last ping that needed it
};

/// A cube that a search visits.
struct Visit {
    CubeIndex index;
    Eigen::Vector3f centre;  ///< in local axes, relative to the sensor
    float edge;
    Containment containment;
};

/// Updates the containment of a cube; false if it is outside of the view.
bool is_in_view(Visit& visit, const ViewVolume& volume);

/// A tile in view, or a node of the upper part that is as small as a leaf.
struct TileInView {
    Visit root;
    UpperNode* node;
    int depth;                           ///< the level with the leaves
    std::shared_ptr<const Level> level;  ///< null: not kept, for lack of memory
};

/// A view of the tree, ready for a ping.
struct PreparedView {
    View view;
    ViewVolume volume;
    LeafSize leaf_size;
    std::vector<TileInView> tiles = {};
};

/// Takes a leaf in view, its cube and its facets. `edge_m` is the edge of all leaves of the tile;
/// the cube of a flat leaf may be larger. Leaves may be hidden.
using TakeLeaf = std::function<void(const Visit& cube, float edge_m, std::span<const LeafFacet>)>;

/// The octree. A node's contents depend only on its cube and the scene, not on the ping that it was
/// made for.
class Octree {
  public:
    Octree(const Scene& scene, const Caster& caster, const OctreeOptions& options);

    /// Finds the tiles in a view, roughly near before far ones, and makes their levels. If memory
    /// is short, drops the least recently used tiles; if that does not suffice, visit_leaves()
    /// makes the rest. Only one thread may prepare at a time.
    PreparedView prepare(const View& view, const Pose& T_local_sensor, const LeafSize& leaf_size);

    /// Calls `take` for the leaves in view. Any number of threads may visit while another prepares.
    void visit_leaves(const PreparedView& prepared, const TakeLeaf& take) const;

    OctreeStatistics statistics() const;

  private:
    Cube cube(const CubeIndex& index) const;
    void add_upper(const CubeIndex& index, std::vector<std::uint32_t> triangles);
    void split(UpperNode& node);
    void find_tiles(UpperNode& node, Visit visit, PreparedView& prepared);
    Visit visit_of(const CubeIndex& index, const ViewVolume& volume) const;
    /// The level of a tile at this depth, made from a coarser one.
    std::shared_ptr<const Level> grown(const UpperNode& tile, std::shared_ptr<const Level> level,
                                       int depth) const;
    std::shared_ptr<const Level> level_of_cube(const CubeIndex& index,
                                               std::span<const std::uint32_t> triangles) const;
    bool add_node(const CubeIndex& tile, LevelNode node, std::span<const std::uint32_t> triangles,
                  Level& level) const;
    void add_children(const UpperNode& tile, const LevelNode& node, Level& finer) const;
    bool make_room(std::size_t bytes);

    LeafMaker maker_;
    Eigen::Vector3d min_;
    double edge_m_ = 0.0;
    double tile_edge_m_ = 0.0;
    int flat_levels_;  ///< largest ratio of a flat node's size to a leaf, as a power of 2
    std::size_t limit_bytes_;
    std::deque<UpperNode> upper_;  ///< the first is the root; nodes keep their addresses
    std::size_t upper_bytes_ = 0;
    std::size_t tile_bytes_ = 0;
    std::size_t most_ping_bytes_ = 0;
    std::uint64_t pings_ = 0;
    std::uint64_t evictions_ = 0;
};

/// The greatest length of a scene that these options can divide into leaves: 2^30 of them, less one
/// at either end.
double longest_octree_scene_m(const OctreeOptions& options);

}  // namespace sonarsim
