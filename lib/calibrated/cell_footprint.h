#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>

#include "calibrated/scatterers.h"
#include "visibility/engine.h"

namespace sonarsim {

/// A sample among the cells at its range, seen along an axis of the world: a parallelogram in the
/// plane of the other two. Between the ranges at which one level or the next is right, part of the
/// larger cells hold a scatterer each and the others are split into four. Lengths are in edges of
/// the smaller cells, from a corner near the sample, so that floats hold them.
struct CellFootprint {
    int axis, first, second;           ///< the axis, and the other two
    std::array<std::int32_t, 3> base;  ///< the corner: numbers of smaller cells, multiples of 8
    Eigen::Vector3f centre, u, v;      ///< of the parallelogram, and half its edges
    float s_x, s_y, t_x, t_y;          ///< from a place off the centre to shares of u and v
    float fine_m;                      ///< edge of the smaller cells
    float area_by_projected;           ///< of the sample, by that of its projection
    std::uint32_t level;               ///< of the smaller cells
    float whole_cells;                 ///< share of the larger ones that are not split

    /// Whether there is any area in it.
    bool has_area() const;
    /// How far the parallelogram reaches from its centre.
    float reach(int along) const;
};

CellFootprint footprint_of(const Sample& sample, const ScattererCells& cells,
                           const SonarInScene& sonar);

/// The larger cells that a footprint may lie on, row by row. Rows run along the axis on which it
/// reaches further, so that there are few of them.
class CellRows {
  public:
    explicit CellRows(const CellFootprint& p);

    int inner, outer;          ///< the axis along the rows, and the other
    std::int32_t first, last;  ///< rows: numbers of larger cells from the base, along `outer`

    struct Row {
        std::int32_t first, last;  ///< likewise, along `inner`
    };
    Row row(std::int32_t number) const {
        // Numbers from `start_` on are not negative, and conversion rounds them down. In this order
        // what is no number becomes an end of the row.
        const double left = left_ + slope_ * (number - first);
        const double right = left + width_;
        return {start_ + static_cast<std::int32_t>(std::min(length_, std::max(0.0, left))),
                start_ + static_cast<std::int32_t>(std::max(0.0, std::min(length_, right)))};
    }

  private:
    // Places along `inner` are those of a strip about a line, which leaves out the strip's ends.
    double left_, slope_, width_;
    std::int32_t start_;
    double length_;
};

}  // namespace sonarsim
