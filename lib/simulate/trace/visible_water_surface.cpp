#include "simulate/trace/visible_water_surface.h"

#include <array>
#include <cmath>

#include "core/units.h"
#include "simulate/trace/bounce_path.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/visible_surface.h"

namespace sonarsim {

namespace {

// The directions of the view are cut into cells of this size or this many; a cell that spans too
// much range is cut in four. The area in a bin is right to 1 % (visible_water_surface_test.cpp).
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

class SurfaceCutter {
  public:
    SurfaceCutter(const WaterMirror& surface, const View& view, std::uint32_t material)
        : surface_(surface),
          all_around_(view.shape == ViewShape::port_starboard),
          field_(view),
          reach_m_(static_cast<float>(view.range_max_m)),
          depth_m_(max_bins * static_cast<float>(view.bin_m())),
          material_(material) {
        const View wide = widened_view(view);
        const double azimuth = all_around_ ? 2.0 * pi : wide.azimuth_rad;
        const int columns = cells_over(azimuth);
        const int rows = cells_over(wide.elevation_rad);
        const double half_azimuth = 0.5 * azimuth / columns;
        const double half_elevation = 0.5 * wide.elevation_rad / rows;
        for (int j = 0; j < columns; ++j) {
            for (int i = 0; i < rows; ++i) {
                add({(2 * j + 1 - columns) * half_azimuth, (2 * i + 1 - rows) * half_elevation,
                     half_azimuth, half_elevation},
                    max_cuts);
            }
        }
    }

    std::vector<Sample> samples;

  private:
    static int cells_over(double angle_rad) {
        return static_cast<int>(std::ceil(std::max(min_cells, angle_rad / first_cell_rad)));
    }

    void add(const Cell& cell, int cuts) {
        const auto towards = [&](double a, double e) -> Eigen::Vector3f {
            return direction_of(cell.azimuth + a * cell.half_azimuth,
                                cell.elevation + e * cell.half_elevation)
                .cast<float>();
        };
        // Infinite below the horizon.
        const auto range = [&](const Eigen::Vector3f& to) {
            return surface_.distance({Eigen::Vector3f::Zero(), to});
        };
        const std::array ranges{range(towards(0.0, 0.0)), range(towards(-1.0, -1.0)),
                                range(towards(-1.0, 1.0)), range(towards(1.0, -1.0)),
                                range(towards(1.0, 1.0))};
        const auto [nearest, farthest] = std::ranges::minmax(ranges);
        if (!(nearest < reach_m_)) return;
        if (farthest - nearest > std::min(max_range_share * nearest, depth_m_)) {
            if (cuts > 0) {
                for (const double a : {-0.5, 0.5}) {
                    for (const double e : {-0.5, 0.5}) {
                        add({cell.azimuth + a * cell.half_azimuth,
                             cell.elevation + e * cell.half_elevation, 0.5 * cell.half_azimuth,
                             0.5 * cell.half_elevation},
                            cuts - 1);
                    }
                }
                return;
            }
            // A cell that reaches to twice its nearest range, or beyond, is at the horizon. Chosen.
            if (!(farthest < 2.0F * nearest)) return;
        }
        const auto place = [&](double a, double e) -> Eigen::Vector3f {
            const Eigen::Vector3f to = towards(a, e);
            return range(to) * to;
        };
        const Eigen::Vector3f middle = place(0.0, 0.0);
        if (!all_around_ && !field_.contains(middle)) return;
        const Eigen::Vector3f edge_u = 0.5F * (place(1.0, 0.0) - place(-1.0, 0.0));
        const Eigen::Vector3f edge_v = 0.5F * (place(0.0, 1.0) - place(0.0, -1.0));
        samples.push_back({.position = middle,
                           .edge_u = edge_u,
                           .edge_v = edge_v,
                           .normal = -surface_.up,
                           .height_m = surface_.height_m,
                           .area_m2 = 4.0F * edge_u.cross(edge_v).norm(),
                           .material = material_,
                           .instance = no_instance,
                           .kind = SampleKind::water_surface});
    }

    const WaterMirror& surface_;
    bool all_around_;
    GuardedField field_;
    float reach_m_, depth_m_;
    std::uint32_t material_;
};

/// Keeps the part of a sample below the water's surface, `room_m` above its middle; false: none.
bool keep_below(const Eigen::Vector3f& up, float room_m, Sample& sample) {
    const float rise_u = up.dot(sample.edge_u);
    const float rise_v = up.dot(sample.edge_v);
    constexpr auto slack_m = static_cast<float>(WaterSurface::slack_m);
    const float half_m = std::max(std::fabs(rise_u) + std::fabs(rise_v), slack_m);
    const float share = 0.5F + 0.5F * (room_m + slack_m) / half_m;
    if (!(share > 0.0F)) return false;
    if (share >= 1.0F) return true;
    // Wedges are cut as parallelograms.
    const bool is_u = std::fabs(rise_u) > std::fabs(rise_v);
    Eigen::Vector3f& edge = is_u ? sample.edge_u : sample.edge_v;
    sample.position -= std::copysign(1.0F - share, is_u ? rise_u : rise_v) * edge;
    edge *= share;
    sample.area_m2 *= share;
    return true;
}

}  // namespace

void cut_above_water(const Scene& scene, const Pose& T_world_sensor, Samples& samples) {
    const std::optional<WaterMirror> surface = mirror_of(scene.water_surface, T_world_sensor);
    if (!surface) return;
    const double top_m = scene.water_surface->height_m;
    if (scene.bodies.empty() && scene.bounds_max.z() <= top_m) return;
    const TruePlaces places{T_world_sensor, scene.sound_profile.get()};
    std::vector<Sample>& items = samples.items;
    std::size_t kept = 0;
    std::size_t next = 0;
    const auto keep_up_to = [&](std::size_t end) {
        for (; next < end; ++next) {
            const Eigen::Vector3d at = places.of(items[next].position.cast<double>());
            if (keep_below(surface->up, static_cast<float>(top_m - at.z()), items[next]))
                items[kept++] = items[next];
        }
        return static_cast<std::uint32_t>(kept);
    };
    for (std::uint32_t& begin : samples.beam_begin)
        begin = keep_up_to(begin);
    keep_up_to(items.size());
    items.resize(kept);
}

void ScatteringSurface::add(const TraceContext& context, const PingMotion& motion,
                            std::uint32_t /*pose*/, Samples& samples) const {
    const auto& [view, scene, engine, T_world_sensor] = context;
    const std::optional<WaterMirror> surface = mirror_of(scene.water_surface, T_world_sensor);
    if (!surface || !scene.water_surface->wind_m_s) return;
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    const std::vector<Sample> cells = SurfaceCutter(*surface, view, material).samples;
    std::vector<SightPoint> sights;
    sights.reserve(cells.size());
    for (const Sample& cell : cells)
        sights.push_back({cell.position});
    const std::vector<bool> visible = engine.visible(T_world_sensor, sights);
    for (std::size_t k = 0; k < cells.size(); ++k) {
        if (!visible[k]) continue;
        samples.items.push_back(cells[k]);
        if (motion.is_still()) continue;
        Eigen::Vector3f& place = samples.items.back().position;
        place = measured_place(motion, view.shape, place.cast<double>()).cast<float>();
    }
}

}  // namespace sonarsim
