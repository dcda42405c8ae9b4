#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/array_fit.h"
#include "calibrate/law_fit.h"
#include "calibrate/noise_fit.h"
#include "calibrate/pulse_fit.h"
#include "calibrated/instrument_levels.h"
#include "mission/instrument.h"
#include "recording/recording.h"

namespace sonarsim {

/// The instrument that a calibration starts from, for pings of the recording's shape.
struct StartInstrument {
    InstrumentConfig config;
    InstrumentLevels levels;
    double absorption_db_per_m = 0.0;
};

/// One key of `instrument` that the pings give.
struct Estimate {
    std::string key;  ///< as "receiver.gamma"
    Measured number;
    std::string word;  ///< in place of the number: "log"
};

/// What pings tell of an instrument that delivers images or records.
struct ImageFit {
    LawFit law;
    std::optional<NoiseFit> noise;
    std::optional<Measured> pulse_bins;
    bool pulse_of_echoes = false;  ///< there was no noise to take it from
    std::optional<ArrayFit> array;
    InstrumentConfig config;  ///< the start with what was fitted
    double noise_re_full_scale_db = 0.0;
    std::vector<Estimate> estimates;
    std::vector<std::string> notes;  ///< what the pings do not tell, and why
};

/// Which patches are noise and which are echoes well above it.
struct PatchClasses {
    std::vector<PatchMoments> patches;  ///< of log powers less those of the noise, if it is known
    std::vector<std::size_t> noise, echoes;
    int places = 0;
};

/// Patches whose rows are all blocks of `noise` are noise, without those straight ahead. Even
/// patches 6 dB above it are echoes; without noise, all even patches are.
PatchClasses classified(const Recording& recording, const LawFit& law,
                        const std::optional<NoiseFit>& noise);

/// Slant range of the middle of a row.
double range_of_row(const Recording& recording, int row);

/// The sines of the recording's beams; empty for a sonar that forms none.
std::vector<double> beam_sines(const Recording& recording);

/// The law that an instrument is said to have.
LawFit stated_law(const ReceiverConfig& receiver);

/// Fits law, noise, pulse and array, in this order. InputError for pings that are none of a sonar.
ImageFit fit_image(const Recording& recording, const StartInstrument& start);

}  // namespace sonarsim
