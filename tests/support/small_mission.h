#pragma once

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "support/test.h"

namespace sonarsim::test {

/// Two small sonars in the tank, the second at every third pose, noise on.
Mission small_mission(const std::filesystem::path& output_folder);

/// All four kinds of sonar over the floor of the tank, noise on; the echosounder pings at every
/// second pose.
Mission survey_mission(const std::filesystem::path& output_folder);

/// Scene, poses and sonars of a mission, made in memory: `poses` poses at 10 Hz, moving along x.
Assembly small_assembly(const Mission& mission, int poses);

/// The bytes of every file below a folder, by its path relative to the folder.
std::map<std::string, std::string> contents(const std::filesystem::path& folder);

}  // namespace sonarsim::test
