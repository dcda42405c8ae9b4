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

/// In an order that does not depend on the one in which the file has them.
Corners sorted_corners(const Scene& scene, std::size_t triangle) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector3f& at = scene.vertices[scene.triangles[triangle][k]];
        // 0 is added since -0 is the same place.
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

/// Triangles by their corners, those that were met first. Open addressing: a table of pointers
/// would take most of the time.
class FirstTriangles {
  public:
    explicit FirstTriangles(const Scene& scene)
        : scene_(scene), slots_(std::bit_ceil(2 * scene.triangles.size() + 1)) {}

    /// The triangle with these corners that was met before this one, or this one.
    std::uint32_t first_like(std::uint32_t triangle) {
        const Corners corners = sorted_corners(scene_, triangle);
        const std::uint64_t hash = hash_of(corners);
        const auto mark = static_cast<std::uint32_t>(hash);
        const std::size_t mask = slots_.size() - 1;
        for (std::size_t at = (hash >> 32) & mask;; at = (at + 1) & mask) {
            Slot& slot = slots_[at];
            if (slot.next == 0) {
                slot = {triangle + 1, mark};
                return triangle;
            }
            if (slot.mark == mark && sorted_corners(scene_, slot.next - 1) == corners)
                return slot.next - 1;
        }
    }

  private:
    struct Slot {
        std::uint32_t next = 0;  ///< 1 + a triangle; 0: free
        std::uint32_t mark = 0;  ///< of its hash
    };

    const Scene& scene_;
    std::vector<Slot> slots_;
};

}  // namespace

DoubledTriangles find_doubled(const Scene& scene) {
    DoubledTriangles found;
    if (scene.instances.size() < 2) return found;
    FirstTriangles seen(scene);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> pairs;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const std::uint32_t one = scene.triangle_instance[seen.first_like(t)];
        const std::uint32_t other = scene.triangle_instance[t];
        if (one == other) continue;
        ++found.count;
        ++pairs[std::minmax(one, other)];
    }
    for (const auto& [pair, count] : pairs) {
        if (count <= found.between_them) continue;
        found.one = pair.first;
        found.other = pair.second;
        found.between_them = count;
    }
    return found;
}

}  // namespace sonarsim
