#include "simulate/product/bathymetry.h"

#include <cmath>
#include <iterator>
#include <limits>

#include "core/text.h"

namespace sonarsim {

namespace {

constexpr double soundings_per_cell = 4.0;
constexpr double finest_cell_m = 1e-6;  // the limit of range bins

constexpr double max_map_cells = 1 << 24;

constexpr int map_px = 900;       // longer side of a map of few cells
constexpr int max_map_px = 4000;  // longer side of a map of many cells
constexpr int margin = 10;
constexpr int legend_width = 80;
constexpr int bar_height = 30;

// The colours of depths, the deepest first.
constexpr Rgb depth_colours[] = {{58, 30, 110},  {40, 80, 160},  {30, 135, 165}, {50, 175, 130},
                                 {150, 205, 85}, {235, 220, 90}, {230, 140, 60}, {190, 60, 50}};

struct HeightRange {
    float low;
    float high;
};

/// The range of heights without the lowest and the highest hundredth of cells, so that outliers do
/// not wash out the colours. At least a millimetre wide, and at least eight steps of float.
HeightRange height_range(const std::vector<float>& z) {
    std::vector<float> known;
    std::ranges::copy_if(z, std::back_inserter(known), [](float v) { return !std::isnan(v); });
    if (known.empty()) return {0.0F, 1.0F};
    std::ranges::sort(known);
    const std::size_t skip = known.size() / 100;
    const float low = known[skip];
    const float min_span = std::max(1e-3F, 1e-6F * std::fabs(low));
    return {low, std::max(known[known.size() - 1 - skip], low + min_span)};
}

struct Slope {
    float east;
    float north;
};

/// The slope at a cell, from its known neighbours.
Slope slope_at(const GroundGrid& grid, const std::vector<float>& z, int row, int column) {
    const float here = z[static_cast<std::size_t>(row) * grid.columns + column];
    const auto at = [&](int r, int c) {
        const bool inside = r >= 0 && r < grid.rows && c >= 0 && c < grid.columns;
        const float there = inside ? z[static_cast<std::size_t>(r) * grid.columns + c] : here;
        return std::isnan(there) ? here : there;
    };
    const float run = 2.0F * static_cast<float>(grid.cell_m);
    return {(at(row, column + 1) - at(row, column - 1)) / run,
            (at(row - 1, column) - at(row + 1, column)) / run};
}

/// The vertical exaggeration of the shading, so that the RMS slope looks like 20 degrees.
float stretch(const GroundGrid& grid, const std::vector<float>& z) {
    constexpr double typical = 0.36;
    double square = 0.0;
    double known = 0.0;
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            const Slope slope = slope_at(grid, z, row, column);
            const float s = slope.east * slope.east + slope.north * slope.north;
            if (std::isnan(s)) continue;
            square += s;
            ++known;
        }
    }
    if (!(square > 0.0)) return 1.0F;
    return static_cast<float>(std::max(1.0, typical / std::sqrt(square / known)));
}

/// Brightness of a slope under light from the north-west, 45 degrees up; 1 for level ground.
float relief(const Slope& slope, float stretched) {
    const float east = stretched * slope.east;
    const float north = stretched * slope.north;
    // The unit vector to the light is (-1/2, 1/2, sqrt(1/2)); the normal (-east, -north, 1) / norm.
    const float shade = 1.0F + 0.70710678F * (east - north);
    return std::clamp(shade / std::sqrt(1.0F + east * east + north * north), 0.25F, 1.6F);
}

Rgb scaled(Rgb colour, float by) {
    const auto one = [&](std::uint8_t c) {
        return static_cast<std::uint8_t>(std::min(255.0F, static_cast<float>(c) * by + 0.5F));
    };
    return {one(colour.r), one(colour.g), one(colour.b)};
}

void draw_scale_bar(Picture& picture, int y, double pixels_per_m) {
    // The largest of 1, 2, 5, 10, ... metres that fits a third of the map.
    const double room_m = (picture.width - legend_width) / (3.0 * pixels_per_m);
    const double length = round_down_125(room_m);
    const int width = std::max(1, static_cast<int>(std::lround(length * pixels_per_m)));
    fill(picture, margin, y + 4, width, 3, ink);
    fill(picture, margin, y, 1, 11, ink);
    fill(picture, margin + width - 1, y, 1, 11, ink);
    write(picture, margin + width + 8, y + 2, number_text(length) + " m", Align::left, ink);
}

void draw_legend(Picture& picture, int left, int height, HeightRange range) {
    for (int y = 0; y < height; ++y) {
        const float share = 1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(height);
        fill(picture, left, margin + y, 12, 1, blend(depth_colours, share));
    }
    for (const double z : axis_marks(range.low, range.high, 5.0)) {
        const double share = (range.high - z) / (range.high - range.low);
        const int y = margin + static_cast<int>(share * (height - 1));
        fill(picture, left + 12, y, 4, 1, ink);
        write(picture, left + 19, y - 3, number_text(z) + " m", Align::left, ink);
    }
}

}  // namespace

void GroundGrid::add(const Eigen::Vector3d& point, double more_weight) {
    const double column = std::floor(point.x() / cell_m) - first_column;
    const double row = first_row - std::floor(point.y() / cell_m);
    if (!(column >= 0.0 && column < columns && row >= 0.0 && row < rows)) return;
    const std::size_t cell =
        static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
    weight[cell] += more_weight;
    sum[cell] += more_weight * point.z();
}

std::vector<float> GroundGrid::mean() const {
    std::vector<float> means(sum.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t k = 0; k < sum.size(); ++k) {
        if (weight[k] > 0.0) means[k] = static_cast<float>(sum[k] / weight[k]);
    }
    return means;
}

GroundGrid make_ground_grid(const GroundBounds& bounds, double cell_m) {
    GroundGrid grid;
    if (bounds.count == 0) return grid;
    const Eigen::Vector2d size = bounds.box.sizes();
    const double area = std::max(size.x(), 1e-3) * std::max(size.y(), 1e-3);
    const double wanted = soundings_per_cell * area / static_cast<double>(bounds.count);
    grid.cell_m = std::max(cell_m > 0.0 ? cell_m : round_up_125(std::sqrt(wanted)), finest_cell_m);
    // The grid begins at a multiple of the cell size, which may add a cell on either side.
    while ((size.x() / grid.cell_m + 2.0) * (size.y() / grid.cell_m + 2.0) > max_map_cells)
        grid.cell_m = round_up_125(1.001 * grid.cell_m);
    grid.first_column = std::floor(bounds.box.min().x() / grid.cell_m);
    grid.first_row = std::floor(bounds.box.max().y() / grid.cell_m);
    grid.west_m = grid.first_column * grid.cell_m;
    grid.north_m = (grid.first_row + 1.0) * grid.cell_m;
    const double last_column = std::floor(bounds.box.max().x() / grid.cell_m);
    const double last_row = std::floor(bounds.box.min().y() / grid.cell_m);
    grid.columns = static_cast<int>(last_column - grid.first_column) + 1;
    grid.rows = static_cast<int>(grid.first_row - last_row) + 1;
    grid.sum.assign(static_cast<std::size_t>(grid.columns) * grid.rows, 0.0);
    grid.weight.assign(grid.sum.size(), 0.0);
    return grid;
}

std::int64_t filled_cells(const GroundGrid& grid) {
    return std::ranges::count_if(grid.weight, [](double weight) { return weight > 0.0; });
}

double cell_of_soundings(const GroundGrid& grid, std::uint64_t count) {
    const double wanted =
        soundings_per_cell * static_cast<double>(filled_cells(grid)) / static_cast<double>(count);
    return std::max(round_up_125(grid.cell_m * std::sqrt(wanted)), finest_cell_m);
}

Picture draw_bathymetry(const GroundGrid& grid) {
    const std::vector<float> z = grid.mean();
    const HeightRange range = height_range(z);
    const float stretched = stretch(grid, z);
    const int longer = std::max({grid.columns, grid.rows, 1});
    const int zoom = std::max(1, map_px / longer);            // pixels per cell
    const int step = (longer + max_map_px - 1) / max_map_px;  // cells per pixel
    const int width = (grid.columns + step - 1) / step * zoom;
    const int height = (grid.rows + step - 1) / step * zoom;
    Picture picture(std::max(width, 200) + 2 * margin + legend_width,
                    std::max(height, 100) + 2 * margin + bar_height, backdrop);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int row = y / zoom * step;
            const int column = x / zoom * step;
            const float here = z[static_cast<std::size_t>(row) * grid.columns + column];
            if (std::isnan(here)) continue;
            const float share = (here - range.low) / (range.high - range.low);
            picture.row(margin + y)[margin + x] = scaled(
                blend(depth_colours, share), relief(slope_at(grid, z, row, column), stretched));
        }
    }
    if (grid.cell_m > 0.0) {
        draw_scale_bar(picture, picture.height - bar_height, zoom / (step * grid.cell_m));
        draw_legend(picture, picture.width - legend_width, std::max(height, 100), range);
    }
    return picture;
}

}  // namespace sonarsim
