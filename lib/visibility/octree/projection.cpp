#include "visibility/octree/projection.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// In the depth buffer a surface hides only surface more than this many leaves behind it. Sight
/// lines decide about nearer surface.
constexpr float slack_leaves = 0.5F;

// Positions are floats with errors of 1e-7 of the range. Nearer to the sensor's z axis than a
// hundred times that, an azimuth is mostly rounding.
constexpr double axis_per_range = 1e-5;

// A plane that passes the sensor at less than its own rounding counts as edge-on.
constexpr double edge_on_per_range = 1e-7;

// In pixels: leaves are a few pixels wide, and a narrow view is several pixels high, to resolve
// occlusion.
constexpr double pixels_per_leaf = 4.0;
constexpr double least_rows = 16.0;

constexpr int most_columns = 8192;
constexpr int most_rows = 2048;

/// True if a facet on the sensor's z axis may be in view.
bool is_in_view(const ProjectedFacet& facet, const ProjectionGrid& grid) {
    const auto aside = [](const Eigen::Vector3f& v) {
        return std::sqrt(v.x() * v.x() + v.y() * v.y());
    };
    const float farthest =
        std::sqrt(grid.least_rho2_m2) + aside(facet.edge_u) + aside(facet.edge_v);
    const float lowest =
        std::fabs(facet.centre.z()) - std::fabs(facet.edge_u.z()) - std::fabs(facet.edge_v.z());
    return grid.rows_per_slope * lowest < 0.5F * static_cast<float>(grid.rows) * farthest;
}

/// The centre of a facet about the sensor's z axis: 1 / rho, z / rho, and the half extents in rho
/// along u and v.
struct AxisDistance {
    float per_rho, slope, rho_u, rho_v;
};

/// Sets the normal, and 1 / rho with its slopes over the picture. The centre and the outline are
/// set before.
void set_depth(const LeafFacet& leaf, float leaf_m, const Eigen::Vector3f& normal,
               const AxisDistance& at, const ProjectionGrid& grid, ProjectedFacet& facet) {
    const auto& [per_rho, slope, rho_u, rho_v] = at;
    const float per_rho2 = per_rho * per_rho;
    const float x = facet.centre.x();
    const float y = facet.centre.y();
    const float signed_height = -(normal.x() * x + normal.y() * y + normal.z() * facet.centre.z());
    const float facing = signed_height < 0.0F ? -1.0F : 1.0F;
    facet.normal = facing * normal;
    const float height = std::max(facing * signed_height, grid.least_height_m);
    // 1 / rho = -(n . (cos azimuth, sin azimuth, slope)) / height.
    const float per_height = 1.0F / height;
    facet.depth = per_rho;
    facet.depth_row = -facet.normal.z() * per_height / grid.rows_per_slope;
    facet.depth_beam =
        (facet.normal.x() * y - facet.normal.y() * x) * per_rho * per_height / grid.beams_per_rad;
    const float leaf_depth = leaf_m * per_rho2;
    facet.depth_range = per_rho2 * (std::fabs(rho_u) + std::fabs(rho_v)) + 0.5F * leaf_depth;
    const float cosine = std::max(height * per_rho / std::sqrt(1.0F + slope * slope), 0.1F);
    const float pixel_slope =
        std::fabs(facet.depth_row) +
        std::fabs(facet.depth_beam) / static_cast<float>(grid.columns_per_beam);
    facet.slack = slack_leaves * leaf_depth + per_rho2 * leaf.thickness_m / cosine +
                  std::min(0.5F * pixel_slope, 0.25F * leaf_depth);
}

/// Sets the half edges: `u` and `v` rotated into each other as conjugate half edges, which keeps
/// the second moments.
void set_edges(const Eigen::Vector3f& u, const Eigen::Vector3f& v, ProjectedFacet& facet) {
    const auto& [beams_u, beams_v, rows_u, rows_v] = facet.outline;
    const float a = beams_u / facet.half_beams;
    const float b = beams_v / facet.half_beams;
    facet.edge_u = a * u + b * v;
    facet.edge_v = a * v - b * u;
    facet.rows_u = a * rows_u + b * rows_v;
    const float rows_along_v = a * rows_v - b * rows_u;
    // Rows must grow along edge_v, so that a part's v follows from its rows.
    if (rows_along_v < 0.0F) facet.edge_v = -facet.edge_v;
    facet.half_rows = std::max(std::fabs(rows_along_v), 1e-4F);
}

}  // namespace

ProjectionGrid projection_grid(const PreparedView& prepared, float leaf_rad) {
    const View& view = prepared.view;
    ProjectionGrid grid{};
    grid.R_sensor_local = prepared.volume.R_sensor_local();
    grid.sensor = grid.R_sensor_local * prepared.volume.position().cast<float>();
    grid.beams = view.beams;
    const double pixel_rad = std::min(leaf_rad / pixels_per_leaf, view.elevation_rad / least_rows);
    const double beam = view.azimuth_rad / view.beams;
    grid.columns_per_beam = std::clamp(static_cast<int>(beam / pixel_rad + 0.5), 1,
                                       std::max(most_columns / view.beams, 1));
    grid.columns = grid.beams * grid.columns_per_beam;
    grid.rows =
        std::clamp(static_cast<int>(std::ceil(view.elevation_rad / pixel_rad)), 1, most_rows);
    grid.beams_per_rad = static_cast<float>(1.0 / beam);
    grid.beams_per_revolution = static_cast<float>(2.0 * pi / beam);
    const SinCos half = sincos(0.5 * view.elevation_rad);
    grid.rows_per_slope = static_cast<float>(0.5 * grid.rows * half.cos / half.sin);
    const double least_rho = axis_per_range * view.range_max_m;
    grid.least_rho2_m2 = static_cast<float>(least_rho * least_rho);
    grid.least_height_m = static_cast<float>(edge_on_per_range * view.range_max_m);
    return grid;
}

Projection project(const LeafFacet& leaf, float leaf_m, const ProjectionGrid& grid,
                   ProjectedFacet& facet) {
    const Eigen::Matrix3f& R = grid.R_sensor_local;
    // The order of the sums affects the rounding of the result.
    const auto turned = [&R](const Eigen::Vector3f& v) {
        return Eigen::Vector3f(R.col(0) * v.x() + R.col(1) * v.y() + R.col(2) * v.z());
    };
    facet.centre = turned(leaf.centre) - grid.sensor;
    const Eigen::Vector3f u = turned(leaf.edge_u);
    const Eigen::Vector3f v = turned(leaf.edge_v);
    const float x = facet.centre.x();
    const float y = facet.centre.y();
    const float rho2 = x * x + y * y;
    if (!(rho2 > grid.least_rho2_m2)) {
        facet.edge_u = u;
        facet.edge_v = v;
        return is_in_view(facet, grid) ? Projection::on_axis : Projection::out_of_view;
    }
    const float per_rho = 1.0F / std::sqrt(rho2);
    const float per_rho2 = per_rho * per_rho;
    const float slope = facet.centre.z() * per_rho;
    const float rho_u = per_rho * (x * u.x() + y * u.y());
    const float rho_v = per_rho * (x * v.x() + y * v.y());
    facet.outline = {grid.beams_per_rad * per_rho2 * (x * u.y() - y * u.x()),
                     grid.beams_per_rad * per_rho2 * (x * v.y() - y * v.x()),
                     grid.rows_per_slope * per_rho * (u.z() - slope * rho_u),
                     grid.rows_per_slope * per_rho * (v.z() - slope * rho_v)};
    const auto& [beams_u, beams_v, rows_u, rows_v] = facet.outline;
    const auto beams = static_cast<float>(grid.beams);
    const auto rows = static_cast<float>(grid.rows);
    facet.half_beams = std::sqrt(beams_u * beams_u + beams_v * beams_v) + 1e-6F;
    facet.beam = grid.beams_per_rad * arctan2_float(y, x) + 0.5F * beams;
    facet.row = grid.rows_per_slope * slope + 0.5F * rows;
    const float tall = std::fabs(rows_u) + std::fabs(rows_v);
    const bool in_view = facet.beam > -facet.half_beams && facet.beam - facet.half_beams < beams &&
                         facet.row > -tall && facet.row - tall < rows;
    if (!in_view) return Projection::out_of_view;

    set_depth(leaf, leaf_m, turned(leaf.normal), {per_rho, slope, rho_u, rho_v}, grid, facet);
    set_edges(u, v, facet);
    facet.area_m2 = leaf.area_m2;
    facet.thickness_m = leaf.thickness_m;
    facet.triangle = leaf.triangle;
    return Projection::in_view;
}

}  // namespace sonarsim
