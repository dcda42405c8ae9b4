#include "input/scene/mesh_topology.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "core/groups.h"

namespace sonarsim {

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

}  // namespace sonarsim
