#include "simulate/visibility/view.h"

#include <algorithm>

#include "core/units.h"

namespace sonarsim {

namespace {

/// Adds `count` columns of equal width that together cover [low, high] across.
void add_columns(int beam, double low, double high, int count, double along_min, double along_max,
                 std::vector<ViewColumn>& out) {
    const double width = (high - low) / count;
    for (int c = 0; c < count; ++c) {
        out.push_back({beam, low + (c + 0.5) * width, width, along_min, along_max});
    }
}

}  // namespace

bool is_full_turn(const View& view) {
    return view.shape == ViewShape::fan && view.azimuth_rad >= 2.0 * pi;
}

double resolved_width_rad(const View& view) {
    // Parts of the view of one or two beams: each is half a beamwidth or less in the presets.
    constexpr double min_parts = 32.0;
    if (view.shape != ViewShape::fan) return view.elevation_rad / min_parts;
    return view.azimuth_rad / std::max<double>(min_parts, view.beams);
}

int beam_of(const View& view, const Eigen::Vector3f& point) {
    const double ground = std::sqrt(static_cast<double>(point.x()) * point.x() +
                                    static_cast<double>(point.y()) * point.y());
    if (view.shape == ViewShape::cone) {
        const double off_axis = std::sqrt(static_cast<double>(point.y()) * point.y() +
                                          static_cast<double>(point.z()) * point.z());
        return arctan2(off_axis, point.x()) <= 0.5 * view.azimuth_rad ? 0 : -1;
    }
    const double elevation = arctan2(point.z(), ground) / view.elevation_rad + 0.5;
    const double azimuth = arctan2(point.y(), point.x()) / view.azimuth_rad + 0.5;
    if (!(elevation >= 0.0 && elevation < 1.0 && azimuth >= 0.0 && azimuth < 1.0)) return -1;
    return static_cast<int>(azimuth * view.beams);
}

BeamLocator::BeamLocator(const View& view)
    : cone_(view.shape == ViewShape::cone),
      beams_(static_cast<float>(view.beams)),
      beams_per_rad_(cone_ ? 0.0F : static_cast<float>(view.beams / view.azimuth_rad)),
      half_sine_(
          static_cast<float>(sincos(0.5 * (cone_ ? view.azimuth_rad : view.elevation_rad)).sin)) {}

float BeamLocator::beam(const Eigen::Vector3f& point, float range_m) const {
    const float edge = range_m * half_sine_;
    if (cone_) {
        // Uses the sine: in float the cosine of a tenth of a degree is 1.
        const float off_axis2 = point.y() * point.y() + point.z() * point.z();
        return point.x() >= 0.0F && off_axis2 <= edge * edge ? 0.5F : -1.0F;
    }
    if (!(point.z() >= -edge && point.z() < edge)) return -1.0F;
    const float beam = arctan2_float(point.y(), point.x()) * beams_per_rad_ + 0.5F * beams_;
    return beam >= 0.0F && beam < beams_ ? beam : -1.0F;
}

ViewVolume::ViewVolume(const View& view, const Pose& T_local_sensor)
    : R_sensor_local_(T_local_sensor.rotation.toRotationMatrix().transpose().cast<float>()),
      position_(T_local_sensor.translation),
      reach_m_(static_cast<float>(view.range_max_m)) {
    const SinCos azimuth = sincos(0.5 * view.azimuth_rad);
    const SinCos elevation = sincos(0.5 * view.elevation_rad);
    sin_azimuth_ = static_cast<float>(azimuth.sin);
    cos_azimuth_ = static_cast<float>(azimuth.cos);
    sin_elevation_ = static_cast<float>(elevation.sin);
    cos_elevation_ = static_cast<float>(elevation.cos);
}

Containment ViewVolume::contains_in_sensor_frame(const Eigen::Vector3f& p, float radius) const {
    const float beyond_reach = p.norm() - reach_m_;
    // Distances from the half plane of the outermost azimuth and from the cone of the outermost
    // elevation, positive outside; symmetry reduces both to one side.
    const float beyond_azimuth = std::fabs(p.y()) * cos_azimuth_ - p.x() * sin_azimuth_;
    const float rho = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const float beyond_elevation = std::fabs(p.z()) * cos_elevation_ - rho * sin_elevation_;
    const float beyond = std::max({beyond_reach, beyond_azimuth, beyond_elevation});
    if (beyond > radius) return Containment::outside;
    return beyond < -radius ? Containment::inside : Containment::partly;
}

std::vector<ViewColumn> view_columns(const View& view, int per_beam) {
    const double half_azimuth = 0.5 * view.azimuth_rad;
    const double half_elevation = 0.5 * view.elevation_rad;
    std::vector<ViewColumn> out;
    switch (view.shape) {
        case ViewShape::fan:
            for (int j = 0; j < view.beams; ++j) {
                const double width = view.azimuth_rad / view.beams;
                add_columns(j, -half_azimuth + j * width, -half_azimuth + (j + 1) * width, per_beam,
                            -half_elevation, half_elevation, out);
            }
            break;
        case ViewShape::port_starboard:
            add_columns(0, -half_elevation, half_elevation, per_beam, -half_azimuth, 0.0, out);
            add_columns(1, -half_elevation, half_elevation, per_beam, 0.0, half_azimuth, out);
            break;
        case ViewShape::cone:
            add_columns(0, -pi, pi, per_beam, 0.0, half_azimuth, out);
            break;
    }
    return out;
}

}  // namespace sonarsim
