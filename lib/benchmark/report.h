#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "assembly/assemble.h"
#include "benchmark/setting.h"
#include "benchmark/summary.h"
#include "mission/mission.h"

namespace sonarsim {

// The report of speed against error: the time and the accuracy of each engine and setting for a
// mission.

/// The costs of a setting in its own process.
struct ColdStart {
    double build_s = 0.0;           ///< time to build the engine, before the first ping
    double first_ping_s = 0.0;      ///< from the start of the program to the end of the first ping
    double slowest_ms = 0.0;        ///< the slowest of the later pings, one per pose
    double peak_memory_mb = 0.0;    ///< peak memory of the process: scene, engine and pings; MiB
    double engine_memory_mb = 0.0;  ///< part of the peak for the octree's nodes; 0 for rays
};

/// One sonar with one setting.
struct ReportRow {
    std::string sensor;
    Setting setting;
    Summary ms_per_ping;                                      ///< noise on, one thread
    double pings_per_s = 0.0;                                 ///< noise on, all threads
    Summary relative_l1, relative_l2, miss_rate, false_rate;  ///< noise off
    bool warned = false;  ///< the engine warned at one of the poses
    Summary samples_per_ping;
    ColdStart cold;
    PingSeconds stages;    ///< medians over the poses
    double ms_bare = 0.0;  ///< median for Embree alone, one ray to every sample
    /// Embree alone, with view_rays_count rays over the view, and a ping as a multiple of it. Both
    /// are CPU times, measured in turns at each pose; medians over the poses.
    double ms_rays = 0.0;
    double times_rays = 0.0;
    bool on_front = false;  ///< no setting of this sonar is both faster and more accurate

    /// The result of the setting's promise: "met" if it holds at the worst pose, too, "warned" if
    /// the engine warned that it does not hold, "missed" if it did not warn; "-" if there is no
    /// promise.
    const char* promise() const {
        if (!setting.promises()) return "-";
        if (relative_l1.max <= setting.relative_l1) return "met";
        return warned ? "warned" : "missed";
    }
};

/// One sonar with one multipath method, compared to tracing every sample. The errors are those of
/// the multipath echoes only, without noise, over the bins of all poses together, since a single
/// pose may fill only a few bins.
struct MultipathRow {
    std::string sensor;
    MultipathConfig setting;       ///< the exact method has 0 for epsilon and delta
    bool current = false;          ///< the mission's own setting
    std::uint64_t exact_bins = 0;  ///< bins that the exact method fills
    double relative_l1 = 0.0;
    double recall = 1.0;      ///< share of the exact method's bins that this one fills, too
    double precision = 1.0;   ///< share of this method's bins that the exact one fills, too
    Summary ms_multipath;     ///< time of this stage over the poses; one thread
    Summary ms_per_ping;      ///< noise on, one thread
    double ms_without = 0.0;  ///< ping without multipath, median over the poses
    double speed_up = 0.0;    ///< time of this stage by the exact method / by this one

    double times_without() const { return ms_without > 0.0 ? ms_per_ping.centre / ms_without : 0; }
};

/// One sonar with one kind of label.
struct LabelRow {
    std::string sensor;
    std::string label;
    Summary ms;          ///< CPU time of finding the label, over the poses
    Summary times_ping;  ///< CPU time of a ping with the label / without it, over the poses
};

/// The convergence of a sonar's reference images.
struct ReferenceQuality {
    std::string sensor;
    Summary moved;         ///< Reference::moved
    Summary apart;         ///< Reference::apart
    Summary rays_per_bin;  ///< rays that echoed, per occupied bin
};

/// The growth of the time per ping with the scene.
struct Growth {
    std::string sensor;
    std::string engine;
    std::string along;  ///< "detail": more triangles on the same shape; "area": the same density
    std::vector<double> triangles;
    std::vector<double> ms_per_ping;
    double exponent = 0.0;  ///< exponent in ms per ping ~ triangles^exponent
};

struct ReportOptions {
    int poses = 8;
    int rounds = 5;
    int threads = 0;                 ///< 0: one per core
    double reference_moved = 0.001;  ///< relative L1 at which the reference has converged
    std::uint64_t reference_rays = 200'000'000;  ///< limit per image
};

struct Report {
    std::string mission;
    std::size_t triangles = 0;  ///< copies included
    int poses = 0;
    int threads = 0;
    double goal = 0.0;   ///< accuracy.relative_l1 of the mission
    double load = 0.0;   ///< load average of the machine at the start
    std::vector<ReportRow> rows;
    std::vector<ReferenceQuality> references;  ///< one per sonar
    std::vector<Growth> growth;
    std::vector<MultipathRow> multipath;  ///< only for sonars that have it
    std::vector<LabelRow> labels;         ///< only for missions that ask for labels
};

/// Reports progress.
using ReportProgress = std::function<void(const std::string&)>;

/// Measures every sonar of a mission with every one of `settings`, on poses sampled along the
/// trajectory. Settings take turns, so that a machine that slows down slows all of them. Errors are
/// those of the direct echoes without noise against cast_reference(). `cold` has a ColdStart per
/// setting and sonar (sonars within settings), or is empty for zeros.
Report make_report(const Mission& mission, const Assembly& assembly,
                   std::span<const Setting> settings, std::span<const ColdStart> cold,
                   const ReportOptions& options, const ReportProgress& progress);

/// The sonar with a setting's error goal.
Sonar with_setting(const Sonar& sonar, const Setting& setting);

}  // namespace sonarsim
