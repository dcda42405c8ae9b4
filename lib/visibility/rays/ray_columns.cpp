#include "visibility/rays/ray_columns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

#include "visibility/rays/gap_estimate.h"

namespace sonarsim {

namespace {

// Less than the narrowest bin.
constexpr float nearest_m = 1e-6F;

/// Two neighbours on a chain between which too much is at stake.
struct Gap {
    int chain;
    int below;
    int above;
};

/// Casts the chains of one view. Holds what its steps share; lives for one call.
class ChainCaster {
  public:
    ChainCaster(const Caster& caster, const View& view, const LocalPose& pose,
                const Sampling& sampling, Chains& out)
        : caster_(caster),
          view_(view),
          pose_(pose),
          sampling_(sampling),
          reach_m_(static_cast<float>(view.range_max_m)),
          columns_(columns(view, sampling.columns)),
          out_(out) {
        out_.columns = columns_.size();
    }

    void cast_columns() {
        // Room for the strips and the gaps, so that the nodes are seldom moved.
        out_.nodes.reserve(4 * columns_.size() * sampling_.chain);
        for (const Column& column : columns_) {
            add_chain(column, column.across, 0.5 * column.width, 0, sampling_.chain, true);
        }
        cast_nodes(in_tiles());
    }

    /// Splits each column into strips over the part where it and a neighbour disagree.
    void split_columns() {
        const int n = sampling_.chain;
        out_.split.assign(out_.columns * n, 0);
        if (!sampling_.split) return;
        for (std::size_t c = 0; c < out_.columns; ++c) {
            const std::size_t beside = neighbour(c);
            if (beside == c) continue;
            for (int i = 0; i < n; ++i) {
                const std::size_t a = c * n + i;
                const std::size_t b = beside * n + i;
                if (disagree(out_.nodes[a], out_.nodes[b], sampling_, reach_m_))
                    out_.split[a] = out_.split[b] = 1;
            }
        }
        for (std::size_t c = 0; c < out_.columns; ++c) {
            const auto* row = out_.split.data() + c * n;
            for (int i = 0; i < n; ++i) {
                if (!row[i]) continue;
                const int first = i;
                while (i < n && row[i])
                    ++i;
                const double half = 0.5 * columns_[c].width;
                for (const double side : {-1.0, 1.0}) {
                    add_chain(columns_[c], columns_[c].across + side * (1.0 - margin) * half,
                              margin * half, first, i, false);
                }
            }
        }
        cast_new_nodes();
    }

    /// Splits the gaps between neighbours on a chain.
    void split_gaps() {
        std::vector<Gap> gaps;
        const auto note_above = [&](int chain, int below) {
            const int above = out_.nodes[below].next;
            if (above != ChainNode::none) note_gap({chain, below, above}, 0, gaps);
        };
        for (const int node : in_tiles())
            note_above(node / sampling_.chain, node);
        for (std::size_t c = out_.columns; c < out_.chains.size(); ++c) {
            for (int i = out_.chains[c].first; i != ChainNode::none; i = out_.nodes[i].next) {
                note_above(static_cast<int>(c), i);
            }
        }
        std::vector<Gap> halves;
        for (int level = 0; level < sampling_.levels && !gaps.empty(); ++level) {
            const int first = static_cast<int>(out_.nodes.size());
            for (const Gap& gap : gaps) {
                const float along =
                    next_along(out_.nodes[gap.below], out_.nodes[gap.above], reach_m_);
                add_node(out_.chains[gap.chain].across, turn_small(along), along);
            }
            cast_new_nodes();
            halves.clear();
            for (int k = 0; k < static_cast<int>(gaps.size()); ++k) {
                const Gap& gap = gaps[k];
                out_.nodes[gap.below].next = first + k;
                out_.nodes[first + k].next = gap.above;
                note_gap({gap.chain, gap.below, first + k}, level + 1, halves);
                note_gap({gap.chain, first + k, gap.above}, level + 1, halves);
            }
            std::swap(gaps, halves);
        }
    }

  private:
    /// The column beside column c, on its positive side; c itself where there is none.
    std::size_t neighbour(std::size_t c) const {
        if (view_.shape == ViewShape::cone) return (c + 1) % out_.columns;
        const bool last = c + 1 == out_.columns;
        const bool other_side =
            !last && view_.shape == ViewShape::sides && columns_[c].beam != columns_[c + 1].beam;
        return last || other_side ? c : c + 1;
    }

    void add_chain(const Column& column, double across, double half_width, int begin, int end,
                   bool whole) {
        const double step = sampling_.step(column.along_max - column.along_min);
        const auto at = [&](double i) {
            return static_cast<float>(column.along_min + (sampling_.inset + i) * step);
        };
        const Turn middle = turn(across);
        const float along_min = begin == 0 ? static_cast<float>(column.along_min) : at(begin - 0.5);
        const float along_max =
            end == sampling_.chain ? static_cast<float>(column.along_max) : at(end - 0.5);
        out_.chains.push_back({column.beam, static_cast<float>(half_width), middle, along_min,
                               along_max, static_cast<float>(step),
                               static_cast<int>(out_.nodes.size()), whole});
        for (int i = begin; i < end; ++i) {
            add_node(middle, turn_small(at(i)), at(i));
            if (i + 1 < end) out_.nodes.back().next = static_cast<int>(out_.nodes.size());
        }
    }

    void add_node(Turn across, Turn along, float angle) {
        out_.nodes.push_back({direction(view_.shape, across, along), angle});
    }

    /// The nodes of the columns in tiles of columns x nodes, each of which fills a packet: rays
    /// that leave close together walk the tree together, twice as fast as in chains.
    std::vector<int> in_tiles() const {
        constexpr int side = 4;
        const int columns = static_cast<int>(out_.columns);
        const int n = sampling_.chain;
        std::vector<int> order;
        order.reserve(static_cast<std::size_t>(columns) * n);
        for (int c0 = 0; c0 < columns; c0 += side) {
            for (int i0 = 0; i0 < n; i0 += side) {
                for (int i = i0; i < std::min(i0 + side, n); ++i) {
                    for (int c = c0; c < std::min(c0 + side, columns); ++c) {
                        order.push_back(c * n + i);
                    }
                }
            }
        }
        return order;
    }

    void cast_new_nodes() {
        std::vector<int> order(out_.nodes.size() - cast_);
        std::iota(order.begin(), order.end(), static_cast<int>(cast_));
        cast_nodes(order);
    }

    /// Casts the nodes that have not been cast, in the given order.
    void cast_nodes(const std::vector<int>& order) {
        const std::size_t count = order.size();
        directions_.resize(count);
        facets_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            directions_[i] = pose_.rotation * out_.nodes[order[i]].direction;
        }
        caster_.cast(pose_.position, directions_, reach_m_ * (1.0F + beyond), facets_);
        const Eigen::Matrix3f R_sensor_local = pose_.rotation.transpose();
        for (std::size_t i = 0; i < count; ++i) {
            // The facets of a large scene lie in main memory, all over the place.
            constexpr std::size_t ahead = 16;
            if (i + ahead < count) caster_.prefetch(facets_[i + ahead]);
            ChainNode& node = out_.nodes[order[i]];
            node.facet = facets_[i];
            if (node.missed()) continue;
            const Facet& facet = caster_.facet(node.facet);
            const float height = facet.normal.dot(pose_.position - facet.vertex);
            const float side = height < 0.0F ? -1.0F : 1.0F;
            node.normal = R_sensor_local * (side * facet.normal);
            node.height_m = side * height;
            node.cosine = -node.normal.dot(node.direction);
            node.range_m = node.height_m / node.cosine;
            node.material = facet.material;
            node.instance = facet.instance;
            // A plane seen edge-on to within rounding has no range and reflects nothing; one that
            // the sonar touches has no direction.
            if (!(node.cosine > 1e-7F && node.range_m > nearest_m)) {
                node.facet = Caster::nothing;
                ++out_.dropped;
            }
        }
        cast_ = out_.nodes.size();
    }

    /// Finds out what lies between two neighbours, and whether to split it after `level` times.
    void note_gap(const Gap& gap, int level, std::vector<Gap>& gaps) {
        ChainNode& below = out_.nodes[gap.below];
        const Between what = between(below, out_.nodes[gap.above], sampling_, reach_m_);
        below.joined = what.joined;
        below.border = what.border;
        if (what.at_stake_m > sampling_.at_stake_m || (what.turns && level < sampling_.turns)) {
            gaps.push_back(gap);
        }
    }

    const Caster& caster_;
    const View& view_;
    const LocalPose& pose_;
    const Sampling& sampling_;
    const float reach_m_;
    const std::vector<Column> columns_;
    Chains& out_;
    std::size_t cast_ = 0;  ///< nodes that have been cast
    std::vector<Eigen::Vector3f> directions_;
    std::vector<std::uint32_t> facets_;
};

}  // namespace

Chains cast_chains(const Caster& caster, const View& view, const LocalPose& pose,
                   const Sampling& sampling) {
    Chains out;
    ChainCaster cast(caster, view, pose, sampling, out);
    cast.cast_columns();
    cast.split_columns();
    cast.split_gaps();
    return out;
}

}  // namespace sonarsim
