#include "checks/doubled_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <utility>
#include <vector>

namespace sonarsim {

namespace {

using Corners = std::array<std::array<float, 3>, 3>;

/// The corners of a triangle in an order that does not depend on their order in the file.
Corners sorted_corners(const Scene& scene, std::size_t triangle) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3f& at = scene.vertices[scene.triangles[triangle][k]];
        // Adding 0 turns -0 into 0, which is the same place.
        corners[k] = {at.x() + 0.0F, at.y() + 0.0F, at.z() + 0.0F};
    }
    std::ranges::sort(corners);
    return corners;
}

std::uint64_t hash_of(const Corners& corners) {
    std::uint64_t hash = 0;
    for (const auto& corner : corners) {
        for (const float x : corner) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(x)) * 0x9E3779B97F4A7C15U;
            hash ^= hash >> 29;
        }
    }
    return hash;
}

}  // namespace

DoubledTriangles find_doubled(const Scene& scene) {
    DoubledTriangles found;
    if (scene.instances.size() < 2) return found;
    struct Entry {
        std::uint64_t hash;
        std::uint32_t triangle;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries;
    entries.reserve(scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        entries.push_back({hash_of(sorted_corners(scene, t)), t});
    std::ranges::sort(entries);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> pairs;
    std::size_t begin = 0;  // first entry with the same hash
    for (std::size_t k = 1; k < entries.size(); ++k) {
        if (entries[k].hash != entries[begin].hash) begin = k;
        if (begin == k) continue;
        const Corners corners = sorted_corners(scene, entries[k].triangle);
        const auto first = std::find_if(
            entries.begin() + begin, entries.begin() + k,
            [&](const Entry& entry) { return sorted_corners(scene, entry.triangle) == corners; });
        const std::uint32_t one = scene.triangle_instance[first->triangle];
        const std::uint32_t other = scene.triangle_instance[entries[k].triangle];
        if (one == other) continue;
        ++found.count;
        ++pairs[std::minmax(one, other)];
    }
    for (const auto& [pair, count] : pairs) {
        if (count <= found.shared_triangles) continue;
        found.first_instance = pair.first;
        found.second_instance = pair.second;
        found.shared_triangles = count;
    }
    return found;
}

}  // namespace sonarsim
