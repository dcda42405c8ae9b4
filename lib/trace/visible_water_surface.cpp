#include "trace/visible_water_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

// The directions of the view are cut into cells of this size or this many; a cell that spans too
// much range is cut in four. These numbers are chosen. With them the area in a bin is right to 1 %
// (water_surface_test.cpp).
constexpr double first_cell_rad = radians(2.0);
constexpr double min_cells = 16.0;
constexpr float max_range_share = 1.0F / 8.0F;
constexpr float max_bins = 64.0F;
constexpr int max_cuts = 7;

/// A rectangle of azimuth and elevation.
struct Cell {
    double azimuth, elevation;  ///< angles of the middle
    double half_azimuth, half_elevation;
};

Eigen::Vector3f direction(double azimuth, double elevation) {
    const SinCos a = sincos(azimuth);
    const SinCos e = sincos(elevation);
    return {static_cast<float>(e.cos * a.cos), static_cast<float>(e.cos * a.sin),
            static_cast<float>(e.sin)};
}

class SurfaceCutter {
  public:
    SurfaceCutter(const WaterMirror& surface, const View& view, const GuardBeams& guard_beams)
        : surface_(surface),
          all_around_(view.shape == ViewShape::port_starboard),
          field_(view, guard_beams),
          reach_m_(static_cast<float>(view.range_max_m)),
          depth_m_(max_bins * static_cast<float>(view.bin_m())) {}

    std::vector<Sample> cut(const View& widened) {
        const double azimuth = all_around_ ? 2.0 * pi : widened.azimuth_rad;
        const int columns = cells_over(azimuth);
        const int rows = cells_over(widened.elevation_rad);
        const double half_azimuth = 0.5 * azimuth / columns;
        const double half_elevation = 0.5 * widened.elevation_rad / rows;
        for (int j = 0; j < columns; ++j) {
            for (int i = 0; i < rows; ++i) {
                add({(2 * j + 1 - columns) * half_azimuth, (2 * i + 1 - rows) * half_elevation,
                     half_azimuth, half_elevation},
                    max_cuts);
            }
        }
        return std::move(samples_);
    }

  private:
    static int cells_over(double angle_rad) {
        return static_cast<int>(std::ceil(std::max(min_cells, angle_rad / first_cell_rad)));
    }

    /// The range of the surface in a direction; infinite below the horizon.
    float range(const Eigen::Vector3f& towards) const {
        return surface_.distance({Eigen::Vector3f::Zero(), towards});
    }

    void add(const Cell& cell, int cuts) {
        const auto& [azimuth, elevation, half_azimuth, half_elevation] = cell;
        float nearest = range(direction(azimuth, elevation));
        float farthest = nearest;
        for (const double a : {azimuth - half_azimuth, azimuth + half_azimuth}) {
            for (const double e : {elevation - half_elevation, elevation + half_elevation}) {
                const float corner = range(direction(a, e));
                nearest = std::min(nearest, corner);
                farthest = std::max(farthest, corner);
            }
        }
        if (!(nearest < reach_m_)) return;
        const float max_m = std::min(max_range_share * nearest, depth_m_);
        if (!(farthest - nearest > max_m)) return add_sample(cell);
        if (cuts == 0) {
            // A cell that reaches to twice its nearest range, or beyond, is at the horizon. Chosen.
            if (farthest < 2.0F * nearest) add_sample(cell);
            return;
        }
        for (const double a : {-0.5, 0.5}) {
            for (const double e : {-0.5, 0.5}) {
                add({azimuth + a * half_azimuth, elevation + e * half_elevation, 0.5 * half_azimuth,
                     0.5 * half_elevation},
                    cuts - 1);
            }
        }
    }

    void add_sample(const Cell& cell) {
        const auto point = [&](double a, double e) -> Eigen::Vector3f {
            const Eigen::Vector3f towards = direction(cell.azimuth + a * cell.half_azimuth,
                                                      cell.elevation + e * cell.half_elevation);
            return range(towards) * towards;
        };
        const Eigen::Vector3f middle = point(0.0, 0.0);
        if (!all_around_ && !field_.contains(middle)) return;
        const Eigen::Vector3f edge_u = 0.5F * (point(1.0, 0.0) - point(-1.0, 0.0));
        const Eigen::Vector3f edge_v = 0.5F * (point(0.0, 1.0) - point(0.0, -1.0));
        samples_.push_back({.position = middle,
                            .edge_u = edge_u,
                            .edge_v = edge_v,
                            .normal = -surface_.up,
                            .height_m = surface_.height_m,
                            .area_m2 = 4.0F * edge_u.cross(edge_v).norm(),
                            .material = 0,
                            .instance = 0});
    }

    const WaterMirror& surface_;
    bool all_around_;
    GuardedField field_;
    float reach_m_, depth_m_;
    std::vector<Sample> samples_;
};

}  // namespace

std::vector<Sample> visible_water_surface(const WaterMirror& surface, const View& view,
                                          const GuardBeams& guard_beams,
                                          const VisibilityEngine& engine,
                                          const Pose& T_world_sensor, const PingMotion& motion) {
    std::vector<Sample> samples =
        SurfaceCutter(surface, view, guard_beams).cut(widened_view(view, guard_beams));
    std::vector<Ray> rays;
    rays.reserve(samples.size());
    for (const Sample& sample : samples)
        rays.push_back({Eigen::Vector3f::Zero(), sample.position.normalized()});
    std::vector<Intersection> hits(rays.size());
    engine.intersect(T_world_sensor, rays, hits);
    std::vector<Sample> seen;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (hits[k].distance_m < samples[k].position.norm()) continue;
        seen.push_back(samples[k]);
        if (motion.is_still()) continue;
        Eigen::Vector3f& place = seen.back().position;
        place = measured_place(motion, view.shape, place.cast<double>()).cast<float>();
    }
    return seen;
}

}  // namespace sonarsim
