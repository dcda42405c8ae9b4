#pragma once

#include "run/job/run_job.h"
#include "support/test.h"

namespace sonarsim::test {

/// Two small sonars in the tank, the second at every third pose, noise on.
Mission small_mission(const std::filesystem::path& output_folder);

/// All four kinds of sonar over the floor of the tank, noise on; the echosounder pings at half.
Mission survey_mission(const std::filesystem::path& output_folder);

/// Scene, poses and sonars of a mission, made in memory: `poses` poses at 10 Hz, moving along x.
Assembly small_assembly(const Mission& mission, int poses);

/// The bytes of every file below a folder, by its path relative to the folder.
std::map<std::string, std::string> contents(const std::filesystem::path& folder);

/// The small mission of a test, whose dataset is out/ in a folder of its own.
struct MissionInFolder {
    TemporaryFolder temporary;
    std::filesystem::path out = temporary.path / "out";
    Mission mission = small_mission(out);
};

inline constexpr int poses = 7;  // front pings at all of them, left at 0, 3 and 6: ten pings

inline RenderSummary run(const Mission& mission, const RenderOptions& options = {}) {
    return run_job(mission, small_assembly(mission, poses), options, {}, std::atomic<bool>(false));
}

}  // namespace sonarsim::test
