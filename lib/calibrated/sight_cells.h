#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "calibrated/array_beams.h"
#include "calibrated/sonar_equation.h"
#include "calibrated/transducer_beams.h"
#include "visibility/view.h"

namespace sonarsim {

/// Places in the sensor frame, in arrays so that loops vectorise. `most` is a multiple of the lanes
/// of a vector: places after `count` are computed, too.
struct SightPlaces {
    static constexpr int most = 256;

    int count = 0;
    std::array<float, most> x{}, y{}, z{};
    std::array<float, most> range_m{};
    std::array<std::int32_t, most> cell{};  ///< number among SightCells; -1 beyond them
};

/// The directions that a sonar sees, in cells of equal solid angle: by the sine of the angle to the
/// plane across an axis of the sensor frame and by the turn about that axis (the area of a sphere
/// between two parallels is 2 pi times the difference of their sines). The axis is that of
/// symmetry: y for the cones of a line array and for a turning head, z for a side-scan sonar, x for
/// a disc.
struct SightCells {
    int axis = 1;
    float first_sine = 0.0F, sine_step = 1.0F;
    float first_turn_rad = 0.0F, turn_step_rad = 1.0F;
    int sines = 0, turns = 0;
    std::vector<Eigen::Vector3f> direction;  ///< [sines, turns] of the middles, sensor frame
    std::vector<float> visible_sr;           ///< [sines, turns] the part within the view

    int count() const { return sines * turns; }
    float middle_sine(int s) const {
        return first_sine + (static_cast<float>(s) + 0.5F) * sine_step;
    }
    /// The number of pieces, at most 64, into which an edge is cut so that none is longer than a
    /// cell. The middle of the edge lies at `range_m` in the direction `towards`.
    int spanned(const Eigen::Vector3f& half_edge, const Eigen::Vector3f& towards,
                float range_m) const;
    /// Fills the ranges and the cells of places.
    void find(SightPlaces& places) const;
};

/// The power that a channel receives from the water of a cell: the two-way pattern times the solid
/// angle. A channel is a beam of a transducer or, for a line array, the cells of one sine; the
/// weight is then per unit of sine.
struct CellWeight {
    int channel, cell;
    float weight;
};

struct WeightedCells {
    SightCells cells;
    std::vector<CellWeight> weights;
    int channels = 0;
};

/// The view is that in which surface is traced, with its guard beams. The pattern of a side-scan
/// sonar along the track, which depends on range, is left out of the weights.
WeightedCells weighted_cells(const ArrayBeams& beams, const View& view,
                             const ElevationPattern& elevation);
WeightedCells weighted_cells(const TransducerBeams& beams, const View& view,
                             const ElevationPattern& elevation);

}  // namespace sonarsim
