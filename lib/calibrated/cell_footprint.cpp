#include "calibrated/cell_footprint.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sonarsim {

namespace {

// Head-on a resolution cell has no end on the surface: its length is taken to be this many times
// that of the pulse at the most. With more, objects of a few centimetres would hold few scatterers.
constexpr float longest_on_surface = 2.0F;

/// The edge that cells should have where a surface is seen from a range at a grazing angle of
/// `sine`, squared. A resolution cell is longer on the surface than in range by one over the cosine
/// of that angle, and cells are larger by as much.
float wanted_edge2(const ScattererCells& cells, float range, float sine) {
    const float cosine2 = 1.0F - sine * sine;
    const float longer2 =
        std::min(1.0F / std::max(cosine2, 1e-6F), longest_on_surface * longest_on_surface);
    const float grazing2 = cells.edge_per_root_range * cells.edge_per_root_range * range;
    const float depth2 = cells.greatest_depth_m * cells.greatest_depth_m;
    const float width = cells.width_rad * range;
    // No wider than a beam where it is length that makes them larger.
    return std::min({grazing2 * std::sqrt(longer2), depth2 * longer2,
                     std::max(std::min(grazing2, depth2), width * width)});
}

/// The level of the smaller cells, and the share of the larger ones that are not split, so that
/// there are as many scatterers to an area as cells of `edge2` would hold: of a larger cell's area,
/// 4 in units of the smaller cells, 1 / 4 w + (1 - w) scatterers to each are 1 / edge2.
struct LevelShare {
    int level;
    float whole;
};

LevelShare level_share(const ScattererCells& cells, float edge2) {
    const float ratio = std::max(edge2 / (cells.least_edge_m * cells.least_edge_m), 1.0F);
    // The exponent of the ratio of areas is twice that of the edges.
    const int level = (static_cast<int>(std::bit_cast<std::uint32_t>(ratio) >> 23) - 127) / 2;
    if (level >= cells.levels - 1) return {cells.levels - 1, 0.0F};
    const auto fine = static_cast<float>(1 << (2 * level));
    return {level, (4.0F / 3.0F) * (1.0F - fine / ratio)};
}

}  // namespace

bool CellFootprint::has_area() const {
    return std::isfinite(s_x + s_y + t_x + t_y);
}

float CellFootprint::reach(int along) const {
    return std::fabs(u[along]) + std::fabs(v[along]);
}

CellFootprint footprint_of(const Sample& sample, const ScattererCells& cells,
                           const SonarInScene& sonar) {
    const Eigen::Vector3f u = sonar.R_world_sensor * sample.edge_u;
    const Eigen::Vector3f v = sonar.R_world_sensor * sample.edge_v;
    const Eigen::Vector3f normal = u.cross(v);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const float range = sample.position.norm();
    const float sine = std::min(sample.height_m / range, 1.0F);
    const auto [level, whole] = level_share(cells, wanted_edge2(cells, range, sine));
    CellFootprint out;
    out.axis = axis;
    out.first = (axis + 1) % 3;
    out.second = (axis + 2) % 3;
    out.fine_m = cells.edge_of(level);
    out.area_by_projected = sample.area_m2 / (4.0F * std::fabs(normal[axis]));
    out.level = static_cast<std::uint32_t>(level);
    out.whole_cells = whole;
    const double per_edge = 1.0 / out.fine_m;
    const Eigen::Vector3d place =
        sonar.sensor + (sonar.R_world_sensor * sample.position).cast<double>();
    for (int k = 0; k < 3; ++k) {
        const double at = place[k] * per_edge;
        out.base[k] = 8 * static_cast<std::int32_t>(std::floor(0.125 * at));
        out.centre[k] = static_cast<float>(at - out.base[k]);
    }
    const auto per_edge_float = static_cast<float>(per_edge);
    out.u = per_edge_float * u;
    out.v = per_edge_float * v;
    const float per_area =
        1.0F / (out.u[out.first] * out.v[out.second] - out.u[out.second] * out.v[out.first]);
    out.s_x = out.v[out.second] * per_area;
    out.s_y = -out.v[out.first] * per_area;
    out.t_x = -out.u[out.second] * per_area;
    out.t_y = out.u[out.first] * per_area;
    return out;
}

CellRows::CellRows(const CellFootprint& p) {
    const bool along_first = p.reach(p.first) >= p.reach(p.second);
    inner = along_first ? p.first : p.second;
    outer = along_first ? p.second : p.first;
    const auto larger_cell = [](float at) {
        return static_cast<std::int32_t>(std::floor(0.5F * at));
    };
    first = larger_cell(p.centre[outer] - p.reach(outer));
    last = larger_cell(p.centre[outer] + p.reach(outer));
    start_ = larger_cell(p.centre[inner] - p.reach(inner));
    length_ = static_cast<double>(larger_cell(p.centre[inner] + p.reach(inner)) - start_);
    // About a line along the edge that goes further along `outer`: by not 0 while there is any
    // area. In double, as it may go along `inner` a million times as far.
    const bool by_u = std::fabs(p.u[outer]) >= std::fabs(p.v[outer]);
    const Eigen::Vector3f& edge = by_u ? p.u : p.v;
    const Eigen::Vector3f& other = by_u ? p.v : p.u;
    slope_ = static_cast<double>(edge[inner]) / edge[outer];
    constexpr double rounding = 2e-3;
    const double beside = std::fabs(other[inner] - slope_ * other[outer]) + rounding;
    const double to_lower_border = slope_ * (2.0 * first - p.centre[outer]);
    left_ =
        0.5 * (p.centre[inner] + to_lower_border + std::min(0.0, 2.0 * slope_) - beside) - start_;
    width_ = std::fabs(slope_) + beside;
}

}  // namespace sonarsim
