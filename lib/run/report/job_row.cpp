#include <algorithm>
#include <atomic>

#include "core/clock.h"
#include "core/file.h"
#include "output/dataset/layout.h"
#include "run/job/run_job.h"
#include "run/report/report.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

namespace {

constexpr std::uint64_t max_images = 64;

/// Renders at most max_images pings of a mission into a new folder.
RenderSummary render(Mission mission, const Assembly& assembly, int threads) {
    const ScratchFolder folder;
    mission.output.folder = folder.path() / "out";
    const std::uint64_t pings = list_pings(mission, assembly.trajectory.size()).size();
    const RenderOptions options{.threads = threads,
                                .shards = static_cast<int>((pings + max_images - 1) / max_images)};
    const std::atomic<bool> stop = false;
    return run_job(mission, assembly, options, {}, stop);
}

}  // namespace

Json measure_job(const Mission& mission, double ms_rays, const ReportOptions& options) {
    Stopwatch watch;
    const Assembly assembly = assemble(mission);
    make_engine(mission, assembly);
    const double ms_set_up = 1e3 * watch.lap();
    const RenderSummary summary = render(mission, assembly, 1);
    const auto images = static_cast<double>(summary.pings);
    const auto per_image = [&](double seconds) { return 1e3 * seconds / images; };
    const PingSeconds& stages = summary.stages;
    const double ms_trace = per_image(stages.trace + stages.multipath);
    const double ms_form = per_image(stages.accumulate + stages.noise);
    const double ms_facts = per_image(summary.label_seconds);
    const double ms_files = per_image(summary.encode_seconds + summary.write_seconds);
    return {
        {"images", summary.pings},
        {"images_per_s", images / render(mission, assembly, options.threads).seconds},
        {"ms_set_up", ms_set_up},
        {"ms_trace", ms_trace},
        {"ms_form", ms_form},
        {"ms_facts", ms_facts},
        {"ms_files", ms_files},
        {"times_131k_rays", (ms_trace + ms_form + ms_facts + ms_files) / std::max(ms_rays, 1e-9)}};
}

}  // namespace sonarsim
