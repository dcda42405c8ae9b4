#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
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

/// An end of an Extent where it has none.
inline constexpr float unbounded = std::numeric_limits<float>::infinity();

struct Slice {
    float u;
    float w_low;  ///< where it enters the view, and where it leaves it
    float w_high;
    float w_low_slope;  ///< dw/du of the view's borders there
    float w_high_slope;
};

/// The slices of one sector, from low u to high. Gap k lies between slices k and k + 1.
struct SliceFrame {
    Eigen::Matrix3f R_frame_sensor;
    std::vector<Slice> slices;
    int slices_per_beam;
    int first_beam;
    /// Where the beams of the sector begin, one more for where the last of them ends. The outermost
    /// are those of the sector, which may begin or end within a beam.
    std::vector<float> beam_u;
    float w_low;  ///< the least and the greatest w of all slices and gaps
    float w_high;
    float tan_low;  ///< w of the view's borders at u = 0
    float tan_high;
    /// Whether a line of constant u is a great circle along the view's own lines. Sides: it is not;
    /// a gap's border at w is its u times sqrt(1 + w^2), a line of constant elevation.
    bool meridians;

    std::uint32_t gaps() const { return static_cast<std::uint32_t>(slices.size()) - 1; }
};

/// The slice of a frame at u.
Slice slice_at(const SliceFrame& frame, float u);

/// Cuts each beam of `view` into `per_beam` equal strips, more where it is wide, with a slice on
/// either border of each: one on the border between two beams serves both. Frames are in the order
/// of their beams. Slices lie a hair beside their places, each by another share of the strip, so
/// that no edge of a scene that is built along the sonar's axes runs along a slice.
std::vector<SliceFrame> slice_frames(const View& view, int per_beam);

}  // namespace sonarsim
