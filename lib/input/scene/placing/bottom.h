#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "input/scene/surface.h"

namespace sonarsim {

/// The surface that objects rest on, with a grid over x and y to find triangles. World.
class Bottom {
  public:
    explicit Bottom(Surface surface);

    const Surface& surface() const { return surface_; }
    const Eigen::AlignedBox2d& area() const { return area_; }

    /// The highest surface below a point, or at most `tolerance` above it; nullopt: none.
    std::optional<double> highest_below(const Eigen::Vector3d& point, double tolerance) const;
    /// The highest surface at a point seen from above.
    std::optional<double> highest(const Eigen::Vector2d& point) const {
        return highest_below({point.x(), point.y(), std::numeric_limits<double>::infinity()}, 0.0);
    }

    /// Calls `visit` with the index of every triangle that may meet the box, some more than once.
    void for_each_near(const Eigen::AlignedBox2d& box, const auto& visit) const {
        for_each_cell(box, [&](std::size_t cell) {
            for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k)
                visit(triangles_[k]);
        });
    }

  private:
    void for_each_cell(const Eigen::AlignedBox2d& box, const auto& visit) const {
        const Eigen::Array2i from = cell_of(box.min());
        const Eigen::Array2i to = cell_of(box.max());
        for (int y = from.y(); y <= to.y(); ++y) {
            for (int x = from.x(); x <= to.x(); ++x)
                visit(static_cast<std::size_t>(y) * side_ + x);
        }
    }
    Eigen::Array2i cell_of(const Eigen::Vector2d& point) const;
    /// The number of triangles in all cells of the grid, a triangle once in each of its cells.
    std::uint64_t places_of_triangles() const;

    Surface surface_;
    Eigen::AlignedBox2d area_;
    int side_ = 1;  ///< cells along x and along y
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> triangles_;  ///< the highest first in each cell
    Eigen::Vector3d corner_ = Eigen::Vector3d::Zero();
    /// Box around each triangle, relative to `corner_` and enlarged by more than the rounding of
    /// floats. Most triangles of a cell are skipped after one comparison of boxes.
    std::vector<Eigen::AlignedBox3f> boxes_;
};

/// The height of a triangle's plane at a point within the triangle as seen from above, edges
/// included; nullopt for any other point and for a vertical triangle.
std::optional<double> height_above(const std::array<Eigen::Vector3d, 3>& corners,
                                   const Eigen::Vector2d& point);

}  // namespace sonarsim
