#include "simulate/visibility/view.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

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

}  // namespace sonarsim
