#include "assembly/thin_heights.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "assembly/sample_pings.h"
#include "scene/heightmap/height_patch.h"
#include "trace/visible_surface.h"
#include "visibility/image_change.h"
#include "visibility/rays/rays_engine.h"
#include "visibility/view_parts.h"
#include "visibility/view_volume.h"

namespace sonarsim {

namespace {

// Chosen values.
constexpr int most_left_out = 16;
constexpr double share_of_goal = 0.25;  // that thinning may use
constexpr std::size_t most_poses = 3;   // for each sonar; the lowest one is added

std::vector<double> image_of(const HeightPatches& patches, const std::vector<std::size_t>& seen,
                             int every, const Sight& part) {
    const Scene scene = patches.scene(seen, every, part.T_world_sensor.translation);
    if (scene.triangles.empty()) return {};
    const auto engine = make_rays_engine(scene);
    return mean_echoes(scene, part.view, engine->visible_surface(part.view, part.T_world_sensor));
}

/// The poses of a sonar at which images are compared.
std::vector<Pose> poses_of_trial(const Sonar& sonar, const Trajectory& vehicle) {
    const auto at = [&](std::uint32_t i) {
        return sensor_pose(sonar, vehicle[i].T_world_vehicle, i);
    };
    const auto step = static_cast<std::uint32_t>(sonar.config.every);
    std::uint32_t lowest = 0;
    for (std::uint32_t i = 0; i < vehicle.size(); i += step) {
        if (vehicle[i].T_world_vehicle.translation.z() <
            vehicle[lowest].T_world_vehicle.translation.z())
            lowest = i;
    }
    std::vector<Pose> out{at(lowest)};
    for (const std::uint32_t i : sample_pings(vehicle.size(), sonar.config.every, most_poses))
        out.push_back(at(i));
    return out;
}

}  // namespace

bool may_be_thinned(const Mission& mission, const PlacedFile& map, SceneFiles& models) {
    constexpr std::size_t few_heights = std::size_t{1} << 18;
    if (!map.heightmap || !allows_thinning(mission)) return false;
    return heights_in(models.model(map)) >= few_heights;
}

bool allows_thinning(const Mission& mission) {
    const SceneConfig& scene = mission.scene;
    if (!scene.heightmap || scene.heightmap->keep == KeptHeights::all) return false;
    const bool has_truth = !mission.output.labels.empty() || !scene.scatter.empty() ||
                           std::ranges::any_of(scene.objects, [](const ObjectConfig& object) {
                               return object.place_on == ObjectPlace::on_bottom;
                           });
    return !has_truth && std::ranges::none_of(mission.sensors, [](const SonarConfig& sensor) {
        return sensor.kind == SonarKind::profiling ||
               sensor.multipath.method != MultipathMethod::none;
    });
}

Thinning thin_heights(const PlacedFile& map, std::span<const Sonar> sonars,
                      const Trajectory& vehicle, double relative_l1, ImageReader& images) {
    const HeightPatches patches(map, most_left_out, images);
    Thinning out;
    if (patches.has_unknown()) return out;
    // The greatest change if every 2nd, 4th, 8th or 16th row and column is kept.
    std::array<double, 4> change{};
    for (const Sonar& sonar : sonars) {
        View view = traced_view(sonar.settings.view, sonar.settings.guard_beams);
        view.relative_l1 = std::min(view.relative_l1, relative_l1);
        for (const Pose& pose : poses_of_trial(sonar, vehicle)) {
            for (const Sight& part : parts_of(view, pose)) {
                const ViewVolume volume(part.view, part.T_world_sensor);
                const std::vector<std::size_t> seen =
                    patches.where([&](const Eigen::Vector3d& centre, double radius_m) {
                        const Eigen::Vector3d away = centre - volume.position();
                        return volume.containment(away.cast<float>(),
                                                  static_cast<float>(radius_m)) !=
                               Containment::outside;
                    });
                const std::vector<double> whole = image_of(patches, seen, 1, part);
                for (std::size_t k = 0; k < change.size() && !whole.empty(); ++k) {
                    // Grids coarser than one that fails are not tried.
                    if (change[k] > share_of_goal * relative_l1) break;
                    change[k] = std::max(
                        change[k], image_change(image_of(patches, seen, 2 << k, part), whole));
                }
            }
        }
    }
    for (std::size_t k = 0; k < change.size(); ++k) {
        if (change[k] > share_of_goal * relative_l1) break;
        out = {2 << k, change[k]};
    }
    return out;
}

}  // namespace sonarsim
