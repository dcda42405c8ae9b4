#include "visibility/rays/surface_probes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sonarsim {

namespace {

// The most points drawn per probe. Most triangles of a large scene are out of view.
constexpr std::size_t points_per_probe = 4;

/// Points that fill the triangles of a scene evenly: Roberts' R3 sequence in units of 2^-32.
class SurfacePoints {
  public:
    SurfacePoints(const Scene& scene, const Eigen::Vector3f& start)
        : scene_(scene),
          triangle_(std::bit_cast<std::uint32_t>(start.x()) * 0x9E3779B9U),
          u_(std::bit_cast<std::uint32_t>(start.y()) * 0x9E3779B9U),
          v_(std::bit_cast<std::uint32_t>(start.z()) * 0x9E3779B9U) {}

    Eigen::Vector3f next() {
        triangle_ += 0xD1B54A32U;
        u_ += 0xABC98388U;
        v_ += 0x8CB92BA7U;
        constexpr float unit = 0x1p-24F;
        float u = unit * static_cast<float>(u_ >> 8U);
        float v = unit * static_cast<float>(v_ >> 8U);
        if (u + v > 1.0F) {
            u = 1.0F - u;
            v = 1.0F - v;
        }
        const auto& [a, b, c] =
            scene_.triangles[std::uint64_t{triangle_} * scene_.triangles.size() >> 32U];
        const Eigen::Vector3f& corner = scene_.vertices[a];
        return corner + u * (scene_.vertices[b] - corner) + v * (scene_.vertices[c] - corner);
    }

  private:
    const Scene& scene_;
    std::uint32_t triangle_, u_, v_;
};

/// A probed point of the view.
struct SurfaceProbe {
    float range_m;
    std::uint32_t bin;  ///< index into SetDisagreement::occupied
};

/// A bin that shows surface, and the echo of that surface.
struct ProbedBin {
    std::uint32_t bin;
    float echo;
};

/// Draws points until `count` of them are in the view; sets their directions, scene-local.
std::vector<SurfaceProbe> draw_probes(const Scene& scene, const View& view, const LocalPose& pose,
                                      int every, std::size_t count,
                                      std::vector<Eigen::Vector3f>& directions) {
    const BeamLocator field(view);
    const Eigen::Matrix3f R_sensor_local = pose.rotation.transpose();
    const auto range_min_m = static_cast<float>(view.range_min_m);
    const auto range_max_m = static_cast<float>(view.range_max_m);
    const auto per_bin = static_cast<float>(1.0 / view.bin_m());
    SurfacePoints points(scene, pose.position);
    std::vector<SurfaceProbe> probes;
    for (std::size_t k = 0; k < points_per_probe * count && probes.size() < count; ++k) {
        const Eigen::Vector3f to_point = points.next() - pose.position;
        const float range = to_point.norm();
        if (!(range > range_min_m && range < range_max_m)) continue;
        const float beam = field.beam(R_sensor_local * to_point, range);
        if (!(beam >= 0.0F)) continue;
        const int row = static_cast<int>(beam);
        const int bin = static_cast<int>((range - range_min_m) * per_bin);
        if (row % every != 0 || bin >= view.range_bins) continue;
        probes.push_back({range, static_cast<std::uint32_t>(row / every * view.range_bins + bin)});
        directions.emplace_back(to_point / range);
    }
    return probes;
}

}  // namespace

double share_of_dark_bins(const Scene& scene, const Caster& caster, const View& view,
                          const LocalPose& pose, const SetDisagreement& image, std::size_t count) {
    if (scene.triangles.empty()) return 0.0;
    std::vector<Eigen::Vector3f> directions;
    const std::vector<SurfaceProbe> probes =
        draw_probes(scene, view, pose, image.every, count, directions);
    std::vector<std::uint32_t> facets(probes.size());
    caster.cast(pose.position, directions, static_cast<float>(view.range_max_m), facets,
                RaySpread::wide);
    // Surface nearer than a probed point by more than this hides the point.
    const float slack_m = 0.01F * static_cast<float>(view.bin_m());
    std::vector<ProbedBin> seen;
    for (std::size_t k = 0; k < probes.size(); ++k) {
        if (facets[k] == Caster::nothing) continue;
        const Facet facet = caster.facet(facets[k]);
        const float height = std::fabs(facet.normal.dot(pose.position - facet.vertex));
        const float cosine = std::fabs(facet.normal.dot(directions[k]));
        if (!(height >= (probes[k].range_m - slack_m) * cosine)) continue;
        seen.push_back({probes[k].bin, scene.materials[facet.material].reflection * cosine});
    }
    std::ranges::stable_sort(seen, {}, &ProbedBin::bin);
    double all = 0.0;
    double dark = 0.0;
    for (std::size_t k = 0; k < seen.size(); ++k) {
        if (k > 0 && seen[k].bin == seen[k - 1].bin) continue;
        all += static_cast<double>(seen[k].echo);
        if (image.occupied[seen[k].bin] == 0) dark += static_cast<double>(seen[k].echo);
    }
    return all > 0.0 ? dark / all : 0.0;
}

}  // namespace sonarsim
