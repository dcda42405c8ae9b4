#include "benchmark/cold_start.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <type_traits>

#include "benchmark/settings.h"
#include "benchmark/timed_pings.h"
#include "core/clock.h"
#include "visibility/octree/octree_engine.h"

namespace sonarsim {

namespace {

static_assert(std::is_trivially_copyable_v<ColdStart>, "it goes through a pipe as it is");

[[noreturn]] void fail(const char* what) {
    throw std::system_error(errno, std::generic_category(), what);
}

ColdStart run_cold(const Mission& mission, const Assembly& assembly, const Setting& setting,
                   const Sonar& sonar, int poses, double assembled_s) {
    ColdStart cold;
    const double start = seconds_now();
    const auto engine = make_engine(assembly.scene, engine_settings(setting, mission, assembly));
    cold.build_s = seconds_now() - start;
    bool first = true;
    for (const std::size_t pose : sample_poses(assembly.trajectory.size(), poses)) {
        const double before = seconds_now();
        const SonarAtPose then(mission, sonar, static_cast<std::uint32_t>(pose));
        render_ping(*then, assembly.scene, *engine, assembly.trajectory[pose].T_world_vehicle,
                    {mission.seed, static_cast<std::uint32_t>(pose)});
        const double after = seconds_now();
        if (first) {
            cold.first_ping_s = assembled_s + after - start;
        } else {
            cold.slowest_ms = std::max(cold.slowest_ms, 1e3 * (after - before));
        }
        first = false;
    }
    if (const auto* octree = dynamic_cast<const OctreeEngine*>(engine.get())) {
        cold.engine_memory_mb = static_cast<double>(octree->statistics().bytes) / (1024.0 * 1024.0);
    }
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    cold.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024.0;
    return cold;
}

ColdStart in_child(const std::function<ColdStart()>& run) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) fail("cannot make a pipe");
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child < 0) fail("cannot start a process");
    if (child == 0) {
        // A signal that ends the parent also ends the child.
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != parent) ::_exit(1);
        // _exit() skips the parent's destructors and buffers.
        try {
            const ColdStart cold = run();
            const bool whole = ::write(ends[1], &cold, sizeof cold) == sizeof cold;
            ::_exit(whole ? 0 : 1);
        } catch (...) {
            ::_exit(1);
        }
    }
    ::close(ends[1]);
    ColdStart cold;
    const bool whole = ::read(ends[0], &cold, sizeof cold) == sizeof cold;
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!whole || status != 0) {
        throw std::runtime_error(
            "a setting failed in its child process; it may have run out of memory");
    }
    return cold;
}

}  // namespace

std::vector<ColdStart> measure_cold_starts(const Mission& mission, const Assembly& assembly,
                                           std::span<const Setting> settings,
                                           const ReportOptions& options, double assembled_s) {
    std::vector<ColdStart> out;
    for (const Setting& setting : settings) {
        for (const Sonar& sonar : assembly.sonars) {
            const Sonar ready = with_setting(sonar, setting);
            out.push_back(in_child([&] {
                return run_cold(mission, assembly, setting, ready, options.poses, assembled_s);
            }));
        }
    }
    return out;
}

}  // namespace sonarsim
