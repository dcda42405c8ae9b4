#include "run/checks/find_warnings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <variant>

#include "core/units.h"
#include "simulate/sonar/kinds.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

namespace {

/// W38: a kind of sonar whose usual sector is wide has one of few degrees, as by radians.
void judge_azimuth(const SonarConfig& config, std::vector<Warning>& out) {
    constexpr double min_rad = 0.3;
    constexpr double max_rad = 2.0 * pi;
    const SonarKeys& keys = kind_of(config.kind).keys;
    if (!keys.azimuth || keys.defaults.azimuth_deg <= max_rad) return;
    if (config.azimuth_deg < min_rad || config.azimuth_deg > max_rad) return;
    out.push_back(make_warning(WarningCode::azimuth_in_radians, about_sensor(config.name),
                               config.azimuth_deg, degrees(config.azimuth_deg)));
}

/// The time from the begin of a ping until its sound is back from the greatest range, s.
double ping_time_s(const Sonar& sonar, double sound_speed_m_s) {
    return (sonar.config.shutter.groups - 1) * group_period_s(sonar, sound_speed_m_s) +
           2.0 * sonar.config.range_max_m / sound_speed_m_s;
}

/// W39: pings that begin before the sound of the ping before is back. The poses of
/// trajectory.look_at have no times of their own.
void judge_ping_rate(const Mission& mission, const Trajectory& trajectory, const Sonar& sonar,
                     std::vector<Warning>& out) {
    if (std::holds_alternative<LookAtTrajectoryConfig>(mission.trajectory)) return;
    constexpr double rounding = 1e-6;
    const double needed_s = ping_time_s(sonar, mission.water.sound_speed_m_s);
    const auto every = static_cast<std::size_t>(sonar.config.every);
    std::size_t early = 0;
    double least_s = needed_s;
    for (std::size_t i = every; i < trajectory.size(); i += every) {
        const double interval_s = trajectory[i].t_s - trajectory[i - every].t_s;
        if (interval_s >= needed_s * (1.0 - rounding)) continue;
        ++early;
        least_s = std::min(least_s, interval_s);
    }
    if (early == 0) return;
    out.push_back(make_warning(WarningCode::ping_too_early, about_sensor(sonar.config.name), early,
                               (trajectory.size() - 1) / every, 1.0 / least_s,
                               sonar.config.range_max_m, 1.0 / needed_s,
                               static_cast<double>(every) * std::ceil(needed_s / least_s)));
}

void append(std::vector<Warning>& out, std::vector<Warning> more) {
    std::ranges::move(more, std::back_inserter(out));
}

// An estimate, not a measurement: surface in every bin, at an error goal of 1 %.
constexpr double samples_per_bin = 4.0;
// Also an estimate: the image, all labels and the encoded files.
constexpr double bytes_per_bin = 64.0;

}  // namespace

std::vector<Warning> warnings_before_pings(const Mission& mission, const Assembly& assembly) {
    std::vector<Warning> out = reading_warnings(assembly.scene);
    append(out, material_warnings(mission.water, assembly.scene));
    for (const Sonar& sonar : assembly.sonars) {
        judge_azimuth(sonar.config, out);
        judge_ping_rate(mission, assembly.trajectory, sonar, out);
    }
    return out;
}

std::vector<Warning> find_warnings(const Mission& mission, const Assembly& assembly,
                                   std::span<const SonarSurvey> sonars,
                                   const VisibilityEngine& rays) {
    std::vector<Warning> out = warnings_before_pings(mission, assembly);
    append(out, scene_warnings(mission, assembly, sonars));
    for (std::size_t i = 0; i < sonars.size(); ++i) {
        append(out, sonar_warnings(mission.output, assembly.sonars[i], assembly.full_scales[i],
                                   sonars[i]));
    }
    append(out, hidden_objects(mission, assembly, sonars, rays));
    return out;
}

PingMemory ping_memory(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    const double bins = view.range_bins;
    const double visible_per_beam = bins * samples_per_bin * sizeof(Sample);
    const double image = view.beams * (visible_per_beam + bins * bytes_per_bin);
    const double guards = 2.0 * view.guards.count * visible_per_beam;
    const EchoModelInfo& model = sonar.settings.model->info;
    const double working =
        model.working_bytes + (sonar.settings.multipath.on ? model.multipath_bytes : 0.0);
    PingMemory out{.bytes = image + guards + working, .key = "range_bins"};
    if (guards > std::max(image, working))
        out.key = "instrument.beam.view_azimuth_deg";
    else if (image > working && view.beams > view.range_bins)
        out.key = "azimuth_bins";
    return out;
}

std::vector<Warning> memory_warnings(const std::vector<Sonar>& sonars, int threads,
                                     double available) {
    constexpr double giga = 1e9;
    std::vector<Warning> out;
    for (const Sonar& sonar : sonars) {
        const PingMemory ping = ping_memory(sonar);
        if (threads * ping.bytes <= available) continue;
        out.push_back(make_warning(WarningCode::memory, about_sensor(sonar.config.name),
                                   ping.bytes / giga, threads, threads * ping.bytes / giga,
                                   available / giga, ping.key));
    }
    return out;
}

bool exceeds_memory(const std::vector<Sonar>& sonars, double available) {
    return std::ranges::any_of(
        sonars, [&](const Sonar& sonar) { return ping_memory(sonar).bytes > available; });
}

}  // namespace sonarsim
