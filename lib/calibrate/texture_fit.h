#pragma once

#include <optional>

#include "calibrate/array_fit.h"
#include "calibrate/patch_classes.h"
#include "calibrate/pulse_fit.h"

namespace sonarsim {

/// A texture of the bottom as `speckle.clutter_shape` and `clutter_m` simulate it:
/// gamma-distributed strengths in squares of the scene. ln P is the sum of the logarithms of
/// speckle and strength. The texture's share of its variance is trigamma(shape) over the sum of
/// trigamma(shape) and the speckle's variance.
struct BottomTexture {
    double share = 0.0;
    double edge_m = 0.1;

    /// The correlation of ln P at a distance d, from that of the speckle: two places d apart lie in
    /// one square of the edge e in a share 1 - d / e of all cases.
    double correlation(double of_speckle, double distance_m) const;
};

BottomTexture texture_of(const SpeckleConfig& speckle, const LogStatistics& statistics);

/// trigamma(x), the variance of the logarithm of a gamma-distributed number, and its inverse.
double trigamma(double x);
double inverse_trigamma(double variance);

/// The patches of echoes, and the correlations across beams of speckle alone.
struct EchoPatches {
    const PatchClasses* classes = nullptr;
    double range_step_m = 0.0;  ///< the distance of bins on the ground
    double beam_step_m = 0.0;   ///< the mean distance of beams
    std::array<double, patch_lags> of_beams{};
};

EchoPatches echo_patches(const PatchClasses& classes, const Recording& recording,
                         const std::array<double, patch_lags>& of_beams);

struct TextureFit {
    Bounded share, edge_m;
    Bounded pulse_bins;
};

/// Share and edge of a texture, and the pulse, fitted to the correlations of echoes along range and
/// beams. Nothing where the share lies less than 3.3 standard errors off 0, or where the
/// correlations are not those of a texture.
std::optional<TextureFit> fit_texture(const EchoPatches& echoes, const PulseModel& model);

}  // namespace sonarsim
