#include "visibility/slices/clusters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <utility>

#include "core/groups.h"

namespace sonarsim {

namespace {

/// The 21 low bits of x with two zeros after each bit.
std::uint64_t spread_bits(std::uint64_t x) {
    x &= 0x1fffff;
    x = (x | x << 32U) & 0x1f00000000ffff;
    x = (x | x << 16U) & 0x1f0000ff0000ff;
    x = (x | x << 8U) & 0x100f00f00f00f00f;
    x = (x | x << 4U) & 0x10c30c30c30c30c3;
    x = (x | x << 2U) & 0x1249249249249249;
    return x;
}

Eigen::Vector3f centre_of(const Scene& scene, const std::array<std::uint32_t, 3>& triangle) {
    return (scene.vertices[triangle[0]] + scene.vertices[triangle[1]] +
            scene.vertices[triangle[2]]) /
           3.0F;
}

/// Indices of the triangles along the Morton curve; triangles with equal codes keep the scene's
/// order.
std::vector<std::uint32_t> along_morton_curve(const Scene& scene) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Eigen::Vector3f low = Eigen::Vector3f::Constant(infinity);
    Eigen::Vector3f high = -low;
    for (const auto& triangle : scene.triangles) {
        const Eigen::Vector3f centre = centre_of(scene, triangle);
        low = low.cwiseMin(centre);
        high = high.cwiseMax(centre);
    }
    const float length = (high - low).maxCoeff();
    const float cells = length > 0.0F ? static_cast<float>(0x1fffff) / length : 0.0F;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(scene.triangles.size());
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        const Eigen::Vector3f at = (centre_of(scene, scene.triangles[i]) - low) * cells;
        keys[i] = {spread_bits(static_cast<std::uint64_t>(at.x())) |
                       spread_bits(static_cast<std::uint64_t>(at.y())) << 1U |
                       spread_bits(static_cast<std::uint64_t>(at.z())) << 2U,
                   i};
    }
    std::ranges::sort(keys);
    std::vector<std::uint32_t> order(keys.size());
    std::ranges::transform(keys, order.begin(), [](const auto& key) { return key.second; });
    return order;
}

/// The normal is computed from edges in double: in float, a needle's cross product is mostly
/// cancellation.
SliceFacet facet_of(const Scene& scene, std::uint32_t triangle) {
    const auto& corners = scene.triangles[triangle];
    const Eigen::Vector3d a = scene.vertices[corners[0]].cast<double>();
    const Eigen::Vector3d b = scene.vertices[corners[1]].cast<double>();
    const Eigen::Vector3d c = scene.vertices[corners[2]].cast<double>();
    return {(b - a).cross(c - a).normalized().cast<float>(), scene.triangle_material[triangle],
            scene.triangle_instance[triangle], 0};
}

/// A hash that is equal for equal positions.
std::uint64_t hash_of(const Eigen::Vector3f& p) {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
        const float x = p[k] + 0.0F;  // -0 becomes 0, which equals it
        hash = (hash ^ std::bit_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 32U;
    }
    return hash;
}

/// The first vertex at the same position, for every vertex, by a hash table with linear probing.
std::vector<std::uint32_t> welded(const Scene& scene) {
    const std::size_t slots = std::bit_ceil(2 * scene.vertices.size() + 1);
    std::vector<std::uint32_t> table(slots, ClusterMesh::nothing);
    std::vector<std::uint32_t> first(scene.vertices.size());
    for (std::uint32_t v = 0; v < first.size(); ++v) {
        std::size_t slot = hash_of(scene.vertices[v]) & (slots - 1);
        while (table[slot] != ClusterMesh::nothing &&
               scene.vertices[table[slot]] != scene.vertices[v])
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == ClusterMesh::nothing) table[slot] = v;
        first[v] = table[slot];
    }
    return first;
}

/// The connected components of the triangles, numbered from 0.
class Components {
  public:
    Components(const Scene& scene, const std::vector<std::uint32_t>& vertex)
        : vertex_(vertex), parent_(vertex), number_(vertex.size(), ClusterMesh::nothing) {
        for (const auto& triangle : scene.triangles) {
            join(triangle[0], triangle[1]);
            join(triangle[0], triangle[2]);
        }
    }

    std::uint32_t of(const std::array<std::uint32_t, 3>& triangle) {
        std::uint32_t& number = number_[root(triangle[0])];
        if (number == ClusterMesh::nothing) number = count_++;
        return number;
    }

    std::uint32_t count() const { return count_; }

  private:
    std::uint32_t root(std::uint32_t v) {
        v = vertex_[v];
        while (parent_[v] != v)
            v = parent_[v] = parent_[parent_[v]];
        return v;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

    const std::vector<std::uint32_t>& vertex_;
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint32_t> number_;
    std::uint32_t count_ = 0;
};

/// True if two triangles have one material and one instance.
bool alike(const Scene& scene, std::uint32_t a, std::uint32_t b) {
    return scene.triangle_material[a] == scene.triangle_material[b] &&
           scene.triangle_instance[a] == scene.triangle_instance[b];
}

/// ClusterMesh::beyond, in the order of the scene's triangles.
std::vector<std::array<std::uint32_t, 3>> across_edges(const Scene& scene,
                                                       const std::vector<std::uint32_t>& vertex) {
    struct Edge {
        std::uint32_t end;  ///< the end with the greater number
        std::uint32_t triangle;
        std::uint32_t side;
    };
    const auto ends = [&](std::uint32_t triangle, std::uint32_t side) {
        return std::minmax(vertex[scene.triangles[triangle][side]],
                           vertex[scene.triangles[triangle][(side + 1) % 3]],
                           std::less<std::uint32_t>{});
    };
    // Groups sides by their end with the lesser number, since few sides share one.
    std::vector<std::uint32_t> lesser_end;
    lesser_end.reserve(3 * scene.triangles.size());
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        for (std::uint32_t k = 0; k < 3; ++k)
            lesser_end.push_back(ends(i, k).first);
    }
    const Groups sides = sort_into_groups(lesser_end, vertex.size());
    lesser_end = {};
    constexpr std::uint32_t nothing = ClusterMesh::nothing;
    std::vector<std::array<std::uint32_t, 3>> out(scene.triangles.size(),
                                                  {nothing, nothing, nothing});
    std::vector<Edge> edges;
    for (std::size_t v = 0; v < vertex.size(); ++v) {
        edges.clear();
        for (std::uint32_t n = sides.begin[v]; n < sides.begin[v + 1]; ++n) {
            const std::uint32_t side = sides.items[n];
            edges.push_back({ends(side / 3, side % 3).second, side / 3, side % 3});
        }
        std::ranges::stable_sort(edges, {}, &Edge::end);
        for (std::size_t i = 1; i < edges.size(); ++i) {
            const Edge& a = edges[i - 1];
            const Edge& b = edges[i];
            if (a.end != b.end || !alike(scene, a.triangle, b.triangle)) continue;
            out[a.triangle][a.side] = scene.triangles[b.triangle][(b.side + 2) % 3];
            out[b.triangle][b.side] = scene.triangles[a.triangle][(a.side + 2) % 3];
        }
    }
    return out;
}

/// Appends a cluster of the given triangles.
void add_cluster(const Scene& scene, const std::uint32_t* triangles, std::uint32_t count,
                 Components& components, ClusterMesh& mesh) {
    std::vector<std::uint32_t> used;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto& corners = scene.triangles[triangles[i]];
        used.insert(used.end(), corners.begin(), corners.end());
    }
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());

    TriangleCluster cluster{};
    cluster.first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
    cluster.vertices = static_cast<std::uint32_t>(used.size());
    cluster.first_triangle = static_cast<std::uint32_t>(mesh.corners.size());
    cluster.triangles = count;
    Eigen::Vector3f low = scene.vertices[used[0]];
    Eigen::Vector3f high = low;
    for (const std::uint32_t vertex : used) {
        const Eigen::Vector3f& p = scene.vertices[vertex];
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
        mesh.vertices.push_back(p);
    }
    cluster.centre = 0.5F * (low + high);
    for (const std::uint32_t vertex : used) {
        cluster.radius_m =
            std::max(cluster.radius_m, (scene.vertices[vertex] - cluster.centre).norm());
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        std::array<std::uint8_t, 3> local{};
        for (int k = 0; k < 3; ++k) {
            const auto at = std::ranges::lower_bound(used, scene.triangles[triangles[i]][k]);
            local[k] = static_cast<std::uint8_t>(at - used.begin());
        }
        mesh.corners.push_back(local);
        mesh.facets.push_back(facet_of(scene, triangles[i]));
        mesh.facets.back().component = components.of(scene.triangles[triangles[i]]);
    }
    mesh.clusters.push_back(cluster);
}

}  // namespace

ClusterMesh make_clusters(const Scene& scene) {
    ClusterMesh mesh;
    const std::vector<std::uint32_t> vertex = welded(scene);
    const std::vector<std::uint32_t> order = along_morton_curve(scene);
    mesh.corners.reserve(order.size());
    mesh.facets.reserve(order.size());
    Components components(scene, vertex);
    {
        const std::vector<std::array<std::uint32_t, 3>> beyond = across_edges(scene, vertex);
        mesh.beyond.reserve(order.size());
        for (const std::uint32_t triangle : order)
            mesh.beyond.push_back(beyond[triangle]);
    }
    for (std::size_t first = 0; first < order.size(); first += ClusterMesh::most_triangles) {
        const std::size_t count =
            std::min<std::size_t>(ClusterMesh::most_triangles, order.size() - first);
        add_cluster(scene, order.data() + first, static_cast<std::uint32_t>(count), components,
                    mesh);
    }
    mesh.components = components.count();
    return mesh;
}

}  // namespace sonarsim
