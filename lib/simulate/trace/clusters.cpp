#include "simulate/trace/clusters.h"

#include <bit>
#include <utility>

#include "core/groups.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;

// Clusters of its tile with which a sample is compared before it starts its own.
constexpr int max_comparisons = 16;

struct Tile {
    std::int32_t range;
    std::int32_t across;
    std::int32_t along;

    bool operator==(const Tile&) const = default;
};

/// Cuts the view into tiles of epsilon bins each way, and finds the tile of a sample.
class Tiling {
  public:
    Tiling(const View& view, int epsilon)
        : fan_(view.shape == ViewShape::fan),
          epsilon_(epsilon),
          per_range_(static_cast<float>(1.0 / (view.bin_m() * epsilon))) {
        // Sides and cones have no narrow beams; their angles are cut into 128 instead.
        const double bin = view.azimuth_rad / (fan_ ? view.beams : 128);
        per_sine_ = static_cast<float>(1.0 / (bin * epsilon));
    }

    Tile of(const Sample& sample, float range_m, int beam) const {
        const float per_m = per_sine_ / range_m;
        return {floor_of(range_m * per_range_),
                fan_ ? beam / epsilon_ : floor_of(sample.position.y() * per_m),
                floor_of(sample.position.z() * per_m)};
    }

  private:
    static std::int32_t floor_of(float x) { return static_cast<std::int32_t>(std::floor(x)); }

    bool fan_;
    int epsilon_;
    float per_range_;
    float per_sine_;
};

/// A cluster that is being filled: its first sample, and the next cluster of its hash bucket.
struct OpenCluster {
    Tile tile;
    Eigen::Vector3f normal;
    std::uint32_t next;
};

std::uint32_t bucket_of(const Tile& tile, std::uint32_t mask) {
    std::uint32_t h = static_cast<std::uint32_t>(tile.range) * 0x9E3779B1U;
    h = (h ^ static_cast<std::uint32_t>(tile.across)) * 0x85EBCA77U;
    h = (h ^ static_cast<std::uint32_t>(tile.along)) * 0xC2B2AE3DU;
    return (h ^ (h >> 16)) & mask;
}

class ClusterTable {
  public:
    ClusterTable(std::size_t samples, float delta_cosine)
        : delta_cosine_(delta_cosine),
          heads_(std::bit_ceil(std::max<std::size_t>(samples, 16)), none) {}

    std::uint32_t cluster_of(const Tile& tile, const Eigen::Vector3f& normal) {
        std::uint32_t& head =
            heads_[bucket_of(tile, static_cast<std::uint32_t>(heads_.size()) - 1U)];
        int left = max_comparisons;
        for (std::uint32_t k = head; k != none && left > 0; k = clusters_[k].next) {
            if (clusters_[k].tile != tile) continue;
            if (clusters_[k].normal.dot(normal) >= delta_cosine_) return k;
            --left;
        }
        clusters_.push_back({tile, normal, head});
        head = static_cast<std::uint32_t>(clusters_.size()) - 1U;
        return head;
    }

    std::size_t size() const { return clusters_.size(); }

  private:
    float delta_cosine_;
    std::vector<std::uint32_t> heads_;
    std::vector<OpenCluster> clusters_;
};

}  // namespace

Clusters cluster_samples(const View& view, const Samples& samples, const ClusterLimits& limits) {
    const auto range_max = static_cast<float>(view.range_max_m);
    Clusters clusters;
    if (limits.epsilon_bins == 0) {
        for (std::uint32_t i = 0; i < samples.in_beams().size(); ++i) {
            const float range = arrival_range(samples.items[i].position);
            if (range > 0.0F && range < range_max) clusters.members.push_back(i);
        }
        clusters.begin.resize(clusters.members.size() + 1);
        for (std::uint32_t i = 0; i < clusters.begin.size(); ++i)
            clusters.begin[i] = i;
        return clusters;
    }
    const Tiling tiling(view, limits.epsilon_bins);
    ClusterTable table(samples.items.size(), limits.delta_cosine);
    std::vector<std::uint32_t> cluster(samples.items.size(), no_group);
    for (int j = 0; j < view.beams; ++j) {
        for (std::uint32_t i = samples.beam_begin[j]; i < samples.beam_begin[j + 1]; ++i) {
            const Sample& sample = samples.items[i];
            const float range = arrival_range(sample.position);
            // A sample out of range needs no trace: its path over a second surface is longer still.
            if (!(range > 0.0F && range < range_max)) continue;
            cluster[i] = table.cluster_of(tiling.of(sample, range, j), sample.normal);
        }
    }
    Groups groups = sort_into_groups(cluster, table.size());
    clusters.members = std::move(groups.items);
    clusters.begin = std::move(groups.begin);
    return clusters;
}

}  // namespace sonarsim
