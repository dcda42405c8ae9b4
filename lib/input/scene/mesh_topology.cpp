#include "input/scene/mesh_topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "core/groups.h"

namespace sonarsim {

namespace {

/// A hash of an edge: in the opposite direction its negative. A closed part has the sum 0.
std::uint64_t hash_of_edge(std::uint32_t from, std::uint32_t to) {
    if (from == to) return 0;
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15U;
    std::uint64_t hash = std::uint64_t{std::min(from, to)} << 32U | std::max(from, to);
    hash = (hash ^ hash >> 31U) * odd;
    hash = (hash ^ hash >> 29U) * odd;
    hash ^= hash >> 32U;
    return from < to ? hash : -hash;
}

/// A part of a mesh.
struct MeshPart {
    std::vector<TriangleCorners> triangles;
    Eigen::AlignedBox3f box;
    std::uint64_t edges = 0;
    double volume = 0.0;  ///< times 6, m^3
    double area = 0.0;    ///< times 2, m^2
};

/// Exits less entries of a line along z that begins in triangle `own` of the part.
int times_left(std::span<const std::array<Eigen::Vector3d, 3>> part, std::size_t own,
               const Eigen::Vector3d& from) {
    int sum = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const auto side = [&](int k) {
            const Eigen::Vector3d a = part[i][k] - from;
            const Eigen::Vector3d b = part[i][(k + 1) % 3] - from;
            return a.x() * b.y() - a.y() * b.x();
        };
        const double w0 = side(1);
        const double w1 = side(2);
        if (!(w0 < 0.0 ? w1 < 0.0 : w0 > 0.0 && w1 > 0.0)) continue;  // most
        const double w2 = side(0);
        if (!(w0 < 0.0 ? w2 < 0.0 : w2 > 0.0) || i == own) continue;
        const double z = w0 * part[i][0].z() + w1 * part[i][1].z() + w2 * part[i][2].z();
        const double turns = w0 + w1 + w2;
        if (z / turns > from.z()) sum += turns > 0.0 ? 1 : -1;
    }
    return sum;
}

/// True unless one of many points of a closed part has a winding number beside it other than 0
/// outside and 1 within: the part crosses itself, or some of it is inside out.
bool is_plain(std::span<const Eigen::Vector3f> vertices, const MeshPart& part, double outward) {
    constexpr int points = 64;  // finds a twentieth of the surface in 96 of 100 cases
    // A rotation, so that few models have a face along its axes.
    const Eigen::Matrix3d axes = (Eigen::Matrix3d() << 2, 3, 6, 3, -6, 2, 6, 2, -3).finished() / 7;
    std::vector<std::array<Eigen::Vector3d, 3>> placed;
    placed.reserve(part.triangles.size());
    for (const TriangleCorners& c : part.triangles) {
        const auto at = [&](int k) -> Eigen::Vector3d {
            return axes * vertices[c[k]].cast<double>();
        };
        placed.push_back({at(0), at(1), at(2)});
    }
    double area = 0.0;
    int k = 0;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const auto& [a, b, c] = placed[i];
        const Eigen::Vector3d cross = (b - a).cross(c - a);
        for (area += cross.norm(); k < points && area > (k + 0.5) / points * part.area; ++k) {
            const double u = 0.1 + 0.5 * (0.618 * k - std::floor(0.618 * k));
            const Eigen::Vector3d point = a + u * (b - a) + 0.6 * (1.0 - u) * (c - a);
            const int expected = outward * cross.z() < 0.0 ? 1 : 0;
            if (outward * times_left(placed, i, point) != expected) return false;
        }
    }
    return true;
}

Solid solid_of(std::span<const Eigen::Vector3f> vertices, const MeshPart& part) {
    constexpr double least = 1e-5;  // a sphere has 0.2
    if (part.edges != 0 || !(std::fabs(part.volume) > least * part.area * std::sqrt(part.area)))
        return {};
    const float outward = part.volume > 0.0 ? 1.0F : -1.0F;
    return is_plain(vertices, part, outward) ? Solid{part.box, outward} : Solid{};
}

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
    std::vector<std::uint32_t> number(vertices.size());  // its part, from 1
    std::vector<MeshPart> sums(1);
    Solids out;
    for (const TriangleCorners& c : triangles) {
        const std::uint32_t root = parts.of(first[c[0]]);
        if (number[root] == 0) {
            number[root] = static_cast<std::uint32_t>(sums.size());
            sums.emplace_back();
        }
        out.of_triangles.push_back(number[root]);
        MeshPart& part = sums[number[root]];
        part.triangles.push_back(c);
        const Eigen::Vector3d cross = cross_of(vertices, c);
        part.volume += cross.dot((vertices[c[0]] - vertices[root]).cast<double>());
        part.area += cross.norm();
        for (std::size_t k = 0; k < 3; ++k) {
            part.box.extend(vertices[c[k]]);
            part.edges += hash_of_edge(first[c[k]], first[c[(k + 1) % 3]]);
        }
    }
    std::vector<std::uint32_t> item(1);
    for (std::size_t k = 1; k < sums.size(); ++k) {
        const Solid solid = solid_of(vertices, sums[k]);
        item.push_back(solid.outward == 0.0F ? 0 : static_cast<std::uint32_t>(out.items.size()));
        if (item.back() != 0) out.items.push_back(solid);
    }
    for (std::uint32_t& index : out.of_triangles)
        index = item[index];
    return out;
}

}  // namespace sonarsim
