#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "run/checks/survey.h"
#include "run/checks/warning.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

/// All warnings about a valid mission. `sonars` are by Mission::sensors, `rays` those of the scene.
std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays);

/// The warnings that need no ping: about reading the scene, materials and the keys of sonars.
std::vector<Warning> warnings_before_pings(const Mission& mission, const Assembly& assembly);

/// W01: the findings of reading the scene.
std::vector<Warning> reading_warnings(const Scene& scene);

/// Warnings about a sonar in a survey: blind pings, echoes below the noise, white or black images.
std::vector<Warning> sonar_warnings(const OutputConfig& output, const Sonar& sonar,
                                    double full_scale, const SonarSurvey& found);

/// Sums over pings of one sonar.
struct SensorSummary {
    std::uint64_t pings = 0;
    std::uint64_t dark_pings = 0;  ///< pings without an occupied bin
    PingCounts counts;
    std::uint64_t clipped_pixels = 0;  ///< intensities above full_scale, if files were written
    float brightest = 0.0F;            ///< intensity of the brightest pixel of all

    SensorSummary& operator+=(const SensorSummary& more) {
        pings += more.pings;
        dark_pings += more.dark_pings;
        counts += more.counts;
        clipped_pixels += more.clipped_pixels;
        brightest = std::max(brightest, more.brightest);
        return *this;
    }
};

/// Images of a run that are black, nearly black or white, by Mission::sensors.
std::vector<Warning> image_warnings(const Mission& mission, const Assembly& assembly,
                                    std::span<const SensorSummary> sensors);

/// Objects of the mission, or with a class, that no sonar sees, in the survey or other pings.
std::vector<Warning> hidden_objects(const Mission& mission, const Assembly& assembly,
                                    std::span<const SonarSurvey> sonars,
                                    const VisibilityEngine& rays);

/// An estimate of the memory of one ping of a sonar.
struct PingMemory {
    double bytes = 0.0;
    std::string_view key;  ///< the key of the sensor that would reduce the memory most
};
PingMemory ping_memory(const Sonar& sonar);

/// W26 for every sonar whose pings on `threads` threads take more than the `available` bytes.
std::vector<Warning> memory_warnings(const std::vector<Sonar>& sonars, int threads,
                                     double available);

}  // namespace sonarsim
