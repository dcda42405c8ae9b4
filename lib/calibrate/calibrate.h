#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/image_fit.h"
#include "calibrate/judge.h"
#include "calibrate/soundings_fit.h"
#include "calibrate/written_preset.h"
#include "mission/mission.h"
#include "recording/recording.h"

namespace sonarsim {

struct CalibrationOptions {
    double judged_share = 0.5;
    bool reversed = false;   ///< the first pings are judged, the last ones fitted
    double slope_rad = 0.0;  ///< bottom across the track, positive down to port
};

/// A figure in the columns of the report.
struct JudgedFigure {
    Figure start;      ///< the start's prediction, and the judged pings under its law
    Figure in_sample;  ///< the fit's prediction, and the pings that it was fitted to
    Figure held_out;   ///< the same and the judged pings
};

struct Calibration {
    std::string name;  ///< the recording's
    std::size_t pings_fitted = 0, pings_judged = 0;
    std::vector<KeyEstimate> estimates;
    std::optional<SoundingsFit> soundings;
    std::vector<JudgedFigure> figures;
    std::vector<std::string> notes;
    std::vector<PresetValue> preset;  ///< the keys of the new preset that differ from the start
};

/// Fits one part of the pings and judges the other. `start` is the sonar of the preset to begin
/// with. InputError for a recording that cannot be calibrated.
Calibration calibrate(const Recording& recording, const SonarConfig& start,
                      const WaterConfig& water, const CalibrationOptions& options);

/// Four digits of a number.
std::string four_digits(double value);

/// The figures as a table, the estimates and the notes.
std::string calibration_text(const Calibration& calibration);

nlohmann::ordered_json calibration_json(const Calibration& calibration);

}  // namespace sonarsim
