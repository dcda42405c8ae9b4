#include "surface/chains.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr int no_node = -1;
constexpr int thirds = 3;

struct Turn {
    float sin;
    float cos;
};

Turn turn(double angle) {
    const SinCos s = sincos(angle);
    return {static_cast<float>(s.sin), static_cast<float>(s.cos)};
}

Turn turn_small(float angle) {
    const SinCosFloat s = sincos_small(angle);
    return {s.sin, s.cos};
}

/// Unit vector of an azimuth and an elevation, sensor frame.
Eigen::Vector3f direction(Turn azimuth, Turn elevation) {
    return {elevation.cos * azimuth.cos, elevation.cos * azimuth.sin, elevation.sin};
}

/// A ray and the plane of what it met.
struct Node {
    Eigen::Vector3f direction;  ///< sensor frame
    float elevation;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< towards the sensor
    float height_m = 0.0F;                             ///< of the sensor above the plane
    float cosine = 0.0F;                               ///< of incidence
    std::uint32_t facet = Caster::nothing;
    std::uint32_t material = 0;
    int next = no_node;  ///< the next node up in elevation

    bool missed() const { return facet == Caster::nothing; }
    float range_m() const { return height_m / cosine; }
};

/// A chain of nodes over a rectangle of azimuth and elevation within one beam.
struct Chain {
    int beam;
    float half_width;  ///< in azimuth, rad
    Turn azimuth;      ///< of the chain's rays
    float elevation_min;
    float elevation_max;
    int first;
};

/// Two neighbours on a chain that do not lie on one surface.
struct Gap {
    int chain;
    int below;
    int above;
};

class Chains {
  public:
    Chains(const Caster& caster, const View& view, const LocalPose& pose, const Sampling& sampling)
        : caster_(caster), view_(view), pose_(pose), sampling_(sampling) {
        step_ = static_cast<float>(view.elevation_rad / sampling.chain);
        bottom_ = static_cast<float>(-0.5 * view.elevation_rad);
        elevations_.resize(sampling.chain);
        for (int i = 0; i < sampling.chain; ++i)
            elevations_[i] = turn(lattice(i));
    }

    void cast_lattice() {
        const double width = view_.azimuth_rad / view_.beams;
        for (int j = 0; j < view_.beams; ++j) {
            const double azimuth = -0.5 * view_.azimuth_rad + (j + 0.5) * width;
            add_chain(j, azimuth, 0.5 * width, 0, sampling_.chain);
        }
        cast_new_nodes();
    }

    /// Replaces each beam by thirds over the elevations where it and a neighbour disagree.
    void split_beams() {
        const int n = sampling_.chain;
        split_.assign(static_cast<std::size_t>(view_.beams) * n, 0);
        if (!sampling_.split_beams) return;
        for (int j = 0; j + 1 < view_.beams; ++j) {
            for (int i = 0; i < n; ++i) {
                const std::size_t here = static_cast<std::size_t>(j) * n + i;
                if (disagree(nodes_[here], nodes_[here + n])) split_[here] = split_[here + n] = 1;
            }
        }
        const double width = view_.azimuth_rad / view_.beams;
        for (int j = 0; j < view_.beams; ++j) {
            const double azimuth = -0.5 * view_.azimuth_rad + (j + 0.5) * width;
            const auto* row = split_.data() + static_cast<std::size_t>(j) * n;
            for (int i = 0; i < n; ++i) {
                if (!row[i]) continue;
                const int first = i;
                while (i < n && row[i])
                    ++i;
                for (const int side : {-1, 1}) {
                    add_chain(j, azimuth + side * width / thirds, 0.5 * width / thirds, first, i);
                }
            }
        }
        cast_new_nodes();
    }

    void bisect() {
        std::vector<Gap> gaps;
        for (int c = 0; c < static_cast<int>(chains_.size()); ++c) {
            for (int b = chains_[c].first; nodes_[b].next != no_node; b = nodes_[b].next) {
                note_gap({c, b, nodes_[b].next}, gaps);
            }
        }
        std::vector<Gap> halves;
        for (int level = 0; level < sampling_.levels && !gaps.empty(); ++level) {
            const int first = static_cast<int>(nodes_.size());
            for (const Gap& gap : gaps) {
                const float middle =
                    0.5F * (nodes_[gap.below].elevation + nodes_[gap.above].elevation);
                add_node(chains_[gap.chain].azimuth, turn_small(middle), middle);
            }
            cast_new_nodes();
            halves.clear();
            for (int k = 0; k < static_cast<int>(gaps.size()); ++k) {
                const Gap& gap = gaps[k];
                nodes_[gap.below].next = first + k;
                nodes_[first + k].next = gap.above;
                note_gap({gap.chain, gap.below, first + k}, halves);
                note_gap({gap.chain, first + k, gap.above}, halves);
            }
            std::swap(gaps, halves);
        }
    }

    void collect(Samples& samples) const {
        std::vector<std::uint32_t> count(view_.beams + 1, 0);
        samples.items.clear();
        // The first chains are the beams in order; those of the thirds follow, in order, too.
        std::size_t third = view_.beams;
        samples.beam_begin.assign(view_.beams + 1, 0);
        for (int j = 0; j < view_.beams; ++j) {
            collect(chains_[j], samples.items);
            for (; third < chains_.size() && chains_[third].beam == j; ++third) {
                collect(chains_[third], samples.items);
            }
            samples.beam_begin[j + 1] = static_cast<std::uint32_t>(samples.items.size());
        }
    }

  private:
    double lattice(int i) const {
        return -0.5 * view_.elevation_rad + (i + 0.5) * view_.elevation_rad / sampling_.chain;
    }

    void add_chain(int beam, double azimuth, double half_width, int begin, int end) {
        const int first = static_cast<int>(nodes_.size());
        chains_.push_back({beam, static_cast<float>(half_width), turn(azimuth),
                           bottom_ + begin * step_, bottom_ + end * step_, first});
        for (int i = begin; i < end; ++i) {
            add_node(chains_.back().azimuth, elevations_[i], static_cast<float>(lattice(i)));
            nodes_.back().next = i + 1 < end ? static_cast<int>(nodes_.size()) : no_node;
        }
    }

    void add_node(Turn azimuth, Turn elevation, float angle) {
        nodes_.push_back({direction(azimuth, elevation), angle});
    }

    void cast_new_nodes() {
        const std::size_t count = nodes_.size() - cast_;
        directions_.resize(count);
        facets_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            directions_[i] = pose_.rotation * nodes_[cast_ + i].direction;
        }
        // What lies beyond the range can neither echo nor hide what does.
        caster_.cast(pose_.position, directions_, static_cast<float>(view_.range_max_m) * 1.01F,
                     facets_);
        const Eigen::Matrix3f R_sensor_local = pose_.rotation.transpose();
        for (std::size_t i = 0; i < count; ++i) {
            Node& node = nodes_[cast_ + i];
            node.facet = facets_[i];
            if (node.missed()) continue;
            const Facet& facet = caster_.facet(node.facet);
            const float height = facet.normal.dot(pose_.position - facet.vertex);
            const float side = height < 0.0F ? -1.0F : 1.0F;
            node.normal = R_sensor_local * (side * facet.normal);
            node.height_m = side * height;
            node.cosine = -node.normal.dot(node.direction);
            node.material = facet.material;
            // A plane seen edge-on to within rounding has no range and reflects nothing.
            if (!(node.cosine > 1e-7F)) node.facet = Caster::nothing;
        }
        cast_ = nodes_.size();
    }

    void note_gap(const Gap& gap, std::vector<Gap>& gaps) const {
        if (disagree(nodes_[gap.below], nodes_[gap.above])) gaps.push_back(gap);
    }

    /// Whether two rays met what cannot be taken for one smooth surface of one material.
    bool disagree(const Node& a, const Node& b) const {
        const float reach = static_cast<float>(view_.range_max_m);
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
        const float slack = sampling_.tolerance_m + 0.1F * std::fabs(range_a - range_b);
        return std::fabs(a.height_m - range_b * cosine_ab) > slack * cosine_ab ||
               std::fabs(b.height_m - range_a * cosine_ba) > slack * cosine_ba ||
               std::fabs(cosine_ab - b.cosine) > sampling_.tolerance_cosine;
    }

    void collect(const Chain& chain, std::vector<Sample>& items) const {
        const bool whole = chain.half_width * 2.0F * view_.beams > 0.75F * view_.azimuth_rad;
        float from = chain.elevation_min;
        for (int i = chain.first; i != no_node; i = nodes_[i].next) {
            const Node& node = nodes_[i];
            const float to = node.next == no_node
                                 ? chain.elevation_max
                                 : 0.5F * (node.elevation + nodes_[node.next].elevation);
            if (!node.missed()) {
                float half_width = chain.half_width;
                if (whole && is_split(chain.beam, node.elevation)) half_width /= thirds;
                items.push_back(piece(node, chain.azimuth, half_width, from, to));
            }
            from = to;
        }
    }

    bool is_split(int beam, float elevation) const {
        const int i =
            std::clamp(static_cast<int>((elevation - bottom_) / step_), 0, sampling_.chain - 1);
        return split_[static_cast<std::size_t>(beam) * sampling_.chain + i] != 0;
    }

    /// The part of the node's plane between two elevations, `half_width` to either side.
    Sample piece(const Node& node, Turn azimuth, float half_width, float from, float to) const {
        const Turn side = turn_small(half_width);
        const Turn left{azimuth.sin * side.cos + azimuth.cos * side.sin,
                        azimuth.cos * side.cos - azimuth.sin * side.sin};
        const Turn right{azimuth.sin * side.cos - azimuth.cos * side.sin,
                         azimuth.cos * side.cos + azimuth.sin * side.sin};
        const Turn middle = turn_small(0.5F * (from + to));
        const Eigen::Vector3f low = on_plane(node, direction(azimuth, turn_small(from)));
        const Eigen::Vector3f high = on_plane(node, direction(azimuth, turn_small(to)));
        const Eigen::Vector3f port = on_plane(node, direction(left, middle));
        const Eigen::Vector3f starboard = on_plane(node, direction(right, middle));
        Sample sample;
        sample.position = 0.5F * (low + high);
        sample.edge_u = 0.5F * (port - starboard);
        sample.edge_v = 0.5F * (high - low);
        sample.normal = node.normal;
        sample.area_m2 = 4.0F * sample.edge_u.cross(sample.edge_v).norm();
        sample.material = node.material;
        sample.instance = caster_.facet(node.facet).instance;
        return sample;
    }

    /// Where a direction meets the node's plane. Towards a plane's horizon the range is held to
    /// twice the node's: beyond that, no ray has said that the plane goes on.
    static Eigen::Vector3f on_plane(const Node& node, const Eigen::Vector3f& direction) {
        const float cosine = std::max(-node.normal.dot(direction), 0.5F * node.cosine);
        return direction * (node.height_m / cosine);
    }

    const Caster& caster_;
    const View& view_;
    const LocalPose& pose_;
    const Sampling& sampling_;
    float step_ = 0.0F;
    float bottom_ = 0.0F;
    std::vector<Turn> elevations_;
    std::vector<Node> nodes_;
    std::vector<Chain> chains_;
    std::vector<std::uint8_t> split_;  ///< [beams, chain]: seen in thirds
    std::size_t cast_ = 0;             ///< nodes that have been cast
    std::vector<Eigen::Vector3f> directions_;
    std::vector<std::uint32_t> facets_;
};

}  // namespace

Sampling sampling_for(const View& view) {
    Sampling sampling;
    const double beam = view.azimuth_rad / view.beams;
    sampling.chain =
        std::clamp(static_cast<int>(std::ceil(view.elevation_rad / beam / 1.6)), 4, 1024);
    sampling.tolerance_m = static_cast<float>(view.bin_m());
    return sampling;
}

void sample_chains(const Caster& caster, const View& view, const LocalPose& pose,
                   const Sampling& sampling, Samples& samples) {
    Chains chains(caster, view, pose, sampling);
    chains.cast_lattice();
    chains.split_beams();
    chains.bisect();
    chains.collect(samples);
}

}  // namespace sonarsim
