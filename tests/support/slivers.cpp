#include "support/slivers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "visibility/caster.h"

namespace sonarsim::test {

namespace {

using Eigen::Vector3d;
using Corners3 = std::array<Vector3d, 3>;

// Parts of triangles that are looked at for a triangle and a bin, and their least size in bins.
constexpr int most_parts = 30'000;
constexpr double least_size = 1e-5;
constexpr std::size_t most_points = 256;

/// The bin [range_bin, beam] of a view, as intervals.
struct BinVolume {
    const View& view;
    int beam;
    double range_low_m, range_high_m;

    /// 1: the ball lies inside; -1: outside; 0: neither is sure.
    int holds(const Vector3d& at, double radius) const {
        const double range = at.norm();
        if (range - radius > range_high_m || range + radius < range_low_m) return -1;
        if (range < 2.0 * radius) return 0;
        const double angle = std::asin(radius / range);
        bool inside = range - radius >= range_low_m && range + radius < range_high_m;
        const auto within = [&](double x, double low, double high, double most) -> bool {
            inside = inside && x - most >= low && x + most < high;
            return x + most >= low && x - most < high;
        };
        const double half = 0.5 * view.azimuth_rad;
        if (view.shape == ViewShape::cone) {
            const double off_axis = std::atan2(std::hypot(at.y(), at.z()), at.x());
            return within(off_axis, -1.0, half, angle) ? (inside ? 1 : 0) : -1;
        }
        const double elevation = std::asin(at.z() / range);
        const double steepest = std::fabs(elevation) + angle;
        if (steepest > 1.5) return 0;
        const double width = view.azimuth_rad / view.beams;
        const double azimuth = std::atan2(at.y(), at.x());
        const double low = -half + beam * width;
        const bool meets =
            within(elevation, -0.5 * view.elevation_rad, 0.5 * view.elevation_rad, angle) &&
            within(azimuth, low, low + width, angle / std::cos(steepest));
        return meets ? (inside ? 1 : 0) : -1;
    }
};

/// A part of a triangle in a bin.
struct PartInBin {
    Vector3d at;
    double area;
};

/// The parts of a triangle in a bin, by halving its sides.
void find_parts(const Corners3& triangle, const BinVolume& bin, std::vector<PartInBin>& out) {
    const double least = least_size * bin.view.bin_m();
    std::vector<Corners3> left{triangle};
    for (int looked = 0; !left.empty() && looked < most_parts && out.size() < most_points;
         ++looked) {
        const auto [a, b, c] = left.back();
        left.pop_back();
        const Vector3d middle = (a + b + c) / 3.0;
        const double radius =
            std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
        const int holds = bin.holds(middle, radius);
        if (holds < 0) continue;
        if (holds > 0 || (radius < least && bin.holds(middle, 0.0) > 0)) {
            out.push_back({middle, 0.5 * (b - a).cross(c - a).norm()});
        } else if (radius >= least) {
            const Vector3d ab = 0.5 * (a + b);
            const Vector3d bc = 0.5 * (b + c);
            const Vector3d ca = 0.5 * (c + a);
            left.insert(left.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
    }
}

/// The mean echo of the visible parts of all triangles in a bin; 0 if there are none.
double echo_in(const Scene& scene, const Caster& caster, const BinVolume& bin) {
    double area = 0.0;
    double echo = 0.0;
    std::vector<PartInBin> parts;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        Corners3 corners;
        for (int k = 0; k < 3; ++k)
            corners[k] = scene.vertices[scene.triangles[t][k]].cast<double>();
        const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        parts.clear();
        find_parts(corners, bin, parts);
        for (const PartInBin& part : parts) {
            const double range = part.at.norm();
            const std::array direction{Eigen::Vector3f((part.at / range).cast<float>())};
            std::array<std::uint32_t, 1> met{};
            caster.cast(Eigen::Vector3f::Zero(), direction, static_cast<float>(2.0 * range), met);
            if (met[0] == Caster::nothing) continue;
            const Facet facet = caster.facet(met[0]);
            const double along = static_cast<double>(facet.normal.dot(direction[0]));
            const double met_at = static_cast<double>(facet.normal.dot(facet.vertex)) / along;
            if (met_at < range * (1.0 - 1e-5)) continue;
            const double cosine = std::fabs(normal.normalized().dot(part.at)) / range;
            area += part.area;
            echo += part.area * cosine *
                    static_cast<double>(scene.materials[scene.triangle_material[t]].reflection);
        }
    }
    return area > 0.0 ? echo / area : 0.0;
}

}  // namespace

void add_slivers(const Scene& scene, const View& view, const std::vector<float>& image,
                 Reference& reference) {
    const Caster caster(scene);
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (!(image[i] > 0.0F) || reference.intensity[i] > 0.0F) continue;
        const auto range_bin = static_cast<double>(i / static_cast<std::size_t>(view.beams));
        const int beam = static_cast<int>(i % static_cast<std::size_t>(view.beams));
        const double low = view.range_min_m + range_bin * view.bin_m();
        reference.intensity[i] = static_cast<float>(
            echo_in(scene, caster, BinVolume{view, beam, low, low + view.bin_m()}));
    }
}

}  // namespace sonarsim::test
