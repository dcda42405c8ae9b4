#include "input/scene/placing/standing.h"

#include <spdlog/fmt/fmt.h>

#include "core/text.h"
#include "input/mission/scene_keys.h"
#include "input/scene/meshes/read_mesh.h"
#include "input/scene/placing/rest.h"

namespace sonarsim {

namespace {

/// True if a surface is much thinner along an axis than across it, as a plate or a sea floor.
bool is_flat(const Surface& surface, int axis) {
    constexpr double thin = 0.2;
    const Eigen::AlignedBox3d box = box_of(surface);
    if (box.isEmpty()) return false;
    const Eigen::Vector3d size = box.sizes();
    return size[axis] < thin * std::min(size[(axis + 1) % 3], size[(axis + 2) % 3]);
}

}  // namespace

bool rests_upright(const Surface& surface, int axis) {
    constexpr double low = 0.01;
    constexpr double broad = 1.0 / 3.0;
    const Eigen::AlignedBox3d box = box_of(surface);
    if (box.isEmpty()) return false;
    const double limit = box.min()[axis] + low * box.sizes()[axis];
    std::vector<Eigen::Vector3d> all;
    std::vector<Eigen::Vector3d> lowest;
    for (const Eigen::Vector3d& vertex : surface.vertices) {
        const Eigen::Vector3d visible(vertex[(axis + 1) % 3], vertex[(axis + 2) % 3], 0.0);
        all.push_back(visible);
        if (vertex[axis] <= limit) lowest.push_back(visible);
    }
    return area_of(hull_of(lowest)) >= broad * area_of(hull_of(all));
}

std::string reading_of(const PlacedFile& file) {
    const auto* const unit =
        std::ranges::find(length_unit_rows, file.unit_m, &LengthUnitRow::metres);
    return std::string(unit->plural) + (file.z_up ? ", z up" : ", y up") +
           (file.up_given ? "" : " (no `up` given)");
}

std::string up_question(const PlacedFile& file, const Surface& surface) {
    constexpr int up = 2;
    constexpr int y = 1;
    if (file.z_up || file.up_given || !is_mesh_file(file.file)) return "";
    const std::string name = printable(file.file.filename().string());
    const char* const question = " with z up: does its z point up? up: z";
    // The file's z is the world's -y.
    if (is_flat(surface, y))
        return name + " stands on its edge with y up and would lie flat" + question;
    Surface turned = surface;
    for (Eigen::Vector3d& vertex : turned.vertices)
        vertex[y] = -vertex[y];
    if (rests_upright(surface, up) || !rests_upright(turned, y)) return "";
    return name + " lies on its side with y up and would stand" + question;
}

std::string unit_question(double length_m, double unit_m, double range_m, double ranges) {
    constexpr double milli = 1e-3;
    if (unit_m == 1.0 && length_m > ranges * range_m && milli * length_m < range_m)
        return fmt::format("{:.4g} m long: millimetres? units: mm", length_m);
    if (unit_m == milli && length_m > 0.0 && length_m < milli * range_m)
        return fmt::format("{:.3g} m long: metres? units: m", length_m);
    return "";
}

}  // namespace sonarsim
