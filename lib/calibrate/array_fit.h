#pragma once

#include <array>
#include <optional>
#include <vector>

#include "calibrate/bootstrap.h"
#include "calibrate/correlations.h"
#include "calibrate/log_statistics.h"
#include "calibrate/patches.h"
#include "calibrated/line_array.h"

namespace sonarsim {

/// Squared correlation of the complex amplitudes of two beams whose sines differ by `u`. The
/// elements have independent noise, and w(x) enters both beams with the phases of their directions.
/// So the correlation is the integral of w^2 exp(2 pi i u L x / lambda) over that of w^2, the
/// Fourier transform of the squared weights; phase errors cancel. Speckle has the same correlation:
/// its scatterers are independent, and the overlap of two patterns is that transform, too.
double beam_correlation(const LineArray& array, double u);

/// The correlations of log powers 1 to patch_lags beams apart that an array has, the mean over all
/// beams. `sines` are those of the beams.
std::array<double, patch_lags> predicted_beam_correlations(const LineArray& array,
                                                           const std::vector<double>& sines,
                                                           const LogStatistics& statistics);

/// The receiving array, fitted to the correlation of noise across the beams.
struct ArrayFit {
    Bounded width_deg;
    Bounded side_lobe_db;
    bool taper_known = false;  ///< false: only width and taper together are known
};

/// The array with the least chi^2 = d' C^-1 d, d the measured correlations less its own and C their
/// covariance. An interval covers the widths, or the tapers, of all arrays whose chi^2 is within
/// 3.84 of the least (profile likelihood; Wilks 1938). So a taper at the end of its range, or one
/// that the width can compensate, has a wide interval. Nothing for fewer than 24 units. The taper
/// counts as known when its interval is narrower than 8 dB.
std::optional<ArrayFit> fit_array(const BeamCorrelations& seen, const std::vector<double>& sines,
                                  const LogStatistics& statistics);

}  // namespace sonarsim
