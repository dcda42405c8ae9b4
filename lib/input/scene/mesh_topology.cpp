#include "input/scene/mesh_topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "core/groups.h"

namespace sonarsim {

namespace {

/// A hash of an edge: in the opposite direction its negative. Those of a closed part add to 0.
std::uint64_t hash_of_edge(std::uint32_t from, std::uint32_t to) {
    if (from == to) return 0;
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15U;
    std::uint64_t hash = std::uint64_t{std::min(from, to)} << 32U | std::max(from, to);
    hash = (hash ^ hash >> 31U) * odd;
    hash = (hash ^ hash >> 29U) * odd;
    hash ^= hash >> 32U;
    return from < to ? hash : -hash;
}

/// Sums over a part of a mesh.
struct PartSums {
    Eigen::AlignedBox3f box;
    std::uint64_t edges = 0;
    double volume = 0.0;  ///< times 6, m^3
    double area = 0.0;    ///< times 2, m^2

    Solid solid() const {
        constexpr double least = 1e-5;  // a sphere has 0.2
        if (edges != 0 || !(std::fabs(volume) > least * area * std::sqrt(area))) return {};
        return {box, volume > 0.0 ? 1.0F : -1.0F};
    }
};

}  // namespace

Ball ball_around(std::span<const Eigen::Vector3f> vertices,
                 std::span<const TriangleCorners> triangles) {
    if (triangles.empty()) return {};
    Eigen::AlignedBox3f box;
    for (const TriangleCorners& triangle : triangles) {
        for (const std::uint32_t corner : triangle)
            box.extend(vertices[corner]);
    }
    Ball ball{box.center()};
    for (const TriangleCorners& triangle : triangles) {
        for (const std::uint32_t corner : triangle)
            ball.radius_m = std::max(ball.radius_m, (vertices[corner] - ball.centre).norm());
    }
    return ball;
}

std::vector<std::uint32_t> first_at_place(std::span<const Eigen::Vector3f> vertices) {
    // A hash table with linear probing.
    constexpr std::uint32_t none = 0xFFFFFFFFU;
    const std::size_t slots = std::bit_ceil(2 * vertices.size() + 1);
    std::vector<std::uint32_t> table(slots, none);
    std::vector<std::uint32_t> first(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        std::uint64_t hash = 0;
        for (const float x : vertices[v])  // -0 becomes 0, which equals it
            hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0.0F)) * 0x9E3779B97F4A7C15U;
        std::size_t slot = hash >> 32U & (slots - 1);
        while (table[slot] != none && vertices[table[slot]] != vertices[v])
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == none) table[slot] = v;
        first[v] = table[slot];
    }
    return first;
}

std::vector<MeshSide> sides_by_edge(std::span<const TriangleCorners> triangles,
                                    std::size_t vertices) {
    std::vector<std::uint32_t> low;
    low.reserve(3 * triangles.size());
    for (const TriangleCorners& c : triangles)
        low.insert(low.end(), {std::min(c[0], c[1]), std::min(c[1], c[2]), std::min(c[2], c[0])});
    const Groups groups = sort_into_groups(low, vertices);
    std::vector<MeshSide> sides;
    sides.reserve(low.size());
    for (const std::uint32_t item : groups.items) {
        const std::uint32_t side = item % 3;
        const std::uint32_t from = triangles[item / 3][side];
        const std::uint32_t to = triangles[item / 3][(side + 1) % 3];
        sides.push_back({std::min(from, to), std::max(from, to), item / 3, side, from < to});
    }
    // Few sides share a vertex.
    for (std::size_t v = 0; v < vertices; ++v) {
        std::ranges::sort(sides.begin() + groups.begin[v], sides.begin() + groups.begin[v + 1], {},
                          [](const MeshSide& s) { return std::tuple(s.high, s.triangle, s.side); });
    }
    return sides;
}

Solids find_solids(std::span<const Eigen::Vector3f> vertices,
                   std::span<const TriangleCorners> triangles) {
    const std::vector<std::uint32_t> first = first_at_place(vertices);
    JoinedSets parts(vertices.size());
    for (const TriangleCorners& c : triangles) {
        parts.join(first[c[0]], first[c[1]]);
        parts.join(first[c[0]], first[c[2]]);
    }
    std::vector<std::uint32_t> number(vertices.size());  // of a part's vertex, from 1
    std::vector<PartSums> sums(1);
    Solids out;
    for (const TriangleCorners& c : triangles) {
        const std::uint32_t part = parts.of(first[c[0]]);
        if (number[part] == 0) {
            number[part] = static_cast<std::uint32_t>(sums.size());
            sums.emplace_back();
        }
        out.of_triangles.push_back(number[part]);
        PartSums& sum = sums[number[part]];
        const Eigen::Vector3d cross = cross_of(vertices, c);
        sum.volume += cross.dot((vertices[c[0]] - vertices[part]).cast<double>());
        sum.area += cross.norm();
        for (std::size_t k = 0; k < 3; ++k) {
            sum.box.extend(vertices[c[k]]);
            sum.edges += hash_of_edge(first[c[k]], first[c[(k + 1) % 3]]);
        }
    }
    for (std::size_t k = 1; k < sums.size(); ++k)
        out.items.push_back(sums[k].solid());
    return out;
}

}  // namespace sonarsim
