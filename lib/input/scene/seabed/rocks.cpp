#include <algorithm>
#include <map>
#include <utility>

#include "core/elementary.h"
#include "core/units.h"
#include "input/scene/seabed/relief.h"
#include "input/scene/seabed/seabed.h"

namespace sonarsim {

namespace {

// The shapes of rocks, here and in cuts_of(), are chosen to look like boulders, without a source.
constexpr std::uint32_t shape_count = 12;  ///< different rocks
constexpr std::uint32_t levels = 3;        ///< levels of detail of each

Surface icosahedron() {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    Surface out;
    const double corners[][3] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                 {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                 {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    for (const auto& [x, y, z] : corners)
        out.vertices.push_back(Eigen::Vector3d(x, y, z) / std::sqrt(1.0 + g * g));
    out.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    return out;
}

/// A finer ball: each triangle becomes four.
Surface refined(const Surface& ball) {
    Surface out;
    out.vertices = ball.vertices;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [entry, is_new] = middles.emplace(std::minmax(a, b), out.vertices.size());
        if (is_new) {
            const Eigen::Vector3d sum = out.vertices[a] + out.vertices[b];
            out.vertices.push_back(sum / std::sqrt(sum.squaredNorm()));
        }
        return entry->second;
    };
    for (const auto& [a, b, c] : ball.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        for (const auto& part : std::array<std::array<std::uint32_t, 3>, 4>{
                 {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}})
            out.triangles.push_back(part);
    }
    return out;
}

/// A plane that cuts a piece off the unit ball.
struct Cut {
    Eigen::Vector3d normal;
    double distance;
};

std::vector<Cut> cuts_of(std::uint32_t shape, std::uint64_t seed) {
    constexpr std::uint32_t planes = 14;
    const PhiloxKey key = bed_key(seed, BedDraw::rock_shapes, shape);
    std::vector<Cut> out;
    for (std::uint32_t n = 0; n < planes; ++n) {
        const PhiloxBlock block = philox({n, 0, 0, 0}, key);
        const PhiloxBlock other = philox({n, 1, 0, 0}, key);
        const double z = 2.0 * unit_double(block.x0, block.x1) - 1.0;
        const SinCos turn = sincos(2.0 * pi * unit_double(block.x2, block.x3));
        const double across = std::sqrt(1.0 - z * z);
        // Cuts are deepest at top and bottom, since rocks come to rest on flat sides.
        const double inner = 0.45 + 0.25 * across;
        out.push_back({{across * turn.cos, across * turn.sin, z},
                       inner + 0.3 * unit_double(other.x0, other.x1)});
    }
    return out;
}

Surface cut_rock(const Surface& ball, const std::vector<Cut>& cuts) {
    Surface out = ball;
    double farthest = 0.0;
    for (Eigen::Vector3d& vertex : out.vertices) {
        double radius = 1.0;
        for (const Cut& cut : cuts) {
            const double along = vertex.dot(cut.normal);
            if (along > cut.distance) radius = std::min(radius, cut.distance / along);
        }
        vertex *= radius;
        farthest = std::max(farthest, std::sqrt(vertex.squaredNorm()));
    }
    for (Eigen::Vector3d& vertex : out.vertices)
        vertex *= 0.5 / farthest;
    return out;
}

/// A point of a Poisson process, and the counter of its further draws.
struct BedPoint {
    Eigen::Vector2d at_m;
    std::uint32_t tile_x = 0;
    std::uint32_t tile_y = 0;
    std::uint32_t number = 0;  ///< within its tile

    /// A uniform number in [0, 1); each `which` from 1 on gives an independent one.
    double draw(std::uint32_t which, PhiloxKey key) const {
        const PhiloxBlock block = philox({tile_x, tile_y, number, which}, key);
        return unit_double(block.x0, block.x1);
    }
};

constexpr double points_per_tile = 8.0;

/// The number of points of a tile, by inversion of Poisson's distribution.
std::uint32_t count_of_tile(std::uint32_t tile_x, std::uint32_t tile_y, PhiloxKey key) {
    constexpr std::uint32_t counter = 0xFFFFFFFFU;  // points are counted from 0
    const double u = BedPoint{{}, tile_x, tile_y, counter}.draw(0, key);
    double probability = exponential(-points_per_tile);
    double sum = probability;
    std::uint32_t count = 0;
    constexpr std::uint32_t never_reached = 100;  // its probability is 1e-70
    while (u >= sum && count < never_reached) {
        ++count;
        probability *= points_per_tile / count;
        sum += probability;
    }
    return count;
}

/// The points of a Poisson process in an area. The size of the tiles depends only on the density.
std::vector<BedPoint> poisson_points(const Eigen::AlignedBox2d& area, double density_per_m2,
                                     PhiloxKey key) {
    std::vector<BedPoint> out;
    if (density_per_m2 <= 0.0) return out;
    const double tile_m = std::sqrt(points_per_tile / density_per_m2);
    const auto tile_of = [&](double x) {
        return static_cast<std::int64_t>(std::floor(x / tile_m));
    };
    for (std::int64_t j = tile_of(area.min().y()); j <= tile_of(area.max().y()); ++j) {
        for (std::int64_t i = tile_of(area.min().x()); i <= tile_of(area.max().x()); ++i) {
            const auto tile_x = static_cast<std::uint32_t>(i);
            const auto tile_y = static_cast<std::uint32_t>(j);
            const std::uint32_t count = count_of_tile(tile_x, tile_y, key);
            for (std::uint32_t n = 0; n < count; ++n) {
                const PhiloxBlock block = philox({tile_x, tile_y, n, 0}, key);
                const Eigen::Vector2d in_tile(unit_double(block.x0, block.x1),
                                              unit_double(block.x2, block.x3));
                const Eigen::Vector2d at_m = (Eigen::Vector2d(i, j) + in_tile) * tile_m;
                const bool is_inside = (at_m.array() >= area.min().array()).all() &&
                                       (at_m.array() < area.max().array()).all();
                if (is_inside) out.push_back({at_m, tile_x, tile_y, n});
            }
        }
    }
    return out;
}

/// The diameter that a share u of the rocks is smaller than.
double diameter_at(double u, const BedRockConfig& rocks) {
    const auto [min_m, max_m] = rocks.diameter_m;
    if (min_m == max_m) return min_m;
    // N(>D) = D^-q between the limits: D^-q is uniform.
    const double q = rocks.exponent;
    const double share = 1.0 - u * (1.0 - power(min_m / max_m, q));
    return std::clamp(min_m * power(share, -1.0 / q), min_m, max_m);
}

}  // namespace

std::vector<Surface> rock_shapes(std::uint64_t seed) {
    std::vector<Surface> out;
    const Surface ball = icosahedron();
    const Surface finer = refined(ball);
    const Surface finest = refined(finer);
    for (std::uint32_t shape = 0; shape < shape_count; ++shape) {
        const std::vector<Cut> cuts = cuts_of(shape, seed);
        for (const Surface* one : {&ball, &finer, &finest})
            out.push_back(cut_rock(*one, cuts));
    }
    return out;
}

std::vector<Rock> rocks_in(const Eigen::AlignedBox2d& area, const BedRockConfig& rocks,
                           double cell_m, std::uint64_t seed) {
    const PhiloxKey key = bed_key(seed, BedDraw::rocks);
    std::vector<Rock> out;
    for (const BedPoint& point : poisson_points(area, rocks.density_per_m2, key)) {
        Rock& rock = out.emplace_back();
        rock.diameter_m = diameter_at(point.draw(1, key), rocks);
        rock.buried = rocks.buried[0] + (rocks.buried[1] - rocks.buried[0]) * point.draw(2, key);
        const double cells = rock.diameter_m / cell_m;
        const std::uint32_t level = (cells > 3.0 ? 1U : 0U) + (cells > 12.0 ? 1U : 0U);
        rock.shape = levels * static_cast<std::uint32_t>(point.draw(3, key) * shape_count) + level;
        const SinCos turn = sincos(2.0 * pi * point.draw(4, key));
        rock.T_world_shape = Eigen::Affine3d::Identity();
        rock.T_world_shape.linear() << turn.cos, -turn.sin, 0.0, turn.sin, turn.cos, 0.0, 0.0, 0.0,
            1.0;
        rock.T_world_shape.linear() *= rock.diameter_m;
        rock.T_world_shape.translation() << point.at_m, 0.0;
    }
    return out;
}

}  // namespace sonarsim
