#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "simulate/visibility/engine.h"
#include "simulate/visibility/strips/column_pieces.h"
#include "simulate/visibility/strips/piece_visibility.h"
#include "simulate/visibility/strips/strip_rule.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// A visible part of a piece between two u.
struct Strip {
    const StripTriangle& triangle;
    int piece;
    float from, middle, to;   ///< u
    VisibleInterval visible;  ///< at the middle
    /// For small pieces: the area of the part; its borders are lines. 0: from the corners.
    float area_m2 = 0.0F;
    bool small = false;
};

/// Converts strips to the samples of a beam.
class StripSamples {
  public:
    /// All arguments must outlive it.
    StripSamples(const ClustersInView& clusters, const ColumnFrame& frame, const StripRule& rule,
                 const ColumnPieces& pieces, std::vector<Sample>& out);

    void add(const Strip& strip);

  private:
    /// Corners of a quadrilateral; `low` and `high` in w, `near` and `far` in u.
    struct Quad {
        Eigen::Vector3f near_low, near_high, far_low, far_high;
        float area_m2;
    };
    /// The ranges of its corners.
    struct Ranges {
        float near_low, near_high, far_low, far_high;
    };

    std::pair<float, float> ends(const Strip& strip) const;
    Eigen::Vector3f point(const Strip& strip, float u, float w) const;
    static float distance_bound(const Quad& quad);
    void add_quad(const StripTriangle& triangle, const Quad& quad, bool small);
    int parts_across(const Quad& quad, const Ranges& range) const;
    int parts_along(const Quad& quad, float& low_width, float& high_width) const;
    Quad within_range(const Quad& quad) const;
    void cut_along(const StripTriangle& triangle, const Quad& whole, bool one_part);

    const ClustersInView& clusters_;
    const ColumnFrame& frame_;
    const StripRule& rule_;
    const ColumnPieces& pieces_;
    const Eigen::Matrix3f R_sensor_frame_, R_sensor_local_;
    std::vector<Sample>& out_;
};

}  // namespace sonarsim
