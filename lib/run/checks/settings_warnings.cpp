#include <algorithm>
#include <cmath>
#include <variant>

#include "core/units.h"
#include "run/checks/find_warnings.h"
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

}  // namespace

std::vector<Warning> settings_warnings(const Mission& mission, const Assembly& assembly) {
    std::vector<Warning> out;
    for (const Sonar& sonar : assembly.sonars) {
        judge_azimuth(sonar.config, out);
        judge_ping_rate(mission, assembly.trajectory, sonar, out);
    }
    return out;
}

}  // namespace sonarsim
