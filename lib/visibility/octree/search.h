#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <vector>

#include "visibility/octree/leaf_size.h"
#include "visibility/octree/tree.h"
#include "visibility/view_volume.h"

namespace sonarsim {

/// Number of levels of a tile below its own cube. A tile is refined to one level as a whole: one
/// more level would take four times the memory. With tiles of 1 to 2 m, leaves are at least 2 to 4
/// mm.
inline constexpr int most_levels = 9;

/// A cube that the search visits.
struct Visit {
    CubeIndex index;
    Eigen::Vector3f centre;  ///< in local axes, relative to the sensor
    float edge;
    Containment containment;
};

/// A node of a tile whose own cube is `root`.
inline Visit node_visit(const Visit& root, const LevelNode& node) {
    const float edge = root.edge / static_cast<float>(1U << node.level);
    const Eigen::Vector3f at(node.x, node.y, node.z);
    const Eigen::Vector3f corner = root.centre.array() - 0.5F * root.edge;
    return {{}, corner.array() + edge * (at.array() + 0.5F), edge, root.containment};
}

/// Leaves in view: a run of nodes of a level. Some of them may be hidden.
struct LeafRun {
    Visit root;  ///< the tile that the level belongs to
    const Level* level;
    std::uint32_t begin, end;
    float leaf_m;  ///< edge of the level's cubes

    std::uint32_t facets_begin() const { return level->nodes[begin].facets; }
    std::uint32_t facets_end() const { return level->nodes[end].facets; }
};

/// Finds the leaves in the volume of view. Calls `take(run)` for each run of them, roughly near
/// tiles before far ones; a run is valid only during the call.
template <class Take>
class Search {
  public:
    Search(Octree& tree, const ViewVolume& volume, const LeafSize& leaf_size, Take& take)
        : tree_(tree),
          volume_(volume),
          leaf_size_(leaf_size),
          take_(take),
          ping_(tree.next_ping()) {}

    void run() {
        const Visit root = start({});
        bool complete = false;
        {
            const std::shared_lock shared(tree_.top_lock());
            complete = enter_top(0, root, nullptr);
        }
        if (!complete) {
            const std::unique_lock alone(tree_.top_lock());
            entries_.clear();
            enter_top(0, root, &tree_);
        }
        for (const Entry& entry : entries_) {
            if (entry.tile) {
                search(*entry.tile, entry.visit);
            } else {
                take_(LeafRun{entry.visit, entry.level, 0, 1, entry.visit.edge});
            }
        }
        tree_.note_ping_bytes(bytes_);
    }

  private:
    struct Entry {
        Visit visit;
        const Level* level;
        Tile* tile;
    };

    Visit start(const CubeIndex& index) const {
        const Cube cube = tree_.cube(index);
        const Eigen::Vector3d centre = cube.min.array() + 0.5 * cube.edge;
        return {index, (centre - volume_.position()).cast<float>(), static_cast<float>(cube.edge),
                Containment::partly};
    }

    /// Returns false if the node is not in view. The radius of the ball around a cube is slightly
    /// more than half its diagonal, for rounding.
    bool is_in_view(Visit& visit) const {
        if (visit.containment != Containment::inside)
            visit.containment =
                volume_.containment(visit.centre, 0.8661F * visit.edge + volume_.rounding_m());
        return visit.containment != Containment::outside;
    }

    /// Number of halvings until a node is as small as a leaf at its distance.
    int halvings(const Visit& visit) const {
        const float leaf = leaf_size_.at(visit.centre.norm()) * 1.0001F;
        int count = 0;
        for (float edge = visit.edge; edge > leaf && visit.index.level + count < 30; edge *= 0.5F)
            ++count;
        return count;
    }

    /// Lists the tiles below a top node. Returns false if a node must be split and `grower` is
    /// null.
    bool enter_top(std::uint32_t index, Visit visit, Octree* grower) {
        if (!is_in_view(visit)) return true;
        const TopNode& node = tree_.top(index);
        if (node.level.nodes.empty()) return true;
        if (node.tile || halvings(visit) == 0) {
            entries_.push_back({visit, &node.level, node.tile.get()});
            return true;
        }
        if (node.children == 0) {
            if (!grower) return false;
            grower->split(index);
        }
        const int near = (visit.centre.x() < 0.0F) | (visit.centre.y() < 0.0F) << 1 |
                         (visit.centre.z() < 0.0F) << 2;
        for (int i = 0; i < 8; ++i) {
            const unsigned octant = i ^ near;
            if (!(node.octants >> octant & 1U)) continue;
            const auto before = static_cast<std::uint32_t>(
                __builtin_popcount(node.octants & ((1U << octant) - 1U)));
            Visit child = start(visit.index.child(static_cast<int>(octant)));
            child.containment = visit.containment;
            if (!enter_top(node.children + before, child, grower)) return false;
        }
        return true;
    }

    void search(Tile& tile, const Visit& root) {
        const int depth = std::min(halvings(root), most_levels);
        tile.last_ping.store(ping_, std::memory_order_relaxed);
        {
            const std::shared_lock shared(tile.lock);
            if (static_cast<int>(tile.levels.size()) > depth) {
                bytes_ += tile.bytes;
                enter(tile, root, depth);
                return;
            }
        }
        {
            const std::unique_lock alone(tile.lock);
            tree_.grow(tile, depth + 1);
            bytes_ += tile.bytes;
            enter(tile, root, depth);
        }
        tree_.evict();
    }

    void enter(const Tile& tile, const Visit& root, int depth) {
        pending_ = {root, &tile.levels[depth], 0, 0, root.edge / static_cast<float>(1U << depth)};
        enter(tile, root, 0, 0, 1, depth);
        flush();
    }

    /// Nodes [begin, end) of a level, children of one node or the tile's root.
    void enter(const Tile& tile, const Visit& root, int level, std::uint32_t begin,
               std::uint32_t end, int depth) {
        const std::vector<LevelNode>& nodes = tile.levels[level].nodes;
        for (std::uint32_t i = begin; i < end; ++i) {
            Visit visit = node_visit(root, nodes[i]);
            if (!is_in_view(visit)) continue;
            if (level == depth) {
                add(i, i + 1);
            } else if (visit.containment == Containment::inside) {
                std::uint32_t from = i;
                std::uint32_t to = i + 1;
                for (int l = level; l < depth; ++l) {
                    from = tile.levels[l].nodes[from].children;
                    to = tile.levels[l].nodes[to].children;
                }
                add(from, to);
            } else {
                enter(tile, root, level + 1, nodes[i].children, nodes[i + 1].children, depth);
            }
        }
    }

    void add(std::uint32_t begin, std::uint32_t end) {
        if (begin != pending_.end) {
            flush();
            pending_.begin = begin;
        }
        pending_.end = end;
    }

    void flush() {
        if (pending_.begin < pending_.end) take_(pending_);
        pending_.begin = pending_.end;
    }

    Octree& tree_;
    const ViewVolume& volume_;
    const LeafSize& leaf_size_;
    Take& take_;
    std::uint64_t ping_;
    LeafRun pending_{};
    std::size_t bytes_ = 0;  ///< size of the tiles searched so far
    std::vector<Entry> entries_;
};

}  // namespace sonarsim
