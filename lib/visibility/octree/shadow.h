#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "visibility/engine.h"
#include "visibility/octree/leaf.h"
#include "visibility/octree/search.h"

namespace sonarsim {

/// A facet as the sonar sees it. Azimuth is counted in beams, elevation in rows of cells: row =
/// (z / rho + tan(elevation / 2)) / row height, where rho is the distance from the sensor's z axis.
/// On a plane, 1 / rho is linear in z / rho along an azimuth: that is the depth that cells hold.
struct SeenFacet {
    Eigen::Vector3f centre;  ///< sensor frame
    Eigen::Vector3f normal;  ///< towards the sonar
    Eigen::Vector3f edge_u;  ///< half edges of the footprint; edge_v has no extent in azimuth
    Eigen::Vector3f edge_v;
    float area_m2;
    std::uint32_t triangle;
    float beam;         ///< of the centre
    float half_beams;   ///< along edge_u
    float row;          ///< of the centre
    float rows_u;       ///< along edge_u
    float half_rows;    ///< along edge_v
    float depth;        ///< 1 / rho of the centre
    float depth_beam;   ///< its derivative by beam
    float depth_row;    ///< its derivative by row
    float depth_range;  ///< by how much the depth of the facet may differ from the centre's
    float slack;        ///< what is nearer by less does not hide the facet
};

/// The part of a facet that one beam sees.
struct SeenPiece {
    float share;   ///< of the facet's area
    float u;       ///< centre of the piece along edge_u, in [-1, 1]
    float half_u;  ///< half its length
    float v;       ///< and along edge_v
    float half_v;
};

/// The angular cells of a ping: the beams, each in some columns, times rows in elevation. Each cell
/// knows the nearest surface at its centre.
class AngularCells {
  public:
    AngularCells(const View& view, float cell_rad);

    /// Projects the facets of a run, enters them into the cells and appends those that are not
    /// out of sight to `seen`. Returns how many are left out although the view reaches them: their
    /// centre lies on the sensor's z axis to within rounding, where no azimuth can be told.
    int see(const Run& run, const Field& field, std::vector<SeenFacet>& seen);

    /// Once all is seen: a cell takes the depth of its two neighbours to either side where both are
    /// nearer. Footprints leave no larger holes in a surface.
    void close_holes();

    /// After that, for a cone: closes the cells outside it.
    void mask_cone(const View& view);

    /// Calls `put(beam, piece)` for each beam that sees a part of the facet. All facets must have
    /// been seen. Returns how many parts are left out that a beam does see: they are too small to
    /// be told from rounding.
    template <class Put>
    int pieces(const SeenFacet& seen, Put put) const;

  private:
    struct Lanes;
    enum class Part { seen, unseen, too_small };

    void project(const FacetArrays& facets, std::uint32_t begin, int count, const Field& field,
                 float leaf_m, Lanes& lanes) const;
    void cover(const SeenFacet& seen, float beams_u, float beams_v, float rows_u, float rows_v,
               float grow);
    bool is_lost_on_axis(const Lanes& lanes, int lane) const;
    bool is_open(const SeenFacet& seen) const;
    Part piece(const SeenFacet& seen, int beam, bool open, SeenPiece& piece) const;

    int beams_;
    int columns_per_beam_;
    int columns_;
    int rows_;
    float beams_per_rad_;
    float turn_beams_;  ///< beams that a full turn would have
    float rows_per_slope_;
    float least_rho2_;          ///< nearer to the sensor's z axis there is no azimuth, m^2
    float least_height_;        ///< of the sensor above a plane, as a divisor, m
    std::vector<float> depth_;  ///< [columns, rows]; 0: nothing
};

template <class Put>
int AngularCells::pieces(const SeenFacet& seen, Put put) const {
    const auto most = static_cast<float>(beams_ - 1);
    const int first = static_cast<int>(std::clamp(seen.beam - seen.half_beams, 0.0F, most));
    const int last = static_cast<int>(std::clamp(seen.beam + seen.half_beams, 0.0F, most));
    const bool open = is_open(seen);
    SeenPiece part;
    int too_small = 0;
    for (int beam = first; beam <= last; ++beam) {
        const Part found = piece(seen, beam, open, part);
        if (found == Part::seen) put(beam, part);
        too_small += found == Part::too_small;
    }
    return too_small;
}

}  // namespace sonarsim
