#include "checks/image_warnings.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "product/fan.h"
#include "sonar/kinds.h"

namespace sonarsim {

namespace {

// The shares from which on a user is told.
constexpr double many_lost = 0.5;
constexpr double long_noise = 0.1;         // its mean, of the range
constexpr double fewest_fan_greys = 16.0;  // of 255
constexpr double faintest = 1.0 / 65535;   // one grey level of a 16-bit image

/// How far the scene is from a sonar on its way.
struct Distances {
    double nearest_m;   ///< the least from a pose to the box around the scene
    double farthest_m;  ///< the greatest from a pose to a corner of that box
};

Distances distances(const Assembly& assembly, const Sonar& sonar) {
    const Eigen::AlignedBox3d box(assembly.scene.bounds_min, assembly.scene.bounds_max);
    Distances out{std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t i = 0; i < assembly.trajectory.size(); i += sonar.config.every) {
        const Eigen::Vector3d at =
            (assembly.trajectory[i].T_world_vehicle * sonar.T_vehicle_sensor).translation;
        out.nearest_m = std::min(out.nearest_m, box.exteriorDistance(at));
        const Eigen::Vector3d reach =
            (at - box.min()).cwiseAbs().cwiseMax((at - box.max()).cwiseAbs());
        out.farthest_m = std::max(out.farthest_m, reach.norm());
    }
    return out;
}

double share(std::uint64_t part, std::uint64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

bool noise_is_long(const SonarConfig& config) {
    return config.noise.range_lambda_m > long_noise * (config.range_max_m - config.range_min_m);
}

/// What would help a sonar that saw nothing within its range.
std::string cure_of_blindness(const Assembly& assembly, const Sonar& sonar,
                              const SensorSummary& summary) {
    const SonarConfig& config = sonar.config;
    if (assembly.scene.triangles.empty() && assembly.scene.copies.empty()) {
        return assembly.scene.bodies.empty() ? "the scene has no triangles"
                                             : "nothing of what moves came into its view";
    }
    const Distances scene = distances(assembly, sonar);
    if (scene.nearest_m > config.range_max_m) {
        return fmt::format(
            "the scene is never nearer than {:.4g} m, range_max_m is {:.4g}: check "
            "the trajectory's coordinates or raise range_max_m",
            scene.nearest_m, config.range_max_m);
    }
    if (scene.farthest_m < config.range_min_m) {
        return fmt::format("all of the scene lies within {:.4g} m, range_min_m is {:.4g}: lower it",
                           scene.farthest_m, config.range_min_m);
    }
    if (summary.counts.echoes > 0) {
        return fmt::format(
            "all of the {} echoes in its field of view lie outside {:.4g} to {:.4g} "
            "m: check range_min_m and range_max_m",
            summary.counts.echoes, config.range_min_m, config.range_max_m);
    }
    return "check its mount, the trajectory's attitudes, its field of view and range_max_m";
}

/// A sonar whose pings are dark for want of anything to see.
void judge_sight(const Assembly& assembly, const Sonar& sonar, const SensorSummary& summary,
                 std::vector<std::string>& out) {
    const SonarConfig& config = sonar.config;
    const PingCounts& counts = summary.counts;
    const double lost = share(counts.out_of_range, counts.echoes);
    if (noise_is_long(config) && lost >= many_lost) {
        out.push_back(
            fmt::format("sensor '{}': {:.1f} % of its echoes were dropped outside the range: "
                        "noise.range_lambda_m shifts them by {:.4g} m on average, and the range "
                        "is {:.4g} m long; lower it",
                        config.name, 100.0 * lost, config.noise.range_lambda_m,
                        config.range_max_m - config.range_min_m));
    } else if (summary.dark_pings == summary.pings) {
        out.push_back(fmt::format("sensor '{}' saw no surface in any of its {} pings: {}",
                                  config.name, summary.pings,
                                  cure_of_blindness(assembly, sonar, summary)));
    } else if (summary.dark_pings > 0) {
        out.push_back(
            fmt::format("sensor '{}' saw no surface in {} of its {} pings: check the "
                        "trajectory and the range",
                        config.name, summary.dark_pings, summary.pings));
    }
    if (share(counts.dropped_samples, counts.samples + counts.dropped_samples) >= many_lost) {
        out.push_back(fmt::format(
            "sensor '{}': {} of {} pieces of surface were left out, being "
            "edge-on, at no distance or lost in rounding: its beams or bins "
            "are too narrow for the scene",
            config.name, counts.dropped_samples, counts.samples + counts.dropped_samples));
    }
}

/// Pings whose error, as the engine estimates it, is above the goal.
void judge_error(const AccuracyConfig& accuracy, const Sonar& sonar, const SensorSummary& summary,
                 std::vector<std::string>& out) {
    if (summary.missed_goals == 0) return;
    out.push_back(
        fmt::format("sensor '{}': {} of {} pings miss accuracy.relative_l1 of {:.4g}, the worst by "
                    "an estimated {:.2g}: there is more detail between neighbouring beams than the "
                    "engine can follow, or surface that only just reaches into a bin",
                    sonar.config.name, summary.missed_goals, summary.pings, accuracy.relative_l1,
                    summary.worst_l1));
}

/// Images that are too dark or too bright for the scale of the pictures.
void judge_brightness(const OutputConfig& output, const Sonar& sonar, double full_scale,
                      const SensorSummary& summary, std::vector<std::string>& out) {
    const std::string& name = sonar.config.name;
    const double of_white = summary.brightest / full_scale;
    const double fan_greys = 255.0 * std::sqrt(of_white);
    // A scale that was found leaves the brightest bins white on purpose.
    if (summary.clipped_pixels > 0 && output.full_scale > 0.0) {
        out.push_back(
            fmt::format("sensor '{}': {} pixels are above output.full_scale ({:.4g}) and "
                        "white in the PNG files; the brightest is {:.4g}",
                        name, summary.clipped_pixels, full_scale, summary.brightest));
    }
    if (summary.dark_pings == summary.pings) return;  // told already
    if (summary.brightest == 0.0F) {
        out.push_back(
            fmt::format("sensor '{}' saw surface in {} bins, and all of its images are "
                        "black: the materials there reflect nothing in this water",
                        name, summary.counts.occupied_bins));
    } else if (fan_greys < fewest_fan_greys) {
        const bool has_fans = kind_of(sonar.config.kind).has_images;
        const std::string fans =
            has_fans ? fmt::format(" in images and {:.0f} of 255 in fans", fan_greys) : "";
        out.push_back(fmt::format(
            "sensor '{}': its brightest pixel is {:.3g}, grey level {:.0f} "
            "of 65535{}: lower output.full_scale from {:.4g} to about {:.1g}",
            name, summary.brightest, 65535.0 * of_white, fans, full_scale, summary.brightest));
    }
}

/// A sector too thin for a picture of it.
void judge_fan(const OutputConfig& output, const Sonar& sonar, std::vector<std::string>& out) {
    if (!output.fan || !kind_of(sonar.config.kind).has_images) return;
    const double pixel_m = fan_frame(sonar, output.fan_width_px).pixel_m;
    const double width_m = sonar.settings.view.azimuth_rad * sonar.config.range_max_m;
    if (width_m >= pixel_m) return;
    out.push_back(
        fmt::format("sensor '{}': its fans show next to nothing, for azimuth_deg of "
                    "{:.4g} is {:.2g} m wide at range_max_m and a pixel {:.2g} m; look at "
                    "the polar images, or raise output.fan_width_px",
                    sonar.config.name, sonar.config.azimuth_deg, width_m, pixel_m));
}

void judge_materials(const Mission& mission, const Scene& scene, std::vector<std::string>& out) {
    const WaterConfig& water = mission.water;
    for (const Material& material : scene.materials) {
        if (material.reflection >= faintest) continue;
        out.push_back(
            fmt::format("material '{}' ({:.6g} kg/m^3, {:.6g} m/s) reflects {:.2g} of the "
                        "power in this water ({:.6g} kg/m^3, {:.6g} m/s) and is as good "
                        "as invisible: check the materials' CSV and the water block",
                        material.name, material.density_kg_m3, material.sound_speed_m_s,
                        material.reflection, water.density_kg_m3, water.sound_speed_m_s));
    }
}

}  // namespace

std::vector<std::string> image_warnings(const Mission& mission, const Assembly& assembly,
                                        std::span<const SensorSummary> sensors) {
    std::vector<std::string> out;
    judge_materials(mission, assembly.scene, out);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        if (sensors[i].pings == 0) continue;
        judge_sight(assembly, assembly.sonars[i], sensors[i], out);
        judge_error(mission.accuracy, assembly.sonars[i], sensors[i], out);
        judge_brightness(mission.output, assembly.sonars[i], assembly.full_scales[i], sensors[i],
                         out);
        judge_fan(mission.output, assembly.sonars[i], out);
    }
    return out;
}

}  // namespace sonarsim
