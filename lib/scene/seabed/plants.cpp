#include "scene/seabed/plants.h"

#include "core/elementary.h"
#include "core/units.h"
#include "scene/seabed/patches.h"

namespace sonarsim {

std::vector<Plant> plants_in(const BedArea& area, const BedGrid& grid, const BedPlants& plants,
                             std::uint64_t seed) {
    if (!(plants.share > 0.0)) return {};
    const PhiloxKey key = bed_key(seed, BedDraw::plants);
    const std::vector<float> here =
        patches(grid, plants.share, plants.patch_m, bed_key(seed, BedDraw::plant_patches));
    std::vector<Plant> out;
    const auto grows = [&](const BedPoint& point) {
        const float share = here[grid.cell_at(point.x_m, point.y_m)];
        return share > 0.0F && draw_of(point, 1, key) < static_cast<double>(share);
    };
    for (const BedPoint& point : poisson_points(area, plants.density_per_m2, key, grows))
        out.push_back({point.x_m, point.y_m, draw_in(plants.height_m, point, 2, key), point});
    return out;
}

void add_leaves(const Plant& plant, const Eigen::Vector3d& foot, std::uint64_t seed,
                Surface& surface) {
    // These three are chosen so that tufts look like sea grass. They have no source.
    constexpr std::uint32_t leaves = 6;
    constexpr double width = 0.08;  // width of a leaf / height of the tuft
    constexpr double most_lean = radians(35.0);
    const PhiloxKey key = bed_key(seed, BedDraw::plants);
    for (std::uint32_t n = 0; n < leaves; ++n) {
        const double turns = (n + draw_of(plant.point, 3 + 2 * n, key)) / leaves;
        const SinCos turn = sincos(2.0 * pi * turns);
        const SinCos lean = sincos(most_lean * draw_of(plant.point, 4 + 2 * n, key));
        const Eigen::Vector3d outwards(turn.cos, turn.sin, 0.0);
        const Eigen::Vector3d aside(-turn.sin, turn.cos, 0.0);
        const Eigen::Vector3d root = foot + width * plant.height_m * outwards;
        const auto first = static_cast<std::uint32_t>(surface.vertices.size());
        surface.vertices.push_back(root - 0.5 * width * plant.height_m * aside);
        surface.vertices.push_back(root + 0.5 * width * plant.height_m * aside);
        surface.vertices.push_back(
            root + plant.height_m * (lean.sin * outwards + lean.cos * Eigen::Vector3d::UnitZ()));
        surface.triangles.push_back({first, first + 1, first + 2});
    }
}

}  // namespace sonarsim
