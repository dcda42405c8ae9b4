#pragma once

#include <vector>

#include "visibility/octree/projection.h"

namespace sonarsim {

/// The part of a facet that is visible in one beam.
struct VisiblePart {
    float share;   ///< share of the facet's area
    float u;       ///< centre of the part along edge_u, in [-1, 1]
    float half_u;  ///< half the part's length along edge_u
    float v;       ///< the same along edge_v
    float half_v;
};

/// Depth buffer: each pixel holds the depth of the nearest surface at its centre. Draw all facets
/// first, then test them. Facets are parallelograms that approximate polygons and leave gaps
/// between them: a result `hidden` is certain, `visible` is not.
class DepthBuffer {
  public:
    explicit DepthBuffer(const ProjectionGrid& grid);

    /// Draws a facet as an occluder.
    void draw(const ProjectedFacet& facet);

    /// Hides everything outside a cone of this full angle.
    void mask_cone(double opening_rad);

    /// True if nothing hides any part of the facet and no edge of the view clips it.
    bool is_fully_visible(const ProjectedFacet& facet) const;

    enum class Visibility { visible, hidden, too_small };

    /// Finds the part of a facet that is visible in a beam; `clear` is the result of
    /// is_fully_visible(). Sets `part` if the result is `visible`. `too_small`: the part is within
    /// rounding.
    Visibility visible_part(const ProjectedFacet& facet, int beam, bool clear,
                            VisiblePart& part) const;

  private:
    /// The visible rows of a facet in one beam.
    struct VisibleRows {
        float area;          ///< in pixels
        float moment;        ///< integral of the row over the area
        float least, most;   ///< ends of the rows
        float share = 0.0F;  ///< area / area of the facet in the beam
    };
    VisibleRows visible_rows(const ProjectedFacet& facet, int beam, float low, float high) const;

    const float* pixels_of(int column) const {
        return depth_.data() + static_cast<std::size_t>(column) * grid_.rows;
    }
    float* pixels_of(int column) {
        return depth_.data() + static_cast<std::size_t>(column) * grid_.rows;
    }

    ProjectionGrid grid_;
    std::vector<float> depth_;  ///< [columns, rows], 1 / rho in 1/m; 0: empty
};

}  // namespace sonarsim
