#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "output/dataset/json.h"
#include "run/checks/measured_error.h"
#include "run/checks/survey.h"
#include "run/checks/warning.h"

namespace sonarsim {

/// A line for each of the first files that do not say their unit and axis; "" if there are none.
std::string readings_text(const SceneConfig& scene);

/// A sonar's survey as indented lines.
std::string survey_text(const SonarSurvey& found, const Scene& scene, const SceneObjects& objects);

/// A sonar's survey as JSON.
Json survey_json(const SonarSurvey& found, const Scene& scene, const SceneObjects& objects);

/// The measured error of a sonar as an indented line; "" if there is none.
std::string error_line(const std::optional<MeasuredError>& error, const Scene& scene, double goal);

/// The size of a dataset, or of several.
struct Estimate {
    std::uint64_t pings = 0;
    std::size_t images = 0;  ///< pings with a picture, and pictures of all pings
    double set_up_s = 0.0;   ///< before the first ping: reading, tables, the engine
    double hours = 0.0;      ///< all threads at work, without set_up_s; NaN: unknown
    double bytes = 0.0;      ///< all files

    Estimate& operator+=(const Estimate& more) {
        pings += more.pings;
        images += more.images;
        set_up_s += more.set_up_s;
        hours += more.hours;
        bytes += more.bytes;
        return *this;
    }
};
std::string estimate_text(const Estimate& estimate);
/// Adds its numbers.
void describe_estimate(const Estimate& estimate, Json& json);

Json warnings_json(std::span<const Warning> warnings);

}  // namespace sonarsim
