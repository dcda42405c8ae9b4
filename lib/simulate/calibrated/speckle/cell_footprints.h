#pragma once

#include "simulate/calibrated/speckle/scatterers.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The footprints of samples on the lattice of cells. A footprint is a sample projected along the
/// axis of the world that it faces most: a parallelogram in the plane of the other two, called the
/// first and the second axis. The drawing in docs/calibrated.md, section 2, shows it. Between the
/// ranges of two levels of cells, some of the larger cells hold one scatterer each, and the others
/// are split into four. Lengths are in edges of the smaller cells, from a corner of the lattice
/// near the sample (the base), so that floats hold them. Arrays, so that loops vectorise.
struct CellFootprints {
    static constexpr int capacity = 32;
    template <class T>
    using Array = std::array<T, capacity>;

    int count = 0;
    Array<std::int32_t> axis;        ///< projected along; the first and second axes follow in turn
    Array<std::int32_t> level;       ///< level of the smaller cells
    Array<float> fine_m;             ///< edge of the smaller cells
    Array<float> unsplit_share;      ///< share of the larger cells that are not split
    Array<float> area_by_projected;  ///< area times strength of the sample / its footprint's area
    Array<std::int32_t> base_first;  ///< the base: numbers of smaller cells, multiples of 8
    Array<std::int32_t> base_second, base_axis;
    Array<float> first, second;       ///< the footprint's centre
    Array<float> height;              ///< the sample's centre along the axis
    Array<float> height_u, height_v;  ///< rise of each half edge along the axis
    Array<float> s_x, s_y, t_x, t_y;  ///< matrix from an offset off the centre to half edges
    Array<float> taper_u, taper_v;    ///< Taper: the footprint is a trapezoid

    // The rows of larger cells under the footprint, counted from the base; none if it has no area.
    // Rows lie side by side along the axis on which the footprint reaches further. Row n holds the
    // cells from left + slope n on for `width`, but none beyond `least` and `greatest`.
    Array<std::int32_t> rows_along_first;  ///< 1: rows lie side by side along the first axis
    Array<std::int32_t> row_begin, row_end;
    Array<float> left, slope, width;
    Array<float> min_inner, max_inner;
};

/// Finds the footprints of up to `most` samples in a view of this shape.
void find_footprints(std::span<const Sample> samples, ViewShape shape, const ScattererCells& cells,
                     const SonarInScene& sonar, CellFootprints& out);

}  // namespace sonarsim
