#include "surface/octree_shadow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/elementary.h"

namespace sonarsim {

namespace {

/// Footprints are parallelograms in place of polygons, so neighbours leave gaps. As a screen they
/// are larger by this factor, which closes them. Rectangles fit without.
constexpr float closing = 1.25F;
constexpr float closing_plain = 1.05F;

constexpr int most_columns = 8192;

/// A surface hides what lies behind it by more than this many leaves.
constexpr float slack_leaves = 0.25F;

/// Keeps a divisor away from zero, where only the sign of the quotient matters.
float divisor(float x) {
    return std::fabs(x) > 1e-9F ? x : std::copysign(1e-9F, x);
}

/// The angle of the point (x, y) in [-pi, pi], absolute error below 1e-6: half the angle's tangent,
/// at most tan(pi / 8), then the Taylor series.
float azimuth_of(float x, float y) {
    const float ax = std::fabs(x);
    const float ay = std::fabs(y);
    const float high = std::max(ax, ay);
    const float low = std::min(ax, ay);
    float t = low / high;
    t /= 1.0F + std::sqrt(1.0F + t * t);
    const float t2 = t * t;
    const float series =
        1.0F -
        t2 * (1.0F / 3 -
              t2 * (1.0F / 5 -
                    t2 * (1.0F / 7 - t2 * (1.0F / 9 - t2 * (1.0F / 11 - t2 * (1.0F / 13))))));
    float angle = 2.0F * t * series;
    if (ay > ax) angle = static_cast<float>(0.5 * pi) - angle;
    if (x < 0.0F) angle = static_cast<float>(pi) - angle;
    return y < 0.0F ? -angle : angle;
}

}  // namespace

AngularCells::AngularCells(const View& view, float cell_rad) : beams_(view.beams) {
    const double beam = view.azimuth_rad / view.beams;
    columns_per_beam_ =
        std::clamp(static_cast<int>(beam / cell_rad + 0.5), 1, std::max(most_columns / beams_, 1));
    columns_ = beams_ * columns_per_beam_;
    rows_ = std::clamp(static_cast<int>(std::ceil(view.elevation_rad / cell_rad)), 4, 2048);
    beams_per_rad_ = static_cast<float>(1.0 / beam);
    const SinCos half = sincos(0.5 * view.elevation_rad);
    rows_per_slope_ = static_cast<float>(0.5 * rows_ * half.cos / half.sin);
    depth_.assign(static_cast<std::size_t>(columns_) * rows_, 0.0F);
}

/// A block of facets as they are projected.
struct AngularCells::Lanes {
    static constexpr int width = 32;
    using Lane = std::array<float, width>;
    std::array<Lane, 3> centre, normal, u, v;
    Lane in_sight, beams_u, beams_v, rows_u, rows_v;
    Lane beam, half_beams, row, turn_u, turn_v;
    Lane depth, depth_beam, depth_row, depth_range, slack, closing;
};

void AngularCells::project(const FacetArrays& facets, std::uint32_t begin, int count,
                           const Field& field, float leaf_m, Lanes& out) const {
    const Eigen::Matrix3f R = field.R_sensor_local();
    const Eigen::Vector3f at = R * field.position().cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
        const float a = R(axis, 0);
        const float b = R(axis, 1);
        const float c = R(axis, 2);
        const float shift = at[axis];
        const auto turn = [&](int field_index, float minus, float* to) {
            const float* const x = facets.values[field_index].data() + begin;
            const float* const y = facets.values[field_index + 1].data() + begin;
            const float* const z = facets.values[field_index + 2].data() + begin;
            for (int k = 0; k < count; ++k)
                to[k] = a * x[k] + b * y[k] + c * z[k] - minus;
        };
        turn(0, shift, out.centre[axis].data());
        turn(3, 0.0F, out.normal[axis].data());
        turn(6, 0.0F, out.u[axis].data());
        turn(9, 0.0F, out.v[axis].data());
    }
    const float* const area = facets.values[12].data() + begin;
    const float* const thickness = facets.values[13].data() + begin;
    const float beams_per_rad = beams_per_rad_;
    const float rows_per_slope = rows_per_slope_;
    const auto beams = static_cast<float>(beams_);
    const auto rows = static_cast<float>(rows_);
    const float columns_per_beam = static_cast<float>(columns_per_beam_);
    for (int k = 0; k < count; ++k) {
        const float x = out.centre[0][k];
        const float y = out.centre[1][k];
        const float z = out.centre[2][k];
        const float rho2 = std::max(x * x + y * y, 1e-8F);
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
        const float beam = beams_per_rad * azimuth_of(x, y) + 0.5F * beams;
        const float row = rows_per_slope * slope + 0.5F * rows;
        const float half_rows = std::fabs(rows_u) + std::fabs(rows_v);
        const float out_of_sight = std::max(std::max(-half_beams - beam, beam - half_beams - beams),
                                            std::max(-half_rows - row, row - half_rows - rows));
        // No azimuth on the sensor's axis.
        out.in_sight[k] = rho2 > 1e-8F ? -out_of_sight : -1.0F;
        out.beams_u[k] = beams_u;
        out.beams_v[k] = beams_v;
        out.rows_u[k] = rows_u;
        out.rows_v[k] = rows_v;
        out.beam[k] = beam;
        out.half_beams[k] = half_beams;
        out.row[k] = row;
        out.turn_u[k] = beams_u / half_beams;
        out.turn_v[k] = beams_v / half_beams;
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
        const float height = std::max(facing * signed_height, 1e-6F);
        const float per_height = 1.0F / height;
        const float depth_row = -nz * per_height / rows_per_slope;
        const float depth_beam = (nx * y - ny * x) * per_rho * per_height / beams_per_rad;
        const float uu =
            out.u[0][k] * out.u[0][k] + out.u[1][k] * out.u[1][k] + out.u[2][k] * out.u[2][k];
        const float vv =
            out.v[0][k] * out.v[0][k] + out.v[1][k] * out.v[1][k] + out.v[2][k] * out.v[2][k];
        const float rectangle = 4.0F * std::sqrt(uu * vv);
        const float grow =
            std::fabs(area[k] - rectangle) < 1e-3F * rectangle ? closing_plain : closing;
        out.closing[k] = grow;
        const float leaf_depth = leaf_m * per_rho2;
        const float cosine = std::max(height * per_rho / std::sqrt(1.0F + slope * slope), 0.1F);
        const float cell_slope = std::fabs(depth_row) + std::fabs(depth_beam) / columns_per_beam;
        out.depth[k] = per_rho;
        out.depth_row[k] = depth_row;
        out.depth_beam[k] = depth_beam;
        out.depth_range[k] =
            grow * per_rho2 * (std::fabs(rho_u) + std::fabs(rho_v)) + 2.0F * leaf_depth;
        out.slack[k] = slack_leaves * leaf_depth + per_rho2 * thickness[k] / cosine +
                       std::min(0.5F * cell_slope, 2.0F * leaf_depth);
    }
}

void AngularCells::see(const Run& run, const Field& field, std::vector<SeenFacet>& seen) {
    const FacetArrays& facets = run.level->facets;
    Lanes lanes;
    for (std::uint32_t begin = run.facets_begin(); begin < run.facets_end();
         begin += Lanes::width) {
        const int count =
            static_cast<int>(std::min<std::uint32_t>(run.facets_end() - begin, Lanes::width));
        project(facets, begin, count, field, run.leaf_m, lanes);
        for (int k = 0; k < count; ++k) {
            if (!(lanes.in_sight[k] > 0.0F)) continue;
            const auto vector = [&](const std::array<Lanes::Lane, 3>& v) {
                return Eigen::Vector3f(v[0][k], v[1][k], v[2][k]);
            };
            const Eigen::Vector3f u = vector(lanes.u);
            const Eigen::Vector3f v = vector(lanes.v);
            const float a = lanes.turn_u[k];
            const float b = lanes.turn_v[k];
            SeenFacet& next = seen.emplace_back();
            next.centre = vector(lanes.centre);
            next.normal = vector(lanes.normal);
            // Mixing conjugate half edges by a rotation leaves the second moments as they are.
            next.edge_u = a * u + b * v;
            next.edge_v = a * v - b * u;
            next.rows_u = a * lanes.rows_u[k] + b * lanes.rows_v[k];
            next.half_rows = std::max(std::fabs(a * lanes.rows_v[k] - b * lanes.rows_u[k]), 1e-4F);
            next.area_m2 = facets.values[12][begin + k];
            next.triangle = facets.triangle[begin + k];
            next.beam = lanes.beam[k];
            next.half_beams = lanes.half_beams[k];
            next.row = lanes.row[k];
            next.depth = lanes.depth[k];
            next.depth_beam = lanes.depth_beam[k];
            next.depth_row = lanes.depth_row[k];
            next.depth_range = lanes.depth_range[k];
            next.slack = lanes.slack[k];
            cover(next, lanes.beams_u[k], lanes.beams_v[k], lanes.rows_u[k], lanes.rows_v[k],
                  lanes.closing[k]);
        }
    }
}

void AngularCells::cover(const SeenFacet& seen, float beams_u, float beams_v, float rows_u,
                         float rows_v, float grow) {
    const auto per_beam = static_cast<float>(columns_per_beam_);
    const float u = per_beam * beams_u;
    const float v = per_beam * beams_v;
    const float reach = grow * (std::fabs(u) + std::fabs(v));
    const float centre = per_beam * seen.beam - 0.5F;
    const int first = std::max(static_cast<int>(std::ceil(centre - reach)), 0);
    const int last = std::min(static_cast<int>(std::floor(centre + reach)), columns_ - 1);
    const float determinant = grow * std::fabs(u * rows_v - v * rows_u);
    const float per_u = 1.0F / divisor(u);
    const float per_v = 1.0F / divisor(v);
    const float wide_u = std::fabs(determinant * per_u);
    const float wide_v = std::fabs(determinant * per_v);
    const float nearest = seen.depth + seen.depth_range;
    const float farthest = seen.depth - seen.depth_range;
    for (int column = first; column <= last; ++column) {
        // Within the parallelogram: both coordinates along its edges within [-1, 1].
        const float d = static_cast<float>(column) - centre;
        const float middle_u = d * rows_u * per_u;
        const float middle_v = d * rows_v * per_v;
        const float low = std::max(middle_u - wide_u, middle_v - wide_v) + seen.row - 0.5F;
        const float high = std::min(middle_u + wide_u, middle_v + wide_v) + seen.row - 0.5F;
        const int begin = static_cast<int>(std::ceil(std::max(low, 0.0F)));
        const int end =
            static_cast<int>(std::floor(std::min(high, static_cast<float>(rows_ - 1)))) + 1;
        float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        const float base =
            seen.depth + seen.depth_beam * d / per_beam + seen.depth_row * (0.5F - seen.row);
        for (int row = begin; row < end; ++row) {
            const float depth =
                std::clamp(base + seen.depth_row * static_cast<float>(row), farthest, nearest);
            cells[row] = std::max(cells[row], depth);
        }
    }
}

void AngularCells::close_holes() {
    std::vector<float> closed = depth_;
    const auto rows = static_cast<std::size_t>(rows_);
    for (std::size_t column = 1; column + 1 < static_cast<std::size_t>(columns_); ++column) {
        const float* const here = depth_.data() + column * rows;
        const float* const left = here - rows;
        const float* const right = here + rows;
        float* const to = closed.data() + column * rows;
        for (std::size_t r = 1; r + 1 < rows; ++r) {
            const float across = std::min(left[r], right[r]);
            const float along = std::min(here[r - 1], here[r + 1]);
            to[r] = std::max(here[r], std::max(across, along));
        }
    }
    depth_ = std::move(closed);
}

void AngularCells::mask_cone(const View& view) {
    const auto cosine = static_cast<float>(sincos(0.5 * view.azimuth_rad).cos);
    for (int column = 0; column < columns_; ++column) {
        const double azimuth = view.azimuth_rad * ((column + 0.5) / columns_ - 0.5);
        const auto x = static_cast<float>(sincos(azimuth).cos);
        float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        for (int row = 0; row < rows_; ++row) {
            const float slope =
                (static_cast<float>(row) + 0.5F - 0.5F * static_cast<float>(rows_)) /
                rows_per_slope_;
            if (x < cosine * std::sqrt(1.0F + slope * slope))
                cells[row] = std::numeric_limits<float>::infinity();
        }
    }
}

/// Whether nothing hides the facet or cuts it off: nearly always so.
bool AngularCells::is_open(const SeenFacet& seen) const {
    const float tall = seen.half_rows + std::fabs(seen.rows_u);
    if (seen.row - tall < 0.0F || seen.row + tall >= static_cast<float>(rows_)) return false;
    const auto per_beam = static_cast<float>(columns_per_beam_);
    const int begin = static_cast<int>(seen.row - tall);
    const int end = static_cast<int>(seen.row + tall) + 1;
    const int columns_begin =
        std::max(static_cast<int>(per_beam * (seen.beam - seen.half_beams)), 0);
    const int columns_end =
        std::min(static_cast<int>(per_beam * (seen.beam + seen.half_beams)) + 1, columns_);
    const float nearest = seen.depth + seen.depth_range + seen.slack;
    const float farthest = seen.depth - seen.depth_range + seen.slack;
    for (int column = columns_begin; column < columns_end; ++column) {
        const float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        const float d = (static_cast<float>(column) + 0.5F) / per_beam - seen.beam;
        const float base =
            seen.depth + seen.depth_beam * d + seen.depth_row * (0.5F - seen.row) + seen.slack;
        for (int r = begin; r < end; ++r) {
            const float depth =
                std::clamp(base + seen.depth_row * static_cast<float>(r), farthest, nearest);
            if (cells[r] > depth) return false;
        }
    }
    return true;
}

bool AngularCells::piece(const SeenFacet& seen, int beam, bool open, SeenPiece& piece) const {
    const auto b = static_cast<float>(beam);
    const float per_half = 1.0F / seen.half_beams;
    const float from = std::max((b - seen.beam) * per_half, -1.0F);
    const float to = std::min((b + 1.0F - seen.beam) * per_half, 1.0F);
    piece.u = 0.5F * (from + to);
    piece.half_u = 0.5F * (to - from);
    if (!(piece.half_u > 1e-4F)) return false;
    if (open) {
        piece.share = piece.half_u;
        piece.v = 0.0F;
        piece.half_v = 1.0F;
        return true;
    }
    const float row = seen.row + piece.u * seen.rows_u;
    const float low = row - seen.half_rows;
    const float high = row + seen.half_rows;
    const int begin = std::max(static_cast<int>(std::floor(low)), 0);
    const int end = std::min(static_cast<int>(std::floor(high)), rows_ - 1) + 1;
    const auto per_beam = static_cast<float>(columns_per_beam_);
    const float left = per_beam * (seen.beam + (piece.u - piece.half_u) * seen.half_beams);
    const float right = per_beam * (seen.beam + (piece.u + piece.half_u) * seen.half_beams);
    const int columns_begin =
        std::max(static_cast<int>(std::floor(left)), beam * columns_per_beam_);
    const int columns_end =
        std::min(static_cast<int>(std::floor(right)) + 1, (beam + 1) * columns_per_beam_);
    const float nearest = seen.depth + seen.depth_range + seen.slack;
    const float farthest = seen.depth - seen.depth_range + seen.slack;
    float sum = 0.0F;
    float moment = 0.0F;
    float least = high;
    float most = low;
    for (int column = columns_begin; column < columns_end; ++column) {
        const float* const cells = depth_.data() + static_cast<std::size_t>(column) * rows_;
        const float wide = std::min(right, static_cast<float>(column + 1)) -
                           std::max(left, static_cast<float>(column));
        const float d = (static_cast<float>(column) + 0.5F) / per_beam - seen.beam;
        const float base =
            seen.depth + seen.depth_beam * d + seen.depth_row * (0.5F - seen.row) + seen.slack;
        for (int r = begin; r < end; ++r) {
            const float depth =
                std::clamp(base + seen.depth_row * static_cast<float>(r), farthest, nearest);
            if (cells[r] > depth) continue;
            const float bottom = std::max(low, static_cast<float>(r));
            const float top = std::min(high, static_cast<float>(r + 1));
            const float weight = wide * (top - bottom);
            sum += weight;
            moment += weight * 0.5F * (bottom + top);
            least = std::min(least, bottom);
            most = std::max(most, top);
        }
    }
    const float whole = (right - left) * (high - low);
    piece.share = piece.half_u * std::min(sum / whole, 1.0F);
    if (!(piece.share > 1e-5F)) return false;
    const float per_rows = 1.0F / seen.half_rows;
    piece.v = (moment / sum - row) * per_rows;
    // The visible rows are one run, or nearly: as long as their number, within what was met.
    piece.half_v = 0.5F * (most - least) * per_rows;
    return true;
}

}  // namespace sonarsim
