#include "assembly/water_ages.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "calibrated/line_array.h"
#include "calibrated/pulse_band.h"
#include "core/elementary.h"
#include "core/units.h"
#include "sonar/sonar_at_pose.h"

namespace sonarsim {

namespace {

/// The growth of the speckle's age per second, metre and radian.
struct AgeScales {
    double per_s, per_m, per_rad;
};

AgeScales age_scales(const Sonar& sonar, const WaterConfig& water) {
    const InstrumentConfig& instrument = sonar.config.instrument;
    const double wavelength_m = water.sound_speed_m_s / instrument.frequency_hz;
    const double width_rad = radians(instrument.beam.width_deg);
    const double half_array_m =
        0.5 * wavelength_m * line_array(width_rad, instrument.beam.side_lobe_db).wavelengths;
    const double pulse_m =
        std::max(instrument.pulse.resolution_m, sample_m(sonar.settings.view, instrument.receiver));
    // 2 / pi times 2 k u.
    return {.per_s = 8.0 * *water.drift_rms_m_s / wavelength_m,
            .per_m = 1.0 / std::min(half_array_m, pulse_m),
            .per_rad = 1.0 / width_rad};
}

/// Beyond this age the speckle is independent anyway.
constexpr double max_step = 2.0;

/// `to` is the later pose.
double age_between(const AgeScales& scales, const Pose& from, const Pose& to, double time_s,
                   const Eigen::Vector3d& current_m_s) {
    const Eigen::Quaterniond turn = from.rotation.conjugate() * to.rotation;
    const double angle = 2.0 * arctan2(turn.vec().norm(), std::fabs(turn.w()));
    const double by_time = scales.per_s * time_s;
    const double by_way =
        scales.per_m * (to.translation - from.translation - time_s * current_m_s).norm();
    const double by_turn = scales.per_rad * angle;
    return std::min(max_step, std::sqrt(by_time * by_time + by_way * by_way + by_turn * by_turn));
}

}  // namespace

void add_water_ages(const Mission& mission, const Trajectory& trajectory, std::span<Sonar> sonars) {
    if (!mission.water.drift_rms_m_s) return;
    const Eigen::Vector3d current_m_s(mission.water.current_m_s.data());
    for (Sonar& sonar : sonars) {
        if (sonar.config.model != ModelKind::calibrated ||
            sonar.config.instrument.speckle.mode == SpeckleMode::ping)
            continue;
        const AgeScales scales = age_scales(sonar, mission.water);
        // From ping to ping: what `vary` draws for the poses between two pings moves nothing.
        const auto every = static_cast<std::size_t>(sonar.config.every);
        std::vector<double> ages(trajectory.size());
        Pose before;
        for (std::size_t k = 0; k < trajectory.size(); k += every) {
            const auto pose = static_cast<std::uint32_t>(k);
            const Pose at = sensor_pose(*SonarAtPose(mission, sonar, pose),
                                        trajectory[k].T_world_vehicle, pose);
            if (k > 0) {
                const double time_s = trajectory[k].t_s - trajectory[k - every].t_s;
                ages[k] = ages[k - every] + age_between(scales, before, at, time_s, current_m_s);
            }
            before = at;
        }
        sonar.water_ages = std::make_shared<const std::vector<double>>(std::move(ages));
    }
}

}  // namespace sonarsim
