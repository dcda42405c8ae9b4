#pragma once

#include "run/job/run_job.h"
#include "support/small_mission.h"

namespace sonarsim::test {

inline constexpr int poses = 7;  // front pings at all of them, left at 0, 3 and 6: ten pings

inline RenderSummary run(const Mission& mission, const RenderOptions& options = {}) {
    return run_job(mission, small_assembly(mission, poses), options, {}, std::atomic<bool>(false));
}

inline bool is_complete(const std::filesystem::path& folder) {
    return nlohmann::json::parse(read_file(folder / "dataset.json", 1 << 20)).at("complete");
}

}  // namespace sonarsim::test
