#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulate/visibility/view.h"

namespace sonarsim {

// A view is cut by half-planes, the slices. Each lies in a frame of its own sector of the view,
// with the axes forward (X), across (U) and along (W), and is a line u = const of the picture plane
// u = U / X, w = W / X:
//   fan:   W is the sensor's z axis: a slice is an azimuth;
//   cone:  W is the boresight: a slice is an angle around it;
//   sides: U is the sensor's z axis: a slice runs along the fan.

/// An interval of u, of q or of range.
struct Interval {
    float from;
    float to;
};

/// An end of an interval without end.
inline constexpr float unbounded = std::numeric_limits<float>::infinity();

struct Slice {
    float u;
    float w_low;  ///< w at which it enters the view; it leaves at w_high
    float w_high;
    float w_low_slope;  ///< dw/du of the view's borders there
    float w_high_slope;
    /// Its strip is bounded by lines of u sqrt(1 + w^2): SliceFrame::meridians is false.
    bool widens = false;
};

/// The slices of one sector, from low u to high. Gap k lies between slices k and k + 1.
struct SliceFrame {
    Eigen::Matrix3f R_frame_sensor;
    std::vector<Slice> slices;
    int slices_per_beam;
    int first_beam;
    /// Begins of the sector's beams, and the end of the last one. The sector may begin or end
    /// within a beam.
    std::vector<float> beam_u;
    float w_low;  ///< limits of w over all slices and gaps
    float w_high;
    float tan_low;  ///< w of the view's borders at u = 0
    float tan_high;
    /// True if lines of constant u are great circles along the view's own lines. For port_starboard
    /// they are not; a gap's border at w is its u times sqrt(1 + w^2), a line of constant
    /// elevation.
    bool meridians;

    std::uint32_t gaps() const { return static_cast<std::uint32_t>(slices.size()) - 1; }
};

/// The slice of a frame at u.
Slice slice_at(const SliceFrame& frame, float u);

/// The least and the greatest w of the view over an interval of u.
Interval w_over(const SliceFrame& frame, const Interval& u);

/// Divides each beam of `view` into `per_beam` equal strips, more if it is wide, with a slice on
/// both borders of each; adjacent strips share a slice. Frames are in the order of their beams.
/// Slices are offset slightly from their places, by different amounts, so that they do not run
/// along edges that are parallel to the sonar's axes.
std::vector<SliceFrame> slice_frames(const View& view, int per_beam);

}  // namespace sonarsim
