#include "validation/surface_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/random.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// The angle that a ball of radius `radius` at `distance` reaches to either side of its centre.
double half_angle(double radius, double distance) {
    return radius < distance ? arcsin(radius / distance) : pi;
}

/// False only where no point of the ball is in view. Sensor frame.
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

double beam_width_m(const View& view, double range_m) {
    return view.shape == ViewShape::fan ? range_m * view.azimuth_rad / view.beams : range_m;
}

double fraction(double x) {
    return x - std::floor(x);
}

}  // namespace

std::vector<SurfaceShare> surface_shares(const Scene& scene, const View& view,
                                         const LocalPose& pose) {
    std::vector<SurfaceShare> shares;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        std::array<Eigen::Vector3d, 3> corners;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f& vertex = scene.vertices[scene.triangles[t][k]];
            corners[k] = (pose.rotation.transpose() * (vertex - pose.position)).cast<double>();
        }
        const Eigen::Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        double radius = 0.0;
        for (const Eigen::Vector3d& corner : corners)
            radius = std::max(radius, (corner - centre).norm());
        if (!may_be_in_view(view, centre, radius)) continue;
        const double area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
        if (!(area > 0.0)) continue;
        const double nearest = std::max({view.range_min_m, centre.norm() - radius, view.bin_m()});
        const double length = 2.0 * radius;
        // A triangle that reaches beyond the view has no more bins than the view.
        const double bins = std::min<double>(view.range_bins, length / view.bin_m());
        const double beams = std::min<double>(view.beams, length / beam_width_m(view, nearest));
        shares.push_back({t, static_cast<float>(area), static_cast<float>(1.0 + bins + beams)});
    }
    return shares;
}

Eigen::Vector2d point_of_triangle(std::uint32_t triangle, std::uint32_t i, std::uint32_t start) {
    // The additive recurrence of the plastic number, evenly spread in the square; the half of the
    // square beyond the diagonal is turned onto the other.
    constexpr double a = 0.7548776662466927;
    constexpr double b = 0.5698402909980532;
    const PhiloxBlock shift = philox({triangle, start, 0, 0}, {0x706f696eU, 0x74730000U});
    double u = fraction(unit_float(shift.x0) + a * i);
    double v = fraction(unit_float(shift.x1) + b * i);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return {u, v};
}

}  // namespace sonarsim
