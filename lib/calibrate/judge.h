#pragma once

#include <string>
#include <vector>

#include "calibrate/image_fit.h"

namespace sonarsim {

/// The most that a figure may be off to agree: a share, decibels, or a difference of correlations.
enum class FitTolerance { tenth, three_twentieths, decibel, correlation };

/// A figure that an instrument predicts and that is measured of pings.
struct Figure {
    std::string name;
    FitTolerance tolerance = FitTolerance::tenth;
    double predicted = 0.0;
    Bounded measured;

    /// True if the prediction is within 10 or 15 %, 1 dB or 0.05 of what was measured.
    bool agrees() const;
};

/// The figures of pings, and an instrument's predictions of them by closed forms: distribution of
/// the amplitude under the instrument's own law, correlations of noise and of echoes along range
/// and beams, level of the noise by range. `of_fit` defines the blocks and beams that count as
/// noise. Figures that the pings do not determine are left out.
std::vector<Figure> figures_of(const Recording& recording, const InstrumentConfig& instrument,
                               double noise_re_full_scale_db, double absorption_db_per_m,
                               const std::optional<NoiseFit>& of_fit);

}  // namespace sonarsim
