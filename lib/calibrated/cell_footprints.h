#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "calibrated/scatterers.h"
#include "visibility/engine.h"

namespace sonarsim {

/// Samples among the cells at their ranges, each seen along the axis of the world that it faces
/// most: parallelograms in the plane of the other two axes. Between the ranges at which one level
/// or the next is right, part of the larger cells hold a scatterer each and the others are split
/// into four. Lengths are in edges of the smaller cells, from a corner near the sample, so that
/// floats hold them. Arrays, so that loops vectorise.
struct CellFootprints {
    static constexpr int most = 32;
    template <class T>
    using Array = std::array<T, most>;

    int count = 0;
    Array<std::int32_t> axis;        ///< the first and the second are the next two, in turn
    Array<std::int32_t> level;       ///< of the smaller cells
    Array<float> fine_m;             ///< their edge
    Array<float> whole;              ///< share of the larger ones that are not split
    Array<float> area_by_projected;  ///< of the sample, by that of its projection
    Array<std::int32_t> base_first;  ///< the corner: numbers of smaller cells, multiples of 8
    Array<std::int32_t> base_second, base_axis;
    Array<float> first, second;       ///< the centre
    Array<float> height;              ///< of the centre, along the axis
    Array<float> height_u, height_v;  ///< by how much half an edge rises along the axis
    Array<float> s_x, s_y, t_x, t_y;  ///< from a place off the centre to shares of the half edges

    // The larger cells that a footprint may lie on, numbered from the base, row by row; none where
    // it has no area. Rows lie side by side along the axis on which it reaches further. Places in
    // them are those of a strip about a line: row n reaches from left + slope n on for `width`, but
    // not beyond the sides of the footprint.
    Array<std::int32_t> rows_along_first;  ///< 1 where rows lie side by side along the first axis
    Array<std::int32_t> row_begin, row_end;
    Array<float> left, slope, width;
    Array<float> least, greatest;
};

/// Of up to `most` samples.
void find_footprints(std::span<const Sample> samples, const ScattererCells& cells,
                     const SonarInScene& sonar, CellFootprints& out);

}  // namespace sonarsim
