#include "input/scene/placing/standing.h"

#include <vector>

#include "core/text.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/placing/hull.h"

namespace sonarsim {

bool rests_upright(const Surface& surface, int axis) {
    constexpr double low = 0.01;
    constexpr double broad = 1.0 / 3.0;
    const Eigen::AlignedBox3d box = box_of(surface);
    if (box.isEmpty()) return false;
    const double limit = box.min()[axis] + low * box.sizes()[axis];
    std::vector<Eigen::Vector3d> all;
    std::vector<Eigen::Vector3d> lowest;
    for (const Eigen::Vector3d& vertex : surface.vertices) {
        const Eigen::Vector3d seen(vertex[(axis + 1) % 3], vertex[(axis + 2) % 3], 0.0);
        all.push_back(seen);
        if (vertex[axis] <= limit) lowest.push_back(seen);
    }
    return area_of(hull_of(lowest)) >= broad * area_of(hull_of(all));
}

std::string up_question(const PlacedFile& file, const Surface& surface) {
    constexpr int up = 2;
    constexpr int y = 1;
    if (file.z_up || !is_mesh_file(file.file)) return "";
    // The file's z is the world's -y.
    Surface turned = surface;
    for (Eigen::Vector3d& vertex : turned.vertices)
        vertex[y] = -vertex[y];
    if (rests_upright(surface, up) || !rests_upright(turned, y)) return "";
    return printable(file.file.filename().string()) +
           " lies on its side with y up and would stand with z up: does its z point up? up: z";
}

}  // namespace sonarsim
