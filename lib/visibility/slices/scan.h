#pragma once

#include <Eigen/Core>
#include <vector>

#include "visibility/view.h"

namespace sonarsim {

// A view is cut by half-planes, the slices. Each lies in a frame of its own sector of the view,
// with the axes forward (X), across (U) and along (W), and is a line u = const of the picture plane
// u = U / X, w = W / X:
//   fan:   W is the sensor's z axis: a slice is an azimuth;
//   cone:  W is the boresight: a slice is an angle around it;
//   sides: U is the sensor's z axis: a slice runs along the fan.

/// An interval: of a line or a triangle over u, or of values of q.
struct Extent {
    float from;
    float to;
};

struct Slice {
    float u;
    float w_low;  ///< where it enters the view, and where it leaves it
    float w_high;
    float w_low_slope;  ///< dw/du of the view's borders there
    float w_high_slope;
};

/// What lies between two neighbouring slices of a frame.
struct Gap {
    int beam;
    float u_low;   ///< where it begins: a hair beside its first slice, see slice_frames()
    float u_high;  ///< where it ends
};

/// The slices of one sector, from low u to high, and the gaps between them.
struct SliceFrame {
    Eigen::Matrix3f R_frame_sensor;
    std::vector<Slice> slices;
    std::vector<Gap> gaps;  ///< one fewer than slices
    float w_low;            ///< the least and the greatest w of all slices and gaps
    float w_high;
    float tan_low;  ///< w of the view's borders at u = 0
    float tan_high;
    /// Whether a line of constant u is a great circle along the view's own lines. Sides: it is not;
    /// a gap's border at w is its u times sqrt(1 + w^2), a line of constant elevation.
    bool meridians;
};

/// The slice of a frame at u.
Slice slice_at(const SliceFrame& frame, float u);

/// Cuts `view` by slices on the borders of the beams and `per_beam` - 1 inside each. Where a beam
/// is wide there are more. Frames are in the order of their beams. Slices lie a hair beside the
/// borders, each by another share of the gap, so that no edge of a scene that is built along the
/// sonar's axes runs along a slice.
std::vector<SliceFrame> slice_frames(const View& view, int per_beam);

}  // namespace sonarsim
