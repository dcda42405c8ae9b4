#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "checks/find_warnings.h"
#include "core/text.h"
#include "core/units.h"
#include "mission/scattering_water.h"

namespace sonarsim {

namespace {

/// The degrees of an angle that was probably typed in radians: a multiple of 90 to 0.1 %, or a
/// multiple of 5 to 0.05 % if it has three decimals or more. 0 for any other angle.
double meant_degrees(double value) {
    constexpr double full_turn_rad = 2.0 * pi;
    const double angle = std::fabs(value);
    const double step = 5.0;
    const double meant = step * std::round(degrees(angle) / step);
    if (meant == 0.0 || angle > 1.001 * full_turn_rad) return 0.0;
    const double off = std::fabs(degrees(angle) - meant) / meant;
    if (std::remainder(meant, 90.0) == 0.0) return off < 1e-3 ? meant : 0.0;
    const bool two_decimals = std::fabs(std::remainder(angle, 0.01)) < 1e-9;
    return off < 5e-4 && !two_decimals ? meant : 0.0;
}

/// W22 for a key if all of its angles that are not 0 look like radians.
void judge_angles(const std::string& about, const char* key, std::span<const double> angles_deg,
                  std::vector<Warning>& out) {
    double typed = 0.0;
    for (const double angle : angles_deg) {
        if (angle == 0.0) continue;
        if (meant_degrees(angle) == 0.0) return;
        typed = std::fabs(angle);
    }
    if (typed == 0.0) return;
    out.push_back(
        make_warning(WarningCode::radians, about, fmt::format("the angles of its {}", key),
                     fmt::format("{:.6g} rad are {:.0f} degrees", typed, meant_degrees(typed))));
}

void judge_sonar_angles(const SonarConfig& sensor, std::vector<Warning>& out) {
    const std::string about = about_sensor(sensor.name);
    judge_angles(about, "mount.rpy_deg", sensor.mount.rpy_deg, out);
    judge_angles(about, "azimuth_deg", {&sensor.azimuth_deg, 1}, out);
    judge_angles(about, "elevation_deg", {&sensor.elevation_deg, 1}, out);
    judge_angles(about, "opening_deg", {&sensor.opening_deg, 1}, out);
    judge_angles(about, "sector_deg", {&sensor.sector_deg, 1}, out);
}

std::string name_of(const ObjectConfig& object) {
    return "object '" +
           printable(object.name.empty() ? object.file.filename().string() : object.name) + "'";
}

/// Warns of a height of an object on the bottom, since it is not used.
void judge_height(const ObjectConfig& object, std::vector<Warning>& out) {
    const double z_m = object.position_m[2];
    if (object.place_on != ObjectPlace::on_bottom || z_m == 0.0) return;
    out.push_back(make_warning(
        WarningCode::reading, name_of(object),
        fmt::format("its z of {:.6g} m has no effect, since place: on_bottom finds the height; "
                    "write 0 (bury_m lowers or raises the object), or place: free",
                    z_m)));
}

bool has_calibrated(const Mission& mission) {
    return std::ranges::any_of(mission.sensors, [](const SonarConfig& sensor) {
        return sensor.model == ModelKind::calibrated;
    });
}

/// Warns of water that scatters if all sonars use the paper's model, which has no echo of the
/// water.
void judge_water(const Mission& mission, std::vector<Warning>& out) {
    if (!scatters(mission.water) || has_calibrated(mission)) return;
    out.push_back(make_warning(WarningCode::reading, "water",
                               "its scattering has no effect because no sensor has model: "
                               "calibrated: set sensors.NAME.model"));
}

/// Warns if the depth of the water, which decides on absorption and on sound_speed_m_s: auto, is
/// far from the vehicle's. Fifty metres change the speed by 0.8 m/s. Only a trajectory that lies
/// wholly below the surface shows where the surface is.
void judge_depth(const Mission& mission, const Trajectory& trajectory, std::vector<Warning>& out) {
    constexpr double least_m = 50.0;
    if (!has_calibrated(mission)) return;
    const auto& surface = mission.scene.water_surface;
    double sum_m = 0.0;
    for (const TimedPose& pose : trajectory) {
        const double depth_m =
            (surface ? surface->height_m : 0.0) - pose.T_world_vehicle.translation.z();
        if (depth_m < 0.0) return;
        sum_m += depth_m;
    }
    const double mean_m = sum_m / static_cast<double>(trajectory.size());
    if (std::fabs(mean_m - mission.water.depth_m) < least_m) return;
    out.push_back(make_warning(
        WarningCode::reading, "water",
        fmt::format("depth_m is {:.4g}, and the vehicle is {:.4g} m below {}; absorption follows "
                    "from depth_m: write the depth there",
                    mission.water.depth_m, mean_m,
                    surface ? "scene.water_surface" : "z = 0, where z < 0 puts the surface")));
}

}  // namespace

std::vector<Warning> mission_warnings(const Mission& mission, const Trajectory& trajectory) {
    std::vector<Warning> out;
    for (const SonarConfig& sensor : mission.sensors)
        judge_sonar_angles(sensor, out);
    for (const ObjectConfig& object : mission.scene.objects) {
        judge_angles(name_of(object), "rpy_deg", object.rpy_deg, out);
        judge_height(object, out);
    }
    judge_depth(mission, trajectory, out);
    judge_water(mission, out);
    return out;
}

}  // namespace sonarsim
