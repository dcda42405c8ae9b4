#include <algorithm>

#include "core/elementary.h"
#include "core/random.h"
#include "core/units.h"
#include "input/scene/copies.h"
#include "simulate/reference/reference_cast.h"

namespace sonarsim {

namespace {

double half_angle(double radius, double distance) {
    return radius < distance ? arcsin(radius / distance) : pi;
}

/// False only if no point of the ball is in view. Sensor frame.
bool may_be_in_view(const View& view, const Eigen::Vector3d& centre, double radius) {
    const double distance = centre.norm();
    if (distance - radius > view.range_max_m || distance + radius < view.range_min_m) return false;
    const double around = half_angle(radius, distance);
    if (view.shape == ViewShape::cone) {
        const double off_axis = arctan2(std::hypot(centre.y(), centre.z()), centre.x());
        return off_axis - around <= 0.5 * view.azimuth_rad;
    }
    const double ground = std::hypot(centre.x(), centre.y());
    const double elevation = std::fabs(arctan2(centre.z(), ground));
    const double azimuth = std::fabs(arctan2(centre.y(), centre.x()));
    return elevation - around <= 0.5 * view.elevation_rad &&
           azimuth - half_angle(radius, ground) <= 0.5 * view.azimuth_rad;
}

double fraction(double x) {
    return x - std::floor(x);
}

/// A copy of a shared mesh that may be in view, and the number of its first facet.
struct CopyInView {
    std::uint32_t copy;
    std::uint32_t first_facet;
    std::uint32_t triangles;
};

std::vector<CopyInView> copies_in_view(const Scene& scene, const View& view,
                                       const LocalPose& pose) {
    std::vector<CopyInView> found;
    const std::vector<Eigen::AlignedBox3d> boxes = boxes_of_copies(scene);
    auto first = static_cast<std::uint32_t>(scene.triangles.size());
    for (std::uint32_t k = 0; k < scene.copies.size(); ++k) {
        const auto count =
            static_cast<std::uint32_t>(scene.shared_meshes[scene.copies[k].mesh].triangles.size());
        if (count > 0) {
            const Eigen::Vector3d off =
                boxes[k].center() - scene.origin - pose.position.cast<double>();
            const Eigen::Vector3d centre = pose.rotation.cast<double>().transpose() * off;
            if (may_be_in_view(view, centre, 0.5 * boxes[k].diagonal().norm()))
                found.push_back({k, first, count});
        }
        first += count;
    }
    return found;
}

void add_share(const Scene& scene, const View& view, const LocalPose& pose, SurfaceShare share,
               std::vector<SurfaceShare>& shares) {
    std::array<Eigen::Vector3d, 3> corners;
    std::ranges::transform(
        corners_of(scene, share), corners.begin(),
        [&](const Eigen::Vector3f& vertex) -> Eigen::Vector3d {
            return (pose.rotation.transpose() * (vertex - pose.position)).cast<double>();
        });
    const Eigen::Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    double radius = 0.0;
    for (const Eigen::Vector3d& corner : corners)
        radius = std::max(radius, (corner - centre).norm());
    if (!may_be_in_view(view, centre, radius)) return;
    const double area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
    if (!(area > 0.0)) return;
    const double nearest = std::max({view.range_min_m, centre.norm() - radius, view.bin_m()});
    const double length = 2.0 * radius;
    // The extent of a triangle beyond the view counts no bins.
    const double bins = std::min<double>(view.range_bins, length / view.bin_m());
    const double beam_m =
        view.shape == ViewShape::fan ? nearest * view.azimuth_rad / view.beams : nearest;
    const double beams = std::min<double>(view.beams, length / beam_m);
    share.area_m2 = static_cast<float>(area);
    share.share = static_cast<float>(1.0 + bins + beams);
    shares.push_back(share);
}

}  // namespace

std::array<Eigen::Vector3f, 3> corners_of(const Scene& scene, const SurfaceShare& share) {
    if (share.copy != SurfaceShare::no_copy)
        return placed_corners(scene, scene.copies[share.copy], share.triangle);
    const auto& [a, b, c] = scene.triangles[share.triangle];
    return {scene.vertices[a], scene.vertices[b], scene.vertices[c]};
}

std::vector<SurfaceShare> surface_shares(const Scene& scene, const View& view,
                                         const LocalPose& pose) {
    constexpr std::size_t max_of_copies = 4'000'000;
    std::vector<SurfaceShare> shares;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        add_share(scene, view, pose, {t, t, SurfaceShare::no_copy, 0.0F, 0.0F}, shares);
    const std::vector<CopyInView> copies = copies_in_view(scene, view, pose);
    std::size_t in_view = 0;
    for (const CopyInView& copy : copies)
        in_view += copy.triangles;
    const auto step = static_cast<std::uint32_t>(1 + in_view / max_of_copies);
    for (const CopyInView& copy : copies) {
        for (std::uint32_t t = 0; t < copy.triangles; t += step)
            add_share(scene, view, pose, {copy.first_facet + t, t, copy.copy, 0.0F, 0.0F}, shares);
    }
    return shares;
}

Eigen::Vector2d point_of_triangle(std::uint32_t facet, std::uint32_t i, std::uint32_t start) {
    // The additive recurrence of the plastic number, evenly spread in the square; the half of the
    // square beyond the diagonal is rotated onto the other half.
    constexpr double a = 0.7548776662466927;
    constexpr double b = 0.5698402909980532;
    const PhiloxBlock shift = philox({facet, start, 0, 0}, {0x706f696eU, 0x74730000U});
    double u = fraction(unit_float(shift.x0) + a * i);
    double v = fraction(unit_float(shift.x1) + b * i);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {u, v};
}

}  // namespace sonarsim
