#pragma once

#include <vector>

#include "visibility/octree/projection.h"

namespace sonarsim {

/// The part of a facet that one beam sees.
struct VisiblePart {
    float share;   ///< of the facet's area
    float u;       ///< centre of the part along edge_u, in [-1, 1]
    float half_u;  ///< half its length
    float v;       ///< and along edge_v
    float half_v;
};

/// Tells hidden surface from visible surface: each pixel knows the nearest surface at its centre.
/// First all facets are drawn, then facets are asked for. Facets are parallelograms in place of
/// polygons and leave gaps between them: what is hidden here is hidden, what is visible may not be.
class DepthBuffer {
  public:
    explicit DepthBuffer(const ProjectionGrid& grid);

    /// Enters a facet as what may hide others.
    void draw(const ProjectedFacet& facet, const Outline& outline);

    /// Hides all that lies outside a cone of this full angle.
    void mask_cone(double opening_rad);

    /// Whether nothing hides any part of the facet and no edge of the view cuts it off.
    bool is_clear(const ProjectedFacet& facet) const;

    enum class Visibility { visible, hidden, too_small };

    /// The part that a beam sees of a facet; `clear` is what is_clear() said. `part` is set when
    /// the answer is `visible`. `too_small`: a part that cannot be told from rounding.
    Visibility visible_part(const ProjectedFacet& facet, int beam, bool clear,
                            VisiblePart& part) const;

  private:
    const float* pixels_of(int column) const {
        return depth_.data() + static_cast<std::size_t>(column) * grid_.rows;
    }
    float* pixels_of(int column) {
        return depth_.data() + static_cast<std::size_t>(column) * grid_.rows;
    }

    ProjectionGrid grid_;
    std::vector<float> depth_;  ///< [columns, rows], 1 / rho in 1/m; 0: nothing
};

}  // namespace sonarsim
