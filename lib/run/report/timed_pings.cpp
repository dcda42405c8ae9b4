#include <time.h>

#include <algorithm>
#include <numeric>

#include "core/clock.h"
#include "core/file.h"
#include "output/dataset/layout.h"
#include "run/job/run_job.h"
#include "run/report/report.h"
#include "simulate/visibility/view.h"

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

double median_of(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

double mean_of(const std::vector<double>& values) {
    if (values.empty()) return 0.0;
    return std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
}

double thread_seconds_now() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<Eigen::Vector3f> view_rays(const View& view) {
    constexpr int columns = 512;
    constexpr int count = view_rays_count / columns;
    View cut = view;
    if (view.shape == ViewShape::fan) cut.beams = columns;
    std::vector<Eigen::Vector3f> out;
    out.reserve(view_rays_count);
    for (const ViewColumn& column : view_columns(cut, columns / cut.beams)) {
        const double step = (column.along_max - column.along_min) / count;
        const SinCosFloat across = sincos_float(column.across);
        for (int i = 0; i < count; ++i)
            out.push_back(
                direction(view.shape, across, sincos_float(column.along_min + (i + 0.5) * step)));
    }
    return out;
}

PingSet::PingSet(const Mission& measured, const Assembly& assembly, int count)
    : mission(measured), scene(assembly.scene) {
    // Evenly spaced from the first pose to the last; all of them if there are fewer.
    const std::size_t last = assembly.trajectory.size() - 1;
    const std::size_t n = std::min(last + 1, static_cast<std::size_t>(std::max(count, 1)));
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t pose = n > 1 ? k * last / (n - 1) : 0;
        poses.push_back(assembly.trajectory[pose].T_world_vehicle);
        indices.push_back(static_cast<std::uint32_t>(pose));
    }
}

TracedPing visit_pose(const PingSet& pings, const Sonar& sonar, const VisibilityEngine& engine,
                      std::size_t p, PoseTimes& times) {
    constexpr double slow_ms = 100.0;
    constexpr int repeats = 3;
    const SonarAtPose then = pings.at_pose(sonar, p);
    TracedPing traced;
    const auto visit = [&] {
        const double thread_start = thread_seconds_now();
        Stopwatch watch;
        traced = trace(*then, pings.scene, engine, pings.poses[p], pings.indices[p]);
        const Ping ping = form_image(traced, then->settings, pings.scene, pings.key(p));
        times.ping_thread_ms.push_back(1e3 * (thread_seconds_now() - thread_start));
        times.multipath_ms.push_back(1e3 * ping.seconds.multipath);
        times.ping_ms.push_back(1e3 * watch.lap());
        return times.ping_ms.back();
    };
    if (visit() > slow_ms) return traced;
    times.ping_thread_ms.pop_back();  // the ping that warmed the caches
    times.multipath_ms.pop_back();
    times.ping_ms.pop_back();
    for (int k = 0; k < repeats; ++k)
        visit();
    return traced;
}

double over_poses(std::span<const PoseTimes> poses, std::vector<double> PoseTimes::*times_ms) {
    std::vector<double> medians;
    for (const PoseTimes& times : poses)
        medians.push_back(median_of(times.*times_ms));
    return median_of(medians);
}

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
