#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "core/clock.h"
#include "output/dataset/layout.h"
#include "run/job/run_job.h"
#include "run/report/report.h"
#include "simulate/assembly/engines.h"

namespace sonarsim {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t max_images = 64;

/// An empty folder that goes with this object.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "sonarsim-report-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw std::system_error(errno, std::generic_category(), name);
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

/// Renders at most max_images pings of a mission into a new folder.
RenderSummary render(Mission mission, const Assembly& assembly, int threads) {
    const TemporaryFolder folder;
    mission.output.folder = folder.path() / "out";
    const std::uint64_t pings = list_pings(mission, assembly.trajectory.size()).size();
    const RenderOptions options{.threads = threads,
                                .shards = static_cast<int>((pings + max_images - 1) / max_images)};
    const std::atomic<bool> stop = false;
    return run_job(mission, assembly, options, {}, stop);
}

}  // namespace

JobRow measure_job(const Mission& mission, double ms_rays, const ReportOptions& options) {
    JobRow row;
    Stopwatch watch;
    const Assembly assembly = assemble(mission);
    make_engine(mission, assembly);
    row.ms_set_up = 1e3 * watch.lap();
    const RenderSummary summary = render(mission, assembly, 1);
    const auto images = static_cast<double>(summary.pings);
    const PingSeconds& stages = summary.stages;
    row.images = summary.pings;
    row.ms_trace = 1e3 * (stages.trace + stages.multipath) / images;
    row.ms_form = 1e3 * (stages.accumulate + stages.noise) / images;
    row.ms_facts = 1e3 * summary.label_seconds / images;
    row.ms_files = 1e3 * (summary.encode_seconds + summary.write_seconds) / images;
    row.times_rays =
        (row.ms_trace + row.ms_form + row.ms_facts + row.ms_files) / std::max(ms_rays, 1e-9);
    row.images_per_s = images / render(mission, assembly, options.threads).seconds;
    return row;
}

}  // namespace sonarsim
