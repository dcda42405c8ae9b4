#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/array_fit.h"
#include "calibrate/law_fit.h"
#include "calibrate/noise_fit.h"
#include "calibrate/patch_classes.h"
#include "calibrate/pulse_fit.h"
#include "calibrate/texture_fit.h"
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

/// One key of `instrument` that the pings determine.
struct KeyEstimate {
    std::string key;  ///< as "receiver.gamma"
    Bounded number;
    std::string word;  ///< in place of the number: "log"
};

/// The part of an instrument that its images or records determine.
struct ImageFit {
    LawFit law;
    std::optional<Bounded> offset;  ///< a power law's
    std::optional<NoiseFit> noise;
    std::optional<Bounded> pulse_bins;
    bool pulse_of_echoes = false;  ///< fitted to echoes, without noise
    std::optional<ArrayFit> array;
    std::optional<TextureFit> texture;  ///< the bottom's
    bool law_of_echoes = false;         ///< fitted to echoes, without noise
    InstrumentConfig config;            ///< the start with the fitted values
    double noise_re_full_scale_db = 0.0;
    std::vector<KeyEstimate> estimates;
    std::vector<std::string> notes;  ///< reasons why the pings do not determine a number
};

}  // namespace sonarsim
