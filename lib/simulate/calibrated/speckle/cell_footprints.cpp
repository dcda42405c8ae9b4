#include "simulate/calibrated/speckle/cell_footprints.h"

#include <bit>
#include <limits>

#include "simulate/trace/arrivals.h"
#include "simulate/trace/taper.h"

namespace sonarsim {

namespace {

// Greatest length of a resolution cell on the surface, in pulse lengths.
constexpr float longest_on_surface = 4.0F;

// From this area of a small cell on, over the wanted one, all are small: few large are uneven.
constexpr float min_split_areas = 0.5F;

template <class T>
using Batch = CellFootprints::Array<T>;

struct Vectors {
    Batch<float> x, y, z;

    void set(int k, const Eigen::Vector3f& v) {
        x[k] = v.x();
        y[k] = v.y();
        z[k] = v.z();
    }
    /// A vector rotated into the world.
    void turn(const Eigen::Matrix3f& R, int count) {
        for (int k = 0; k < count; ++k) {
            const float a = x[k];
            const float b = y[k];
            const float c = z[k];
            x[k] = std::fma(R(0, 0), a, std::fma(R(0, 1), b, R(0, 2) * c));
            y[k] = std::fma(R(1, 0), a, std::fma(R(1, 1), b, R(1, 2) * c));
            z[k] = std::fma(R(2, 0), a, std::fma(R(2, 1), b, R(2, 2) * c));
        }
    }
};

/// The samples of a batch in the axes of the world, relative to the sonar.
struct Surfaces {
    Vectors place, u, v;
    Batch<float> range, height, area;
    int count;

    Surfaces(std::span<const Sample> samples, const Eigen::Matrix3f& R_world_sensor)
        : count(static_cast<int>(samples.size())) {
        for (int k = 0; k < count; ++k) {
            const Sample& sample = samples[k];
            place.set(k, sample.middle());
            u.set(k, sample.edge_u);
            v.set(k, sample.edge_v);
            height[k] = sample.height_m;
            area[k] = sample.area_m2 * sample.strength;
        }
        for (int k = 0; k < count; ++k) {
            range[k] = piece_range(place.x[k], place.y[k], place.z[k]);
        }
        place.turn(R_world_sensor, count);
        u.turn(R_world_sensor, count);
        v.turn(R_world_sensor, count);
    }
};

template <class T>
T along(std::int32_t axis, T x, T y, T z) {
    return axis == 0 ? x : axis == 1 ? y : z;
}

/// The squared edge of cells for a surface at a range and a grazing angle of `sine`. On the surface
/// resolution cells are longer than in range by one over its cosine, and so are these.
float wanted_edge2(const ScattererCells& cells, float range, float sine) {
    const float cosine2 = 1.0F - sine * sine;
    const float longer2 =
        std::min(1.0F / std::max(cosine2, 1e-6F), longest_on_surface * longest_on_surface);
    const float grazing2 = cells.edge_per_root_range * cells.edge_per_root_range * range;
    const float depth2 = cells.max_depth_m * cells.max_depth_m;
    const float width = cells.width_rad * range;
    // Cells that are larger because of the length are no wider than a beam.
    return std::min(std::min(grazing2 * std::sqrt(longer2), depth2 * longer2),
                    std::max(std::min(grazing2, depth2), width * width));
}

float power_of_two(std::int32_t exponent) {
    return std::bit_cast<float>((127 + exponent) << 23);
}

/// The level of the smaller cells, and the share w of the larger ones that are not split. A larger
/// cell holds 4 smaller ones, so its mean number of scatterers is w + 4 (1 - w), the wanted number.
void find_levels(const Surfaces& surfaces, const ScattererCells& cells, CellFootprints& out) {
    const float per_area = 1.0F / (cells.min_edge_m * cells.min_edge_m);
    const std::int32_t top = cells.levels - 1;
    for (int k = 0; k < surfaces.count; ++k) {
        const float range = surfaces.range[k];
        const float sine = std::min(surfaces.height[k] / range, 1.0F);
        const float ratio = std::max(1.0F, wanted_edge2(cells, range, sine) * per_area);
        // The exponent of a ratio of areas is twice that of the edges.
        const std::int32_t level = ((std::bit_cast<std::int32_t>(ratio) >> 23) - 127) >> 1;
        const float split_areas = power_of_two(2 * std::min(level, top)) / ratio;
        out.level[k] = std::min(level, top);
        out.unsplit_share[k] = level < top && split_areas < min_split_areas
                                   ? (4.0F / 3.0F) * (1.0F - split_areas)
                                   : 0.0F;
        out.fine_m[k] = cells.min_edge_m * power_of_two(out.level[k]);
    }
}

void find_parallelograms(const Surfaces& surfaces, const Eigen::Vector3d& sensor,
                         const ScattererCells& cells, CellFootprints& out) {
    const auto& [place, u, v, range, height, area, count] = surfaces;
    const double per_min = 1.0 / cells.min_edge_m;
    for (int k = 0; k < count; ++k) {
        const float nx = u.y[k] * v.z[k] - u.z[k] * v.y[k];
        const float ny = u.z[k] * v.x[k] - u.x[k] * v.z[k];
        const float nz = u.x[k] * v.y[k] - u.y[k] * v.x[k];
        const float ax = std::fabs(nx);
        const float ay = std::fabs(ny);
        const float az = std::fabs(nz);
        // Slopes and walls of 45 degrees are common: rounding must not choose their axis.
        constexpr float bias = 0.95F;
        const std::int32_t axis = az > bias * std::max(ax, ay) ? 2 : ay > bias * ax ? 1 : 0;
        out.axis[k] = axis;
        out.area_by_projected[k] = area[k] / (4.0F * along(axis, ax, ay, az));

        const double per_edge = per_min * power_of_two(-out.level[k]);
        const double x = (sensor.x() + place.x[k]) * per_edge;
        const double y = (sensor.y() + place.y[k]) * per_edge;
        const double z = (sensor.z() + place.z[k]) * per_edge;
        const double base_x = 8.0 * std::floor(0.125 * x);
        const double base_y = 8.0 * std::floor(0.125 * y);
        const double base_z = 8.0 * std::floor(0.125 * z);
        const auto cell_x = static_cast<std::int32_t>(base_x);
        const auto cell_y = static_cast<std::int32_t>(base_y);
        const auto cell_z = static_cast<std::int32_t>(base_z);
        const auto centre_x = static_cast<float>(x - base_x);
        const auto centre_y = static_cast<float>(y - base_y);
        const auto centre_z = static_cast<float>(z - base_z);
        out.base_first[k] = along(axis, cell_y, cell_z, cell_x);
        out.base_second[k] = along(axis, cell_z, cell_x, cell_y);
        out.base_axis[k] = along(axis, cell_x, cell_y, cell_z);
        out.first[k] = along(axis, centre_y, centre_z, centre_x);
        out.second[k] = along(axis, centre_z, centre_x, centre_y);
        out.height[k] = along(axis, centre_x, centre_y, centre_z);
    }
}

void find_rows(const Surfaces& surfaces, CellFootprints& out) {
    const auto& [place, u, v, range, height, area, count] = surfaces;
    constexpr float rounding = 2e-3F;
    for (int k = 0; k < count; ++k) {
        const std::int32_t axis = out.axis[k];
        const float per_edge = 1.0F / out.fine_m[k];
        const float u1 = per_edge * along(axis, u.y[k], u.z[k], u.x[k]);
        const float u2 = per_edge * along(axis, u.z[k], u.x[k], u.y[k]);
        const float v1 = per_edge * along(axis, v.y[k], v.z[k], v.x[k]);
        const float v2 = per_edge * along(axis, v.z[k], v.x[k], v.y[k]);
        out.height_u[k] = per_edge * along(axis, u.x[k], u.y[k], u.z[k]);
        out.height_v[k] = per_edge * along(axis, v.x[k], v.y[k], v.z[k]);
        const float per_area = 1.0F / (u1 * v2 - u2 * v1);
        out.s_x[k] = v2 * per_area;
        out.s_y[k] = -v1 * per_area;
        out.t_x[k] = -u2 * per_area;
        out.t_y[k] = u1 * per_area;
        const float sum = out.s_x[k] + out.s_y[k] + out.t_x[k] + out.t_y[k];
        const bool any_area = std::fabs(sum) <= std::numeric_limits<float>::max();

        // The rows cover a parallelogram around the trapezoid.
        const float widest_u = 1.0F + std::fabs(out.taper_v[k]);
        const float widest_v = 1.0F + std::fabs(out.taper_u[k]);
        const float reach1 = std::fabs(widest_u * u1) + std::fabs(widest_v * v1);
        const float reach2 = std::fabs(widest_u * u2) + std::fabs(widest_v * v2);
        const bool by_first = reach1 >= reach2;
        const float outer = by_first ? out.first[k] : out.second[k];
        const float inner = by_first ? out.second[k] : out.first[k];
        const float outer_reach = by_first ? reach1 : reach2;
        const float inner_reach = by_first ? reach2 : reach1;
        const float outer_u = widest_u * (by_first ? u1 : u2);
        const float inner_u = widest_u * (by_first ? u2 : u1);
        const float outer_v = widest_v * (by_first ? v1 : v2);
        const float inner_v = widest_v * (by_first ? v2 : v1);
        out.rows_along_first[k] = by_first ? 1 : 0;
        const float begin = std::floor(0.5F * (outer - outer_reach));
        const float end = std::floor(0.5F * (outer + outer_reach)) + 1.0F;
        out.row_begin[k] = static_cast<std::int32_t>(begin);
        out.row_end[k] = static_cast<std::int32_t>(any_area ? end : begin);
        out.min_inner[k] = std::floor(0.5F * (inner - inner_reach));
        out.max_inner[k] = std::floor(0.5F * (inner + inner_reach));
        // Rows follow the edge that extends further along the outer axis.
        const bool by_u = std::fabs(outer_u) >= std::fabs(outer_v);
        const float slope = by_u ? inner_u / outer_u : inner_v / outer_v;
        const float other = by_u ? inner_v - slope * outer_v : inner_u - slope * outer_u;
        const float margin = std::fabs(other) + rounding;
        out.left[k] = 0.5F * (inner - slope * outer - margin) + std::min(0.0F, slope);
        out.slope[k] = slope;
        out.width[k] = std::fabs(slope) + margin;
    }
}

}  // namespace

void find_footprints(std::span<const Sample> samples, ViewShape shape, const ScattererCells& cells,
                     const SonarInScene& sonar, CellFootprints& out) {
    const Surfaces surfaces(samples, sonar.R_world_sensor);
    out.count = surfaces.count;
    for (int k = 0; k < out.count; ++k) {
        const Taper taper = trapezoid_of(samples[k], shape);
        out.taper_u[k] = taper.u;
        out.taper_v[k] = taper.v;
    }
    find_levels(surfaces, cells, out);
    find_parallelograms(surfaces, sonar.sensor, cells, out);
    find_rows(surfaces, out);
    for (int k = 0; k < out.count; ++k) {
        if (is_wholly_nearer(samples[k], surfaces.range[k], cells.range_min_m))
            out.row_end[k] = out.row_begin[k];
    }
}

}  // namespace sonarsim
