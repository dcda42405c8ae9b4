#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/file.h"
#include "job/run_job.h"
#include "support/small_mission.h"
#include "support/temporary_folder.h"

namespace sonarsim::test {

inline constexpr int poses = 7;  // front pings at all of them, left at 0, 3 and 6: ten pings
inline constexpr int pings = 10;

inline RenderSummary run(const Mission& mission, const RenderOptions& options = {}) {
    return run_job(mission, small_assembly(mission, poses), options, {}, std::atomic<bool>(false));
}

inline bool is_complete(const std::filesystem::path& folder) {
    return nlohmann::json::parse(read_file(folder / "dataset.json", 1 << 20)).at("complete");
}

/// The result of a whole render of the small mission.
inline std::map<std::string, std::string> whole_dataset() {
    const TemporaryFolder folder;
    run(small_mission(folder.path / "out"));
    return contents(folder.path / "out");
}

}  // namespace sonarsim::test
