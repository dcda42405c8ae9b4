#include "calibrated/target_pieces.h"

namespace sonarsim {

void move_to_curve(TargetPieces& pieces) {
    PatchBlock& points = pieces.points;
    const auto& [n_x, n_y, n_z] = pieces.normal;
    const auto& [flat_x, flat_y, flat_z] = pieces.flat_normal;
    for (int k = 0; k < points.count; ++k) {
        const float length = std::sqrt(n_x[k] * n_x[k] + (n_y[k] * n_y[k] + n_z[k] * n_z[k]));
        const float x = n_x[k] / length;
        const float y = n_y[k] / length;
        const float z = n_z[k] / length;
        const float off_triangle = pieces.curvature_m[k] * (1.0F - length);
        points.x[k] += off_triangle * x;
        points.y[k] += off_triangle * y;
        points.z[k] += off_triangle * z;
        const float cosine = flat_x[k] * x + (flat_y[k] * y + flat_z[k] * z);
        points.area_m2[k] = points.area_m2[k] * std::max(cosine, 0.0F) / (length * length);
        points.height_m[k] =
            std::max(-(points.x[k] * x + (points.y[k] * y + points.z[k] * z)), 0.0F);
    }
}

}  // namespace sonarsim
