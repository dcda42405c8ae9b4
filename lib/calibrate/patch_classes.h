#pragma once

#include <optional>
#include <vector>

#include "calibrate/law_fit.h"
#include "calibrate/noise_fit.h"
#include "calibrate/patches.h"
#include "recording/recording.h"

namespace sonarsim {

/// The patches that are noise, and those that are echoes well above it.
struct PatchClasses {
    std::vector<PatchMoments> patches;  ///< log powers less the level of the noise, if it is known
    std::vector<std::size_t> noise, echoes;
    int places = 0;
};

/// Patches are noise if all their rows are blocks of `noise` without echoes and with hardly any
/// values of 0, except for those straight ahead. Even patches 6 dB above the noise are echoes;
/// without `noise`, all even patches are echoes.
PatchClasses classified(const Recording& recording, const LawFit& law,
                        const std::optional<NoiseFit>& noise);

/// Slant range of the middle of a row.
double range_of_row(const Recording& recording, int row);

/// The sines of the recording's beams; empty for a sonar that forms none.
std::vector<double> beam_sines(const Recording& recording);

}  // namespace sonarsim
