#include <time.h>

#include <algorithm>
#include <numeric>

#include "core/clock.h"
#include "run/report/report.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

namespace {

/// `count` indices into a trajectory, evenly spaced from its first pose to its last; all of them if
/// it has fewer.
std::vector<std::size_t> sample_poses(std::size_t poses, int count) {
    const std::size_t n = std::min(poses, static_cast<std::size_t>(std::max(count, 1)));
    std::vector<std::size_t> out(n);
    for (std::size_t k = 0; k < n; ++k)
        out[k] = n > 1 ? k * (poses - 1) / (n - 1) : 0;
    return out;
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
    for (const std::size_t pose : sample_poses(assembly.trajectory.size(), count)) {
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

}  // namespace sonarsim
