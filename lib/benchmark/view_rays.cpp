#include "benchmark/view_rays.h"

#include "visibility/angles.h"

namespace sonarsim {

std::vector<Eigen::Vector3f> view_rays(const View& view) {
    constexpr int columns = 512;
    constexpr int count = view_rays_count / columns;
    View cut = view;
    if (view.shape == ViewShape::fan) cut.beams = columns;
    const int per_beam = columns / cut.beams;
    std::vector<Eigen::Vector3f> out;
    out.reserve(view_rays_count);
    for (const ViewColumn& column : view_columns(cut, per_beam)) {
        const double step = (column.along_max - column.along_min) / count;
        const SinCosFloat across = sincos_float(column.across);
        for (int i = 0; i < count; ++i) {
            const SinCosFloat along = sincos_float(column.along_min + (i + 0.5) * step);
            out.push_back(direction(view.shape, across, along));
        }
    }
    return out;
}

}  // namespace sonarsim
