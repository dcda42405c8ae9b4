#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "assembly/assemble.h"
#include "mission/mission.h"

namespace sonarsim::test {

/// Two small sonars in the tank, the second at every third pose, noise on.
Mission small_mission(const std::filesystem::path& output_folder);

/// All four kinds of sonar over the floor of the tank, noise on; the echosounder pings at every
/// second pose.
Mission survey_mission(const std::filesystem::path& output_folder);

/// Either of them with scene, poses and sonars made in memory: `poses` of them, 10 Hz, moving along
/// x.
Assembly small_assembly(const Mission& mission, int poses);

/// Every file below a folder with its bytes, by its path relative to the folder.
std::map<std::string, std::string> contents(const std::filesystem::path& folder);

}  // namespace sonarsim::test
