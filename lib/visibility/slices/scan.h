#pragma once

#include <Eigen/Core>
#include <array>
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

/// The part of a slice's surroundings that it stands for within one beam.
struct Strip {
    int beam;
    float u_low;
    float u_high;
};

struct Slice {
    float u;
    float w_low;  ///< where it enters the view, and where it leaves it
    float w_high;
    float w_low_slope;  ///< dw/du of the view's borders there
    float w_high_slope;
    int strips;  ///< 2 on the border of two beams
    std::array<Strip, 2> strip;
    bool extra = false;  ///< shows only the pieces of the scene that no other slice meets
};

/// The slices of one sector, from low u to high.
struct SliceFrame {
    Eigen::Matrix3f R_frame_sensor;
    std::vector<Slice> slices;
    float w_low;  ///< the least and the greatest w of all slices and strips
    float w_high;
    /// Sides: a strip's border at w is its u times sqrt(1 + w^2), a line of constant elevation.
    bool widens = false;
};

/// Cuts `view` by slices on the borders of the beams and `per_beam` - 1 inside each. Where a beam
/// is wide there are more. Frames are in the order of their beams.
std::vector<SliceFrame> slice_frames(const View& view, int per_beam);

}  // namespace sonarsim
