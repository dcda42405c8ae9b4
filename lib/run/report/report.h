#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "run/report/timed_pings.h"
#include "simulate/assembly/assemble.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// One engine with one resolution.
struct Setting {
    std::string engine;  ///< "rays", "strips", "octree" or "auto"
    std::string name;    ///< the mission's key and value, "relative_l1=0.03"
    EngineKind kind = EngineKind::rays;
    OctreeConfig octree;       ///< for the octree
    double relative_l1 = 0.0;  ///< error goal of all but the octree
    bool current = false;      ///< the mission's own setting

    /// True if relative_l1 sets the sampling.
    bool has_goal() const { return kind != EngineKind::octree; }
};

/// The settings of a report: rays and strips by error goal and the octree by leaf size, each from
/// coarse to fine, and `auto` at the mission's goal. Leaves finer than a quarter of the finest
/// range bin are omitted: they cost much and improve nothing. The mission's own setting is included
/// and marked.
std::vector<Setting> make_settings(const Mission& mission, bool quick);

/// The error message of a mission with this setting, if the engine does not support the scene or a
/// view of its sonars; empty otherwise.
std::string unsupported(const Setting& setting, const Assembly& assembly);

// The report of speed against error: the time and the accuracy of each engine and setting for a
// mission.

/// One sonar with one setting.
struct ReportRow {
    std::string sensor;
    Setting setting;
    double ms_per_ping = 0.0;  ///< noise on, one thread; median over the poses
    double pings_per_s = 0.0;  ///< noise on, all threads
    /// Noise off; means over the poses, and the error of the worst pose.
    double relative_l1 = 0.0, worst_relative_l1 = 0.0, miss_rate = 0.0;
    double samples_per_ping = 0.0;
    /// Embree alone, with view_rays_count rays over the view, and a ping as a multiple of it. Both
    /// are CPU times, measured in turns at each pose; medians over the poses.
    double ms_rays = 0.0;
    double times_rays = 0.0;
    bool on_front = false;  ///< no setting of this sonar is both faster and more accurate

    /// "met" if the setting's goal holds at the worst pose, too, else "missed"; "-" without a goal.
    const char* goal() const {
        if (!setting.has_goal()) return "-";
        return worst_relative_l1 <= setting.relative_l1 ? "met" : "missed";
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
    double recall = 1.0;         ///< share of the exact method's bins that this one fills, too
    double precision = 1.0;      ///< share of this method's bins that the exact one fills, too
    double ms_multipath = 0.0;   ///< time of this stage, one thread; median over the poses
    double ms_per_ping = 0.0;    ///< noise on, one thread; median over the poses
    double times_without = 0.0;  ///< a multiple of the time of a ping without multipath
};

struct ReportOptions {
    int poses = 8;
    int rounds = 5;
    int threads = 0;                 ///< 0: one per core
    double reference_noise = 0.001;  ///< relative L1 at which the reference has converged
    std::uint64_t reference_rays = 200'000'000;  ///< limit per image
};

struct Report {
    std::string mission;
    std::size_t triangles = 0;  ///< copies included
    int poses = 0;
    int threads = 0;
    double load = 0.0;  ///< load average of the machine at the start
    std::vector<ReportRow> rows;
    /// The noise of the reference images of each sonar, and the rays that echoed per occupied bin.
    nlohmann::ordered_json references = nlohmann::ordered_json::array();
    std::vector<MultipathRow> multipath;  ///< only for sonars that have it
    nlohmann::ordered_json job;           ///< measure_job()
};

/// Reports progress.
using ReportProgress = std::function<void(const std::string&)>;

/// Measures every sonar of a mission with every one of `settings`, on poses sampled along the
/// trajectory. Settings take turns, so that a machine that slows down slows all of them. Errors are
/// those of the direct echoes without noise against cast_reference().
Report make_report(const Mission& mission, const Assembly& assembly,
                   std::span<const Setting> settings, const ReportOptions& options,
                   const ReportProgress& progress);

/// The multipath methods that a report compares: exact, and clusters for epsilon in {1, 3, 5, 9}
/// bins and delta in {5, 15, 30} degrees; and `own`.
std::vector<MultipathConfig> multipath_settings(const MultipathConfig& own);

/// Measures every sonar that has multipath with each of its multipath_settings(), with the engine
/// and the error goal of the mission. The methods take turns.
std::vector<MultipathRow> measure_multipath(const Mission& mission, const Assembly& assembly,
                                            const ReportOptions& options,
                                            const ReportProgress& progress);

/// Renders some pings of a mission into a temporary folder: the images per second on all threads
/// and, on one thread, the set-up and the stages of an image. `ms_rays` is the time of the rays
/// that an image is compared with.
nlohmann::ordered_json measure_job(const Mission& mission, double ms_rays,
                                   const ReportOptions& options);

/// The report as JSON, and as Markdown tables.
std::string report_json(const Report& report);
std::string report_markdown(const Report& report);

}  // namespace sonarsim
