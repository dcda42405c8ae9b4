#include "trace/coherent_surface.h"

#include <Eigen/Geometry>
#include <array>

namespace sonarsim {

PlateOfPing plate_along(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                        const Eigen::Vector3d& across, double left_m, double right_m) {
    const std::array<Eigen::Vector3d, 4> corners{from - left_m * across, to - left_m * across,
                                                 to + right_m * across, from + right_m * across};
    PlateOfPing out;
    for (std::size_t k = 0; k < 4; ++k)
        out.edges.push_back({corners[k], corners[(k + 1) % 4]});
    out.normal = across.cross(to - from).normalized();
    out.height_m = out.normal.dot(from);
    if (out.height_m < 0.0) {
        out.normal = -out.normal;
        out.height_m = -out.height_m;
    }
    return out;
}

}  // namespace sonarsim
