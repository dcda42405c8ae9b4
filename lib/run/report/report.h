#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "output/dataset/json.h"
#include "simulate/assembly/assemble.h"
#include "simulate/sonar/sonar.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// One engine with one resolution.
struct Setting {
    std::string engine;  ///< "rays", "strips", "octree" or "auto"
    std::string name;    ///< its resolution, "relative_l1=0.03" or "leaf_m=0.02"
    EngineKind kind = EngineKind::rays;
    double leaf_m = EngineSettings{}.octree_leaf_m;  ///< for the octree
    double relative_l1 = 0.0;                        ///< error goal of all but the octree
    bool current = false;                            ///< the mission's own setting
};

/// The settings of a report: rays and strips by error goal and the octree by leaf size, each from
/// coarse to fine, `auto` at the mission's goal, and the mission's own, marked. Leaves finer than a
/// quarter of the finest range bin are omitted: they cost much and improve nothing.
std::vector<Setting> make_settings(const Mission& mission, bool quick);

/// The error message of the engine about the scene or the view of a sonar; "": none.
std::string unsupported(const Setting& setting, const Assembly& assembly);

struct ReportOptions {
    int poses = 8;
    int rounds = 5;
    int threads = 0;                 ///< 0: one per core
    double reference_noise = 0.001;  ///< relative L1 at which the reference has converged
    std::uint64_t reference_rays = 200'000'000;  ///< limit per image
};

using ReportProgress = std::function<void(const std::string&)>;

/// Measures every sonar of a mission with every one of `settings`, on poses sampled along the
/// trajectory. Settings take turns, so that a machine that slows down slows all of them. Errors are
/// those of the direct echoes without noise against cast_reference(). The report is the JSON that
/// is written: `triangles` with those of copies, `load` of the machine at the start, `rows` by
/// sonar and setting, `reference` by sonar: noise, and rays that echoed per occupied bin; without
/// `multipath_rows` and `job` (measure_multipath(), measure_job()).
Json make_report(const Mission& mission, const Assembly& assembly,
                 std::span<const Setting> settings, const ReportOptions& options,
                 const ReportProgress& progress);

/// The multipath methods that a report compares: exact, and clusters for epsilon in {1, 3, 5, 9}
/// bins and delta in {5, 15, 30} degrees; and `own`.
std::vector<MultipathConfig> multipath_settings(const MultipathConfig& own);

/// Measures every sonar that has multipath with each of its multipath_settings() in turns, with the
/// engine and the error goal of the mission. A row compares a method to tracing every sample, by
/// the multipath echoes only, without noise, over the bins of all poses: one may fill only a few.
std::vector<Json> measure_multipath(const Mission& mission, const Assembly& assembly,
                                    const ReportOptions& options, const ReportProgress& progress);

/// Renders some pings into a temporary folder: the images per second on all threads and, on one
/// thread, the set-up and the stages of an image, which is compared with `ms_rays` of rays.
Json measure_job(const Mission& mission, double ms_rays, const ReportOptions& options);

std::string report_json(const Json& report);
/// Tables of a report with all of its parts.
std::string report_markdown(const Json& report);

/// 0 for no values.
double median_of(std::vector<double> values);
double mean_of(const std::vector<double>& values);

/// CPU time of this thread in seconds, which stays comparable on a busy machine.
double thread_seconds_now();

/// Number of rays whose time pings are compared with: Embree alone over the same view.
inline constexpr int view_rays_count = 131'072;

/// Unit directions in the sensor frame, evenly over a view: 512 columns of 256, by column.
std::vector<Eigen::Vector3f> view_rays(const View& view);

/// The pings that every setting is measured on. Mission and scene must outlive it.
struct PingSet {
    const Mission& mission;
    const Scene& scene;
    std::vector<Pose> poses;             ///< T_world_vehicle, sampled along the trajectory
    std::vector<std::uint32_t> indices;  ///< index of each pose on the trajectory

    PingSet(const Mission& mission, const Assembly& assembly, int poses);
    /// The sonar with its per-ping settings at pose `p`.
    SonarAtPose at_pose(const Sonar& sonar, std::size_t p) const {
        return {mission, sonar, indices[p]};
    }
    PingKey key(std::size_t p) const { return {mission.seed, indices[p]}; }
};

/// The times of one setting at one pose, over all visits.
struct PoseTimes {
    std::vector<double> ping_ms;
    std::vector<double> ping_thread_ms;  ///< CPU time of the same pings
    std::vector<double> multipath_ms;    ///< time of the stage of multipath
    std::vector<double> rays_thread_ms;  ///< CPU time of Embree on view_rays()
};

/// Pings a few times and adds the times to `times`: first a ping to warm the caches after the other
/// settings, then the measured ones. A slow setting needs only one. Returns the traced surface.
TracedPing visit_pose(const PingSet& pings, const Sonar& sonar, const VisibilityEngine& engine,
                      std::size_t p, PoseTimes& times);

/// The median over the poses of the medians at each of them; milliseconds.
double over_poses(std::span<const PoseTimes> poses, std::vector<double> PoseTimes::*times_ms);

}  // namespace sonarsim
