#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "simulate/visibility/engine.h"
#include "simulate/visibility/strips/column_pieces.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// Limits of columns and samples that keep a view's image within its error goal.
struct StripRule {
    float columns;  ///< parts of each least column, if nothing in view is thin
    bool energies_add;
    float bin_m;
    float range_max_m;
    float sag_m;      ///< largest deviation of a sample's range from the linear one
    float wedge_m;    ///< largest difference of the range spans of a sample's sides
    float taper;      ///< largest difference of a sample's widths, over their sum
    float along_rad;  ///< largest angle that a sample spans along its column
};

/// An interval of w on a line u = const, and how its ends move with u.
struct VisibleInterval {
    float low, high;
    float low_slope, high_slope;
};

/// Finds what nearer pieces of the same column leave of a piece.
class PieceVisibility {
  public:
    /// `pieces` must outlive it.
    explicit PieceVisibility(const ColumnPieces& pieces) : pieces_(pieces) {}

    /// Begins with piece `i`. Pieces that may hide some of it are found as needed, and kept.
    void begin(int i);

    /// The visible parts of the piece within `whole`, an interval on the line u. False: none.
    bool find(float u, const VisibleInterval& whole);

    /// The parts that the last find() found, ascending.
    const std::vector<VisibleInterval>& parts() const { return parts_; }

  private:
    /// Pieces of a block, by bits.
    struct Candidate {
        int block;
        unsigned pieces;
    };

    bool find_more();
    template <class Rows>
    unsigned near(const Rows& rows) const;
    bool take_away(const Candidate& candidate);
    bool take(int j, VisibleInterval hidden, float nearer_low, float nearer_high);

    const ColumnPieces& pieces_;
    std::vector<Candidate> candidates_;
    std::vector<VisibleInterval> hidden_, parts_;
    int piece_ = 0;
    std::size_t next_group_ = 0;
    unsigned blocks_left_ = 0;
    float eps_ = 0.0F;
    Floats8 from_, to_, w_min_, w_max_, q_min_;
    // The line.
    float u_ = 0.0F;
    float q_0_ = 0.0F;  ///< q of the piece's plane at w = 0
    float q_w_ = 0.0F;
    VisibleInterval rest_{};
};

/// A visible part of a piece between two u.
struct Strip {
    const StripTriangle& triangle;
    int piece;
    float from, middle, to;   ///< u
    VisibleInterval visible;  ///< at the middle
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
    void add_quad(const StripTriangle& triangle, const Quad& quad);
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
