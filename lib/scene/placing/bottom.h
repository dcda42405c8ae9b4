#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/surface.h"

namespace sonarsim {

/// The surface that objects rest on, with a grid over x and y that finds its triangles. World
/// frame.
class Bottom {
  public:
    explicit Bottom(Surface surface);

    const Surface& surface() const { return surface_; }
    const Eigen::AlignedBox2d& area() const { return area_; }

    /// Heights of the lowest and the highest surface at a point; nothing where there is none.
    struct Heights {
        double lowest;
        double highest;
    };
    std::optional<Heights> heights(const Eigen::Vector2d& point) const;

    /// The highest of the surfaces at the x and y of a point that lie below it, or at most
    /// `tolerance` above it; nothing where there is none.
    std::optional<double> highest_below(const Eigen::Vector3d& point, double tolerance) const;

    /// Calls `visit` with the index of every triangle that may meet the box, some more than once.
    template <class Visit>
    void for_each_near(const Eigen::AlignedBox2d& box, const Visit& visit) const {
        const Eigen::Array2i from = cell_of(box.min());
        const Eigen::Array2i to = cell_of(box.max());
        for (int y = from.y(); y <= to.y(); ++y) {
            for (int x = from.x(); x <= to.x(); ++x) {
                const auto cell = static_cast<std::size_t>(y) * side_ + x;
                for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k)
                    visit(triangles_[k]);
            }
        }
    }

  private:
    Eigen::Array2i cell_of(const Eigen::Vector2d& point) const;

    Surface surface_;
    Eigen::AlignedBox2d area_;
    int side_ = 1;  ///< cells along x and along y
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> triangles_;
};

/// The height of a triangle's plane above a point that lies within the triangle, seen from above,
/// edges included; nothing for any other point and for an upright triangle.
std::optional<double> height_above(const std::array<Eigen::Vector3d, 3>& corners,
                                   const Eigen::Vector2d& point);

}  // namespace sonarsim
