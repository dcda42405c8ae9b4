#include "surface/chain_samples.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace sonarsim {

namespace {

/// A point of the surface on a given ray.
struct Point {
    float range_m = 0.0F;
    float cosine = 0.0F;  ///< of incidence
};

/// Where two cells of a chain meet: one point where the surface goes on, two where it does not.
struct Border {
    Eigen::Vector3f direction;
    float along;
    Point below;
    Point above;
    bool joined;
};

/// The part of a chain that a node stands for.
struct Cell {
    Border from;
    Border to;
    float half_width;  ///< across, rad
    bool alone;        ///< the surface may end beside the chain
};

struct Context {
    ViewShape shape;
    const Sampling& sampling;
    const Chains& chains;
};

/// Where a direction meets the node's plane. Where the surface goes on, the range is held to twice
/// the node's, short of the plane's horizon; where it ends before the next ray, a plane seen at
/// grazing incidence would run far out over the edge, so the range stays put.
Point on_plane(const ChainNode& node, const Eigen::Vector3f& ray, bool goes_on, float slack_m) {
    const float cosine = std::max(-node.normal.dot(ray), 0.5F * node.cosine);
    const float range = node.range_m();
    const float slack = goes_on ? range : slack_m;
    return {std::clamp(node.height_m / cosine, range - slack, range + slack), cosine};
}

/// The border between two neighbours, either of which may be missing at a chain's end.
Border border(const Context& context, const Chain& chain, int below, int above) {
    const ChainNode* const a = below == ChainNode::none ? nullptr : &context.chains.nodes[below];
    const ChainNode* const b = above == ChainNode::none ? nullptr : &context.chains.nodes[above];
    Border out{};
    out.along = !a ? chain.along_min : !b ? chain.along_max : 0.5F * (a->along + b->along);
    out.direction = direction(context.shape, chain.across, turn_small(out.along));
    // A column ends with the view, where the surface most likely goes on; a margin of one ends
    // where its neighbours begin to agree.
    out.joined = a && b ? a->joined : chain.whole;
    const float slack = context.sampling.tolerance_m;
    if (a && !a->missed()) out.below = on_plane(*a, out.direction, out.joined, slack);
    if (b && !b->missed()) out.above = on_plane(*b, out.direction, out.joined, slack);
    if (a && b && out.joined && !a->missed() && !b->missed()) {
        const Point middle{0.5F * (out.below.range_m + out.above.range_m),
                           0.5F * (out.below.cosine + out.above.cosine)};
        out.below = out.above = middle;
    }
    return out;
}

/// The surface in a node's cell, as a parallelogram.
Sample piece(const Context& context, const ChainNode& node, Turn across, const Cell& cell) {
    const Turn side = turn_small(cell.half_width);
    const Turn middle = turn_small(0.5F * (cell.from.along + cell.to.along));
    const auto beside = [&](Turn turned) -> Eigen::Vector3f {
        const Eigen::Vector3f ray = direction(context.shape, turned, middle);
        return ray * on_plane(node, ray, !cell.alone, context.sampling.tolerance_m).range_m;
    };
    const Point& low = cell.from.above;
    const Point& high = cell.to.below;
    const Eigen::Vector3f from = cell.from.direction * low.range_m;
    const Eigen::Vector3f to = cell.to.direction * high.range_m;
    Sample sample;
    sample.position = 0.5F * (from + to);
    sample.edge_u = 0.5F * (beside(across + side) - beside(across - side));
    sample.edge_v = 0.5F * (to - from);
    sample.normal = node.normal;
    sample.cosine = 0.5F * (low.cosine + high.cosine);
    sample.cosine_v = 0.5F * (high.cosine - low.cosine);
    sample.area_m2 = 4.0F * sample.edge_u.cross(sample.edge_v).norm();
    sample.material = node.material;
    sample.instance = node.instance;
    return sample;
}

/// Adds the samples of one chain. `split` tells which of a column's cells are seen in strips.
void collect(const Context& context, const Chain& chain, const std::uint8_t* split,
             std::vector<Sample>& items) {
    const int n = context.sampling.chain;
    const float per_cell = static_cast<float>(n) / (chain.along_max - chain.along_min);
    Cell cell{};
    cell.from = border(context, chain, ChainNode::none, chain.first);
    for (int i = chain.first; i != ChainNode::none; i = context.chains.nodes[i].next) {
        const ChainNode& node = context.chains.nodes[i];
        cell.to = border(context, chain, i, node.next);
        if (!node.missed()) {
            const int at = static_cast<int>((node.along - chain.along_min) * per_cell);
            const bool strip = !chain.whole || split[std::clamp(at, 0, n - 1)];
            cell.half_width =
                chain.half_width * (chain.whole && strip ? 1.0F - 2.0F * margin : 1.0F);
            cell.alone = strip || !cell.from.joined || !cell.to.joined;
            items.push_back(piece(context, node, chain.across, cell));
        }
        cell.from = cell.to;
    }
}

}  // namespace

void chain_samples(const View& view, const Sampling& sampling, const Chains& chains,
                   Samples& samples) {
    const Context context{view.shape, sampling, chains};
    samples.items.clear();
    samples.dropped = chains.dropped;
    samples.items.reserve(chains.nodes.size());
    samples.beam_begin.assign(view.beams + 1, 0);
    std::size_t column = 0;
    std::size_t strip = chains.columns;
    for (int j = 0; j < view.beams; ++j) {
        for (; column < chains.columns && chains.chains[column].beam == j; ++column) {
            collect(context, chains.chains[column], chains.split.data() + column * sampling.chain,
                    samples.items);
        }
        for (; strip < chains.chains.size() && chains.chains[strip].beam == j; ++strip) {
            collect(context, chains.chains[strip], nullptr, samples.items);
        }
        samples.beam_begin[j + 1] = static_cast<std::uint32_t>(samples.items.size());
    }
}

}  // namespace sonarsim
