#include "surface/chains.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace sonarsim {

namespace {

// At grazing incidence the cosine is the intensity, and what counts is its relative error. Below
// this the surface is too dark to matter.
constexpr float least_cosine = 0.02F;

// Less than the narrowest bin.
constexpr float nearest_m = 1e-6F;

// Half a degree: with one column to a beam of 2 degrees, a tank misses a goal of 1 % by a factor of
// nine.
constexpr double widest_column = 0.0088;  // rad

// Two degrees, of a side that is not narrow: four columns over a wide elevation were off by 20 %.
constexpr double widest_strip = 0.035;  // rad

/// Two neighbours on a chain that do not lie on one surface.
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
          columns_(columns(view, sampling.columns)),
          out_(out) {
        out_.columns = columns_.size();
    }

    void cast_columns() {
        // Room for the strips and the bisections, so that the nodes are seldom moved.
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
                if (disagree(out_.nodes[a], out_.nodes[b])) out_.split[a] = out_.split[b] = 1;
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

    void bisect() {
        std::vector<Gap> gaps;
        const auto note_above = [&](int chain, int below) {
            const int above = out_.nodes[below].next;
            if (above != ChainNode::none) note_gap({chain, below, above}, gaps);
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
                const float middle =
                    0.5F * (out_.nodes[gap.below].along + out_.nodes[gap.above].along);
                add_node(out_.chains[gap.chain].across, turn_small(middle), middle);
            }
            cast_new_nodes();
            halves.clear();
            for (int k = 0; k < static_cast<int>(gaps.size()); ++k) {
                const Gap& gap = gaps[k];
                out_.nodes[gap.below].next = first + k;
                out_.nodes[first + k].next = gap.above;
                note_gap({gap.chain, gap.below, first + k}, halves);
                note_gap({gap.chain, first + k, gap.above}, halves);
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
        const double step = (column.along_max - column.along_min) / sampling_.chain;
        const auto at = [&](double i) { return static_cast<float>(column.along_min + i * step); };
        const Turn middle = turn(across);
        out_.chains.push_back({column.beam, static_cast<float>(half_width), middle, at(begin),
                               at(end), static_cast<int>(out_.nodes.size()), whole});
        for (int i = begin; i < end; ++i) {
            add_node(middle, turn_small(at(i + 0.5)), at(i + 0.5));
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
        // What lies beyond the range can neither echo nor hide what does.
        caster_.cast(pose_.position, directions_, static_cast<float>(view_.range_max_m) * 1.01F,
                     facets_);
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
            node.material = facet.material;
            node.instance = facet.instance;
            // A plane seen edge-on to within rounding has no range and reflects nothing; one that
            // the sonar touches has no direction.
            if (!(node.cosine > 1e-7F && node.range_m() > nearest_m)) {
                node.facet = Caster::nothing;
                ++out_.dropped;
            }
        }
        cast_ = out_.nodes.size();
    }

    void note_gap(const Gap& gap, std::vector<Gap>& gaps) {
        ChainNode& below = out_.nodes[gap.below];
        below.joined = !disagree(below, out_.nodes[gap.above]);
        if (!below.joined) gaps.push_back(gap);
    }

    /// Whether two rays met what cannot be taken for one smooth surface of one material.
    bool disagree(const ChainNode& a, const ChainNode& b) const {
        const auto reach = static_cast<float>(view_.range_max_m);
        if (a.missed() || b.missed()) {
            return !(a.missed() && b.missed()) && (a.missed() ? b : a).range_m() < reach;
        }
        if (a.facet == b.facet) return false;
        if (a.material != b.material) return true;
        const float cosine_ab = -a.normal.dot(b.direction);
        const float cosine_ba = -b.normal.dot(a.direction);
        if (!(cosine_ab > 0.0F && cosine_ba > 0.0F)) return true;
        const float range_a = a.range_m();
        const float range_b = b.range_m();
        if (range_a > reach && range_b > reach) return false;
        const float slack =
            sampling_.tolerance_m + sampling_.tolerance_slope * std::fabs(range_a - range_b);
        return std::fabs(a.height_m - range_b * cosine_ab) > slack * cosine_ab ||
               std::fabs(b.height_m - range_a * cosine_ba) > slack * cosine_ba ||
               std::fabs(cosine_ab - b.cosine) >
                   sampling_.tolerance_cosine * std::max(b.cosine, least_cosine);
    }

    const Caster& caster_;
    const View& view_;
    const LocalPose& pose_;
    const Sampling& sampling_;
    const std::vector<Column> columns_;
    Chains& out_;
    std::size_t cast_ = 0;  ///< nodes that have been cast
    std::vector<Eigen::Vector3f> directions_;
    std::vector<std::uint32_t> facets_;
};

}  // namespace

Sampling sampling_for(const View& view) {
    // Fitted to the report: at a goal of 3 % the mean over poses is 1.6 % in the tank and 2.9 % on
    // the sea floor; a single pose may miss it. From there the density follows the goal: rays and
    // bisections grow as the error shrinks.
    const double scale = view.relative_l1 / 0.03;
    const double density = 1.0 / std::sqrt(scale);
    const auto rays = [&](double count, double least) {
        return static_cast<int>(std::clamp(std::ceil(count * density), least, 4096.0));
    };
    Sampling sampling;
    switch (view.shape) {
        case ViewShape::fan:
            // The error of a fan falls as the spacing of its rays does, up and across: a beam wider
            // than the usual half degree takes more than one column.
            sampling.columns = static_cast<int>(
                std::clamp(std::ceil(view.azimuth_rad / view.beams / widest_column), 1.0, 64.0));
            sampling.chain = rays(0.8 * density * view.elevation_rad * view.beams *
                                      sampling.columns / view.azimuth_rad,
                                  8.0);
            break;
        case ViewShape::sides:
            // A side is one row of bins: with no other beam to average out what one misses, a ray
            // to a bin and a few columns for the shapes of shadows.
            sampling.columns = rays(std::max(4.0, view.elevation_rad / widest_strip), 2.0);
            sampling.chain = rays(1.0 * view.range_bins, 64.0);
            break;
        case ViewShape::cone:
            // All of a cone is one column of bins; a small object may be alone in its own.
            sampling.columns = rays(72.0, 8.0);
            sampling.chain = rays(48.0, 4.0);
            break;
    }
    sampling.levels = 3;
    for (double s = scale; s < 0.6 && sampling.levels < 8; s *= 2.0)
        ++sampling.levels;
    const auto slack = static_cast<float>(std::clamp(scale, 0.1, 2.0));
    sampling.tolerance_m = slack * static_cast<float>(view.bin_m());
    sampling.tolerance_cosine = 0.1F * slack;
    return sampling;
}

Chains cast_chains(const Caster& caster, const View& view, const LocalPose& pose,
                   const Sampling& sampling) {
    Chains out;
    ChainCaster cast(caster, view, pose, sampling, out);
    cast.cast_columns();
    cast.split_columns();
    cast.bisect();
    return out;
}

}  // namespace sonarsim
