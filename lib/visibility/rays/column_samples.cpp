#include "visibility/rays/column_samples.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace sonarsim {

namespace {

// A node that stands for less than this share of a step has seen its plane along the chain only.
constexpr float sliver = 0.1F;

/// Where two cells of a chain meet, and how far away the surface is on either side.
struct Border {
    Eigen::Vector3f direction;
    float along;
    float below_m;
    float above_m;
    bool joined;
};

/// The two sides of a chain, as angles across.
struct Sides {
    Turn low;
    Turn high;
};

/// The part of a chain that a node stands for.
struct Cell {
    Border from;
    Border to;
    bool alone;  ///< the surface may end beside the chain
};

struct Context {
    ViewShape shape;
    const Sampling& sampling;
    const Chains& chains;
};

/// Where a direction meets the node's plane, no farther than `most_m` from `about_m`: a plane seen
/// at grazing incidence may run far out over the edge of what was seen of it.
float range_on_plane(const ChainNode& node, const Eigen::Vector3f& ray, float about_m,
                     float most_m) {
    const float cosine = -node.normal.dot(ray);
    const float farthest = about_m + most_m;
    return cosine * farthest > node.height_m ? std::max(node.height_m / cosine, about_m - most_m)
                                             : farthest;
}

/// The border between two neighbours, either of which may be missing at a chain's end.
Border border(const Context& context, const Chain& chain, int below, int above) {
    const ChainNode* const a = below == ChainNode::none ? nullptr : &context.chains.nodes[below];
    const ChainNode* const b = above == ChainNode::none ? nullptr : &context.chains.nodes[above];
    Border out{};
    out.along = !a   ? chain.along_min
                : !b ? chain.along_max
                     : a->along + a->border * (b->along - a->along);
    out.direction = direction(context.shape, chain.across, turn_small(out.along));
    // A column ends with the view, where the surface most likely goes on; a margin of one ends
    // where its neighbours begin to agree.
    out.joined = a && b ? a->joined : chain.whole;
    const bool between_two = a && b && !a->missed() && !b->missed();
    const auto seen = [&](const ChainNode* node) {
        if (!node || node->missed()) return 0.0F;
        const float range = node->range_m;
        float most = context.sampling.tolerance_m;
        if (out.joined) most = between_two ? a->range_m + b->range_m : range;
        return range_on_plane(*node, out.direction, range, most);
    };
    out.below_m = seen(a);
    out.above_m = seen(b);
    return out;
}

/// The surface in a node's cell, as a parallelogram.
Sample piece(const Context& context, const ChainNode& node, const Sides& sides, const Cell& cell) {
    const Turn middle = turn_small(0.5F * (cell.from.along + cell.to.along));
    const float about = 0.5F * (cell.from.above_m + cell.to.below_m);
    const float most = cell.alone ? context.sampling.tolerance_m : about;
    const auto beside = [&](Turn turned) -> Eigen::Vector3f {
        const Eigen::Vector3f ray = direction(context.shape, turned, middle);
        return ray * range_on_plane(node, ray, about, most);
    };
    // A range that is held back leaves the plane, and multipath would start from there.
    const auto onto_plane = [&](const Eigen::Vector3f& p) -> Eigen::Vector3f {
        return p - (node.normal.dot(p) + node.height_m) * node.normal;
    };
    const Eigen::Vector3f from = onto_plane(cell.from.direction * cell.from.above_m);
    const Eigen::Vector3f to = onto_plane(cell.to.direction * cell.to.below_m);
    Sample sample;
    sample.position = 0.5F * (from + to);
    sample.edge_u = 0.5F * (beside(sides.high) - beside(sides.low));
    sample.edge_v = 0.5F * (to - from);
    sample.normal = node.normal;
    sample.height_m = node.height_m;
    sample.area_m2 = 4.0F * sample.edge_u.cross(sample.edge_v).norm();
    sample.material = node.material;
    sample.instance = node.instance;
    return sample;
}

// A parallelogram is as wide at its far end as at its near end, which the surface is not.
constexpr float longest = 2.0F;  // far range over near range

bool too_long(float from_m, float to_m) {
    return to_m > longest * from_m || from_m > longest * to_m;
}

/// Cuts a cell wherever its range doubles and adds all pieces but the last, which is left over.
/// Only at grazing incidence there are any.
void cut_off(const Context& context, const Chain& chain, const ChainNode& node, const Sides& sides,
             Cell& cell, std::vector<Sample>& items) {
    const Border end = cell.to;
    const float to_m = end.below_m;
    while (too_long(cell.from.above_m, to_m)) {
        const float from_m = cell.from.above_m;
        const float next_m = to_m > from_m ? longest * from_m : from_m / longest;
        // Cosines on a plane, and so the inverse ranges, are linear in a small angle.
        const float share = (1.0F / from_m - 1.0F / next_m) / (1.0F / from_m - 1.0F / to_m);
        cell.to.along = cell.from.along + share * (end.along - cell.from.along);
        cell.to.direction = direction(context.shape, chain.across, turn_small(cell.to.along));
        cell.to.below_m = cell.to.above_m = next_m;
        items.push_back(piece(context, node, sides, cell));
        cell.from = cell.to;
    }
    cell.to = end;
}

/// Adds the samples of one chain. `split` tells which of a column's cells are seen in strips.
void collect(const Context& context, const Chain& chain, const std::uint8_t* split,
             std::vector<Sample>& items) {
    const int n = context.sampling.chain;
    const float first = chain.along_min + context.sampling.inset * chain.step;
    const auto sides_at = [&](float half_width) -> Sides {
        const Turn side = turn_small(half_width);
        return {chain.across - side, chain.across + side};
    };
    const Sides full = sides_at(chain.half_width);
    const Sides narrow = sides_at(chain.half_width * (1.0F - 2.0F * margin));
    Cell cell{};
    cell.from = border(context, chain, ChainNode::none, chain.first);
    for (int i = chain.first; i != ChainNode::none; i = context.chains.nodes[i].next) {
        const ChainNode& node = context.chains.nodes[i];
        cell.to = border(context, chain, i, node.next);
        if (!node.missed()) {
            const int at = static_cast<int>((node.along - first) / chain.step + 0.5F);
            const bool strip = !chain.whole || split[std::clamp(at, 0, n - 1)];
            const Sides& sides = chain.whole && strip ? narrow : full;
            cell.alone = strip || !cell.from.joined || !cell.to.joined ||
                         cell.to.along - cell.from.along < sliver * chain.step;
            if (too_long(cell.from.above_m, cell.to.below_m)) {
                cut_off(context, chain, node, sides, cell, items);
            }
            items.push_back(piece(context, node, sides, cell));
        }
        cell.from = cell.to;
    }
}

}  // namespace

Samples chain_samples(const View& view, const Sampling& sampling, const Chains& chains) {
    const Context context{view.shape, sampling, chains};
    Samples samples;
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
    return samples;
}

}  // namespace sonarsim
