#include "simulate/calibrated/specular_echoes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/calibrated/levels.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

/// The ends of a block of paths: the pieces, or their images.
struct Ends {
    PatchBlock places;
    PointEchoes echoes;                  ///< ranges of the places; use_block() fills the rest
    PatchBlock::Array<float> sent = {};  ///< share of the power that is sent towards them
};

/// A block of pieces that are small enough to be points.
struct PiecesOfPaths {
    int count = 0;
    Ends points, images;
    PatchBlock::Array<float> power{}, row{};
    PatchBlock::Array<std::uint32_t> path{};
};

using UseBlock = std::function<void(const SpecularBlock&)>;

void put_place(Ends& ends, int k, const SpecularPath::Place& place, float s, float t) {
    const Eigen::Vector3f p = place.at + s * place.u + t * place.v;
    ends.places.x[k] = p.x();
    ends.places.y[k] = p.y();
    ends.places.z[k] = p.z();
    ends.echoes.range_m[k] = arrival_range(p);
}

/// Finds the power that is transmitted towards the ends.
void direct_ends(Ends& ends, int count, const SineTable& pattern) {
    ends.places.count = count;
    ends.echoes.count = count;
    ends.echoes.power.fill(1.0F);
    weigh_by_elevation(pattern, ends.places, count, ends.echoes);
    ends.sent = ends.echoes.power;
}

/// The echoes that go out to some ends and return from the others.
void use_reciprocal_path(const PiecesOfPaths& block, const Ends& out, Ends& back,
                         const UseBlock& use) {
    for (int k = 0; k < block.count; ++k) {
        back.echoes.power[k] = block.power[k] * out.sent[k];
        back.echoes.row[k] = block.row[k];
    }
    use({.out = {out.places, out.echoes},
         .places = back.places,
         .echoes = back.echoes,
         .path = std::span(block.path).first(block.count)});
}

std::uint64_t use_block(const SonarEquation& equation, PiecesOfPaths& block, const UseBlock& use) {
    direct_ends(block.points, block.count, equation.elevation);
    direct_ends(block.images, block.count, equation.elevation);
    std::uint64_t outside = 0;
    const auto rows = static_cast<float>(equation.rows);
    for (int k = 0; k < block.count; ++k) {
        const float r = block.points.echoes.range_m[k];
        const float s = block.images.echoes.range_m[k];
        const float range = arrival_range(r, s);
        const float row = (range - equation.range_min_m) / equation.bin_m - 0.5F;
        const bool inside = row > -0.5F && row < rows - 0.5F;
        const float faded =
            exp_neg(std::fma(equation.loss_per_m, range, -equation.ln_headroom), min_loss);
        const float lost = std::min(faded / (r * r * s * s), std::numeric_limits<float>::max());
        block.power[k] = inside ? std::min(block.power[k] * lost, max_echo) : 0.0F;
        block.row[k] = inside ? row : 0.0F;
        outside += inside ? 0 : 2;
    }
    use_reciprocal_path(block, block.images, block.points, use);
    use_reciprocal_path(block, block.points, block.images, use);
    block.count = 0;
    return outside;
}

/// The number of pieces of an edge, so that each is a point both at its place and at its image.
int pieces_of_both(const SpecularPath& piece, const Eigen::Vector3f SpecularPath::Place::*edge,
                   const PointLimits& limits) {
    int most = 1;
    for (const SpecularPath::Place* place : {&piece.point, &piece.image_source}) {
        const Arrival arrival = arrival_of(place->at);
        most = std::max(most, patches_along(extents_of(place->*edge, arrival.direction),
                                            arrival.range_m, limits));
    }
    return most;
}

}  // namespace

std::uint64_t find_specular_echoes(std::span<const SpecularPath> paths,
                                   std::span<const Backscatter> materials,
                                   const SonarEquation& equation, const PointLimits& limits,
                                   const UseBlock& use) {
    PiecesOfPaths block;
    std::uint64_t outside = 0;
    for (std::uint32_t number = 0; number < paths.size(); ++number) {
        const SpecularPath& path = paths[number];
        const int rows = pieces_of_both(path, &SpecularPath::Place::u, limits);
        const int columns = pieces_of_both(path, &SpecularPath::Place::v, limits);
        const float power = materials[path.material].between(path.sine_of_point, path.sine_of_image,
                                                             path.sine_between) *
                            path.reflection * path.area_m2 / static_cast<float>(rows * columns);
        for_each_middle(rows, columns, [&](float s, float t) {
            put_place(block.points, block.count, path.point, s, t);
            put_place(block.images, block.count, path.image_source, s, t);
            block.path[block.count] = number;
            block.power[block.count] = power;
            if (++block.count == PatchBlock::most) outside += use_block(equation, block, use);
        });
    }
    return outside + use_block(equation, block, use);
}

}  // namespace sonarsim
