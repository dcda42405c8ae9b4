#include "surface/view.h"

#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

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

}  // namespace sonarsim
