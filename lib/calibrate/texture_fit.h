#pragma once

#include <optional>

#include "calibrate/array_fit.h"
#include "calibrate/patch_classes.h"
#include "calibrate/pulse_fit.h"

namespace sonarsim {

/// A texture of the bottom as `speckle.clutter_shape` and `clutter_m` simulate it: strengths of
/// gamma's distribution in squares of the scene. ln P is the sum of the logarithms of speckle and
/// strength, so the texture has a share of its variance, trigamma(shape) by that and the speckle's.
struct BottomTexture {
    double share = 0.0;
    double edge_m = 0.1;

    /// The correlation of ln P at a distance, by that of speckle: squares of the edge e share a
    /// strength over the distance d in 1 - d / e of all places.
    double correlation(double of_speckle, double distance_m) const;
};

BottomTexture texture_of(const SpeckleConfig& speckle, const LogStatistics& statistics);

/// trigamma(x), the variance of the logarithm of gamma's distribution, and its inverse.
double trigamma(double x);
double inverse_trigamma(double variance);

/// The places of echoes, and what speckle alone would have there.
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

/// Share and edge of a texture, and the pulse, by the correlations of echoes along range and beams.
/// Nothing where the share lies less than 3.3 standard errors off 0, or where the correlations are
/// not those of a texture.
std::optional<TextureFit> fit_texture(const EchoPatches& echoes, const PulseModel& model);

}  // namespace sonarsim
