#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "assembly/assemble.h"
#include "benchmark/spread.h"
#include "mission/mission.h"

namespace sonarsim {

// The report of speed against error: what each choice of engine costs a mission, in time and in
// accuracy.

/// One engine at one degree of fineness.
struct Setting {
    /// "rays", "slices", "octree", or "literal": the octree to the letter of the paper.
    std::string engine;
    std::string name;  ///< the key of the mission that makes it, "relative_l1=0.03"
    EngineKind kind = EngineKind::rays;
    OctreeConfig octree;       ///< what an octree is built with
    double relative_l1 = 0.0;  ///< the error goal that rays and slices follow
    bool current = false;      ///< what the mission itself uses
    SlicesConfig slices = {};  ///< what slices are built with

    /// Rays and slices promise an error of at most relative_l1 on every ping, unless the mission
    /// says how many slices there are.
    bool promises() const {
        return kind == EngineKind::rays || (kind == EngineKind::slices && slices.per_beam == 0);
    }
};

/// What a setting costs in a process of its own.
struct ColdStart {
    double build_s = 0.0;           ///< of the engine, before the first ping
    double first_ping_s = 0.0;      ///< from the start of the program to the end of the first ping
    double slowest_ms = 0.0;        ///< the slowest of the pings after it, one per pose
    double peak_memory_mb = 0.0;    ///< of the process: scene, engine and pings; MiB
    double engine_memory_mb = 0.0;  ///< of that, the nodes of the octree; 0 for the rays
};

/// One sonar with one setting.
struct ReportRow {
    std::string sensor;
    Setting setting;
    Spread ms_per_ping;                                      ///< noise on, one thread
    double pings_per_s = 0.0;                                ///< noise on, all threads
    Spread relative_l1, relative_l2, miss_rate, false_rate;  ///< noise off
    bool warned = false;  ///< the engine warned at one of the poses
    Spread samples_per_ping;
    ColdStart cold;
    PingSeconds stages;    ///< medians over the poses
    double ms_bare = 0.0;  ///< the same: Embree alone, one ray to every sample
    /// Embree alone, view_rays_count rays over the view, and a ping over them: both of the
    /// processor, in turns at each pose. Medians over the poses.
    double ms_rays = 0.0;
    double times_rays = 0.0;
    bool on_front = false;  ///< no setting of this sonar is both faster and more accurate

    /// Whether the setting kept its promise: "met" at the worst pose, too, "warned" that it was
    /// not, or "missed" it in silence; "-" where it makes none.
    const char* promise() const {
        if (!setting.promises()) return "-";
        if (relative_l1.max <= setting.relative_l1) return "met";
        return warned ? "warned" : "missed";
    }
};

/// One sonar with one way to find its multipath echoes, against tracing every sample by itself. The
/// errors are those of the multipath echoes alone, without noise, over the bins of all poses
/// together: single poses may light only a few.
struct MultipathRow {
    std::string sensor;
    MultipathConfig setting;       ///< the exact method has 0 for epsilon and delta
    bool current = false;          ///< what the mission itself uses
    std::uint64_t exact_bins = 0;  ///< that the exact method lights
    double relative_l1 = 0.0;
    double recall = 1.0;      ///< share of the bins that the exact method lights
    double precision = 1.0;   ///< share of the bins lit here that the exact method lights too
    Spread ms_multipath;      ///< of this stage, over the poses; one thread
    Spread ms_per_ping;       ///< noise on, one thread
    double ms_without = 0.0;  ///< the ping without multipath, the median over the poses
    double speed_up = 0.0;    ///< of this stage, over the exact method

    double times_without() const { return ms_without > 0.0 ? ms_per_ping.centre / ms_without : 0; }
};

/// How far the truth of a sonar's images has converged.
struct ReferenceQuality {
    std::string sensor;
    Spread moved;         ///< Reference::moved
    Spread apart;         ///< Reference::apart
    Spread rays_per_bin;  ///< rays that echoed, per occupied bin
};

/// How the time per ping grows with the scene.
struct Growth {
    std::string sensor;
    std::string engine;
    std::string along;  ///< "detail": more triangles on the same shape; "area": the same density
    std::vector<double> triangles;
    std::vector<double> ms_per_ping;
    double exponent = 0.0;  ///< of ms per ping ~ triangles^exponent
};

struct ReportOptions {
    int poses = 8;
    int rounds = 5;
    int threads = 0;                 ///< 0: one per core
    double reference_moved = 0.001;  ///< relative L1 at which the reference has converged
    std::uint64_t reference_rays = 200'000'000;  ///< and where it gives up, per image
};

struct Report {
    std::string mission;
    std::size_t triangles = 0;  ///< each as often as it is placed
    int poses = 0;
    int threads = 0;
    double goal = 0.0;  ///< accuracy.relative_l1 of the mission
    double load = 0.0;  ///< the machine's load average before it began
    std::vector<ReportRow> rows;
    std::vector<ReferenceQuality> references;  ///< one per sonar
    std::vector<Growth> growth;
    std::vector<MultipathRow> multipath;  ///< of the sonars that have it
};

/// Says what the report is at.
using ReportProgress = std::function<void(const std::string&)>;

/// Measures every sonar of a mission with every one of `settings`, on poses spread along the
/// trajectory. Settings take turns: a machine that slows down slows them all. Errors are those of
/// the direct echoes without noise against cast_reference. `cold` has a ColdStart per setting and
/// sonar (sonars within settings) or is empty, for zeros.
Report make_report(const Mission& mission, const Assembly& assembly,
                   std::span<const Setting> settings, std::span<const ColdStart> cold,
                   const ReportOptions& options, const ReportProgress& progress);

/// The sonar as the setting has it.
Sonar with_setting(const Sonar& sonar, const Setting& setting);

}  // namespace sonarsim
