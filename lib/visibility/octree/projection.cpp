#include "visibility/octree/projection.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

/// A surface hides what lies more than this many leaves behind it. Sight lines decide about nearer
/// surface.
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

/// A block of facets during projection.
struct Lanes {
    static constexpr int width = 32;
    using Lane = std::array<float, width>;
    std::array<Lane, 3> centre, normal, u, v;
    Lane in_sight, beams_u, beams_v, rows_u, rows_v;
    Lane beam, half_beams, row, mix_u, mix_v;
    Lane depth, depth_beam, depth_row, depth_range, slack;
};

void project_block(const FacetArrays& facets, std::uint32_t begin, int count,
                   const ViewVolume& volume, const ProjectionGrid& grid, float leaf_m, Lanes& out) {
    // A local copy, which no write to `out` can change, stays in registers.
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
    const Eigen::Matrix3f R = volume.R_sensor_local();
    const Eigen::Vector3f at = R * volume.position().cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
        const float a = R(axis, 0);
        const float b = R(axis, 1);
        const float c = R(axis, 2);
        const float shift = at[axis];
        const auto to_sensor = [&](int first_value, float minus, float* to) {
            const float* const x = facets.values[first_value].data() + begin;
            const float* const y = facets.values[first_value + 1].data() + begin;
            const float* const z = facets.values[first_value + 2].data() + begin;
            for (int k = 0; k < count; ++k)
                to[k] = a * x[k] + b * y[k] + c * z[k] - minus;
        };
        to_sensor(FacetArrays::centre, shift, out.centre[axis].data());
        to_sensor(FacetArrays::normal, 0.0F, out.normal[axis].data());
        to_sensor(FacetArrays::edge_u, 0.0F, out.u[axis].data());
        to_sensor(FacetArrays::edge_v, 0.0F, out.v[axis].data());
    }
    const float* const thickness = facets.values[FacetArrays::thickness].data() + begin;
    const float beams_per_rad = grid.beams_per_rad;
    const float rows_per_slope = grid.rows_per_slope;
    const auto beams = static_cast<float>(grid.beams);
    const auto rows = static_cast<float>(grid.rows);
    const float columns_per_beam = static_cast<float>(grid.columns_per_beam);
    const float least_rho2 = grid.least_rho2_m2;
    const float least_height = grid.least_height_m;
    for (int k = 0; k < count; ++k) {
        const float x = out.centre[0][k];
        const float y = out.centre[1][k];
        const float z = out.centre[2][k];
        const float rho2 = std::max(x * x + y * y, least_rho2);
        const float per_rho = 1.0F / std::sqrt(rho2);
        const float per_rho2 = per_rho * per_rho;
        const float slope = z * per_rho;
        const float beams_u = beams_per_rad * per_rho2 * (x * out.u[1][k] - y * out.u[0][k]);
        const float beams_v = beams_per_rad * per_rho2 * (x * out.v[1][k] - y * out.v[0][k]);
        const float rho_u = per_rho * (x * out.u[0][k] + y * out.u[1][k]);
        const float rho_v = per_rho * (x * out.v[0][k] + y * out.v[1][k]);
        const float rows_u = rows_per_slope * per_rho * (out.u[2][k] - slope * rho_u);
        const float rows_v = rows_per_slope * per_rho * (out.v[2][k] - slope * rho_v);
        const float half_beams = std::sqrt(beams_u * beams_u + beams_v * beams_v) + 1e-6F;
        const float beam = beams_per_rad * arctan2_float(y, x) + 0.5F * beams;
        const float row = rows_per_slope * slope + 0.5F * rows;
        const float half_rows = std::fabs(rows_u) + std::fabs(rows_v);
        const float out_of_sight = std::max(std::max(-half_beams - beam, beam - half_beams - beams),
                                            std::max(-half_rows - row, row - half_rows - rows));
        // The sensor's axis has no azimuth.
        out.in_sight[k] = rho2 > least_rho2 ? -out_of_sight : -1.0F;
        out.beams_u[k] = beams_u;
        out.beams_v[k] = beams_v;
        out.rows_u[k] = rows_u;
        out.rows_v[k] = rows_v;
        out.beam[k] = beam;
        out.half_beams[k] = half_beams;
        out.row[k] = row;
        out.mix_u[k] = beams_u / half_beams;
        out.mix_v[k] = beams_v / half_beams;
        const float signed_height =
            -(out.normal[0][k] * x + out.normal[1][k] * y + out.normal[2][k] * z);
        const float facing = signed_height < 0.0F ? -1.0F : 1.0F;
        const float nx = facing * out.normal[0][k];
        const float ny = facing * out.normal[1][k];
        const float nz = facing * out.normal[2][k];
        out.normal[0][k] = nx;
        out.normal[1][k] = ny;
        out.normal[2][k] = nz;
        // 1 / rho = -(n . (cos azimuth, sin azimuth, slope)) / height.
        const float height = std::max(facing * signed_height, least_height);
        const float per_height = 1.0F / height;
        const float depth_row = -nz * per_height / rows_per_slope;
        const float depth_beam = (nx * y - ny * x) * per_rho * per_height / beams_per_rad;
        const float leaf_depth = leaf_m * per_rho2;
        const float cosine = std::max(height * per_rho / std::sqrt(1.0F + slope * slope), 0.1F);
        const float pixel_slope = std::fabs(depth_row) + std::fabs(depth_beam) / columns_per_beam;
        out.depth[k] = per_rho;
        out.depth_row[k] = depth_row;
        out.depth_beam[k] = depth_beam;
        out.depth_range[k] = per_rho2 * (std::fabs(rho_u) + std::fabs(rho_v)) + 0.5F * leaf_depth;
        out.slack[k] = slack_leaves * leaf_depth + per_rho2 * thickness[k] / cosine +
                       std::min(0.5F * pixel_slope, 0.25F * leaf_depth);
    }
}

/// True if a facet is dropped only because its azimuth is within rounding, although it is in view.
bool is_lost_on_axis(const Lanes& lanes, int k, const ProjectionGrid& grid) {
    const float x = lanes.centre[0][k];
    const float y = lanes.centre[1][k];
    if (x * x + y * y > grid.least_rho2_m2) return false;
    const auto aside = [&](const std::array<Lanes::Lane, 3>& v) {
        return std::sqrt(v[0][k] * v[0][k] + v[1][k] * v[1][k]);
    };
    const float farthest = std::sqrt(grid.least_rho2_m2) + aside(lanes.u) + aside(lanes.v);
    const float lowest =
        std::fabs(lanes.centre[2][k]) - std::fabs(lanes.u[2][k]) - std::fabs(lanes.v[2][k]);
    return grid.rows_per_slope * lowest < 0.5F * static_cast<float>(grid.rows) * farthest;
}

}  // namespace

ProjectionGrid projection_grid(const View& view, float leaf_rad) {
    ProjectionGrid grid{};
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

int project(const LeafRun& run, const ViewVolume& volume, const ProjectionGrid& grid,
            std::vector<ProjectedFacet>& projected, std::vector<Outline>& outlines) {
    const FacetArrays& facets = run.level->facets;
    Lanes lanes;
    int lost = 0;
    for (std::uint32_t begin = run.facets_begin(); begin < run.facets_end();
         begin += Lanes::width) {
        const int count =
            static_cast<int>(std::min<std::uint32_t>(run.facets_end() - begin, Lanes::width));
        project_block(facets, begin, count, volume, grid, run.leaf_m, lanes);
        for (int k = 0; k < count; ++k) {
            if (!(lanes.in_sight[k] > 0.0F)) {
                lost += is_lost_on_axis(lanes, k, grid);
                continue;
            }
            const auto vector = [&](const std::array<Lanes::Lane, 3>& v) {
                return Eigen::Vector3f(v[0][k], v[1][k], v[2][k]);
            };
            const Eigen::Vector3f u = vector(lanes.u);
            const Eigen::Vector3f v = vector(lanes.v);
            const float a = lanes.mix_u[k];
            const float b = lanes.mix_v[k];
            ProjectedFacet& next = projected.emplace_back();
            next.centre = vector(lanes.centre);
            next.normal = vector(lanes.normal);
            // Rotating conjugate half edges into each other keeps the second moments.
            next.edge_u = a * u + b * v;
            next.edge_v = a * v - b * u;
            next.rows_u = a * lanes.rows_u[k] + b * lanes.rows_v[k];
            const float rows = a * lanes.rows_v[k] - b * lanes.rows_u[k];
            // Rows must grow along edge_v, so that a part's v follows from its rows.
            if (rows < 0.0F) next.edge_v = -next.edge_v;
            next.half_rows = std::max(std::fabs(rows), 1e-4F);
            next.area_m2 = facets.values[FacetArrays::area][begin + k];
            next.thickness_m = facets.values[FacetArrays::thickness][begin + k];
            next.triangle = facets.triangle[begin + k];
            next.beam = lanes.beam[k];
            next.half_beams = lanes.half_beams[k];
            next.row = lanes.row[k];
            next.depth = lanes.depth[k];
            next.depth_beam = lanes.depth_beam[k];
            next.depth_row = lanes.depth_row[k];
            next.depth_range = lanes.depth_range[k];
            next.slack = lanes.slack[k];
            outlines.push_back(
                {lanes.beams_u[k], lanes.beams_v[k], lanes.rows_u[k], lanes.rows_v[k]});
            const float beam = next.beam;
            const float half = next.half_beams;
            // So near the axis the facet covers all azimuths, and its ends are meaningless.
            if (half > 0.5F * grid.beams_per_revolution) continue;
            for (const float other :
                 {beam - grid.beams_per_revolution, beam + grid.beams_per_revolution}) {
                if (other + half <= 0.0F || other - half >= static_cast<float>(grid.beams))
                    continue;
                ProjectedFacet over = projected.back();
                over.beam = other;
                projected.push_back(over);
                outlines.push_back(Outline(outlines.back()));
            }
        }
    }
    return lost;
}

}  // namespace sonarsim
