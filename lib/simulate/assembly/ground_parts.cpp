#include <variant>

#include "core/error.h"
#include "input/scene/seabed/seabed.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/assembly/scene_parts.h"
#include "simulate/assembly/sound_profiles.h"
#include "simulate/water/sound_profile.h"

namespace sonarsim {

namespace {

void announce_large(const BedGrid& grid, const std::function<void(const std::string&)>& announce) {
    // Measured with 5,000 x 5,000 heights, until the first ping.
    constexpr double seconds = 1e-6;
    constexpr double bytes = 125.0;
    constexpr double min_seconds = 4.0;
    const auto heights = static_cast<double>(grid.size());
    if (seconds * heights < min_seconds) return;
    announce(
        fmt::format("scene.seabed: {} x {} heights take about {:.0f} s and {:.1f} GB before "
                    "the first ping; a larger cell_m takes less",
                    grid.columns, grid.rows, seconds * heights, 1e-9 * bytes * heights));
}

/// A box around the ground that objects at rest may stand on; world x and y. Empty: there are none.
Eigen::AlignedBox2d ground_of_objects(const SceneConfig& scene, SceneStore& models) {
    Eigen::AlignedBox2d ground;
    for (const ObjectConfig& object : scene.objects) {
        if (object.trajectory) continue;
        const Eigen::Affine3d T_world_file = transform_of(object);
        double reach_m = 0.0;
        for (const Eigen::Vector3d& vertex : models.shape(file_of(object), object.mesh).vertices) {
            ground.extend((T_world_file * vertex).head<2>());
            reach_m = std::max(reach_m, object.scale * vertex.norm());
        }
        if (!object.align) continue;
        // A slope turns it about the origin of its file.
        const Eigen::Vector2d at(object.position_m.data());
        ground.extend(Eigen::AlignedBox2d(at.array() - reach_m, at.array() + reach_m));
    }
    for (const ScatterConfig& scatter : scene.scatter) {
        if (!scatter.area_min_m) continue;
        ground.extend(Eigen::Vector2d(scatter.area_min_m->data()));
        ground.extend(Eigen::Vector2d(scatter.area_max_m->data()));
    }
    return ground;
}

/// The part of a heightmap over a box of the world.
PlacedFile heightmap_of(const HeightmapConfig& heightmap, const Eigen::AlignedBox2d& needed) {
    PlacedFile map = file_of(heightmap);
    const Eigen::Vector2d origin(heightmap.origin_m.data());
    const Eigen::Vector2d low = needed.min() + origin;
    const Eigen::Vector2d high = needed.max() + origin;
    map.heightmap->window = {low.x(), low.y(), high.x(), high.y()};
    return map;
}

/// The placed seabed of a mission, made above `needed`, world x and y. `announce` may be null.
PlacedFile seabed_of(const SeabedConfig& config, std::uint64_t seed,
                     const Eigen::AlignedBox2d& needed,
                     const std::function<void(const std::string&)>& announce) {
    // A rock beyond the ranges may reach into them.
    const double margin_m = config.rocks ? 0.5 * config.rocks->diameter_m[1] : 0.0;
    const Eigen::AlignedBox2d window(needed.min().array() - margin_m,
                                     needed.max().array() + margin_m);
    if (announce) announce_large(grid_of(config, window), announce);
    PlacedFile file{.file = "scene.seabed", .z_up = true, .place = config.place};
    file.seabed = std::make_shared<const Seabed>(make_seabed(config, seed, window));
    return file;
}

/// The greatest speed of sound over that by which sonars measure ranges, or 1 if that is more.
double faster_sound(const Mission& mission) {
    if (!mission.water.profile) return 1.0;
    const SoundProfile profile = sound_profile(mission);
    return std::max(std::ranges::max(profile.speed_m_s) / profile.range_speed_m_s, 1.0);
}

/// A box around the ground that a ping may receive or an object may stand on; world x and y.
Eigen::AlignedBox2d needed_ground(const Mission& mission, const Trajectory& vehicle,
                                  std::span<const Sonar> sonars, SceneStore& models) {
    Eigen::AlignedBox2d ground = ground_of_objects(mission.scene, models);
    if (const auto* look_at = std::get_if<LookAtTrajectoryConfig>(&mission.trajectory)) {
        if (ground.isEmpty()) {
            throw InputError(mission.scene.place,
                             "trajectory.look_at: a heightmap or a made sea bed has no objects "
                             "at rest; add scene.objects or scene.scatter");
        }
        const double reach_m =
            look_at->range_m[1] + faster_sound(mission) * farthest_range_m(mission);
        return {ground.min().array() - reach_m, ground.max().array() + reach_m};
    }
    ground.extend(ground_in_range(mission, sonars, vehicle, faster_sound(mission)));
    return ground;
}

}  // namespace

Eigen::AlignedBox2d ground_in_range(const Mission& mission, std::span<const Sonar> sonars,
                                    const Trajectory& vehicle, double faster) {
    Eigen::AlignedBox2d visible;
    for (const Sonar& sonar : sonars) {
        const double reach_m = faster * sonar.settings.view.range_max_m;
        const auto extend = [&](const Pose& at) {
            const Eigen::Vector2d place = at.translation.head<2>();
            visible.extend(Eigen::AlignedBox2d(place.array() - reach_m, place.array() + reach_m));
        };
        const int later_groups = sonar.config.shutter.groups - 1;
        for (std::size_t i = 0; i < vehicle.size(); ++i) {
            const auto pose = static_cast<std::uint32_t>(i);
            const SonarAtPose then(mission, sonar, pose);
            const Pose at = sensor_pose(*then, vehicle[i].T_world_vehicle, pose);
            extend(at);
            if (!sonar.motions || later_groups == 0) continue;
            const PingMotion& motion = (*sonar.motions)[i];
            if (motion.is_still()) continue;
            const double last_s = later_groups * group_period_s(sonar, motion.sound_speed_m_s);
            extend(pose_after(motion, at, last_s));
        }
    }
    return visible;
}

std::optional<PlacedFile> bed_of_objects(const Mission& mission, SceneStore& models) {
    const SceneConfig& scene = mission.scene;
    if (!scene.seabed || scene.seabed->size_m) return std::nullopt;
    const Eigen::AlignedBox2d ground = ground_of_objects(scene, models);
    if (ground.isEmpty()) return std::nullopt;
    return seabed_of(*scene.seabed, mission.seed, ground, nullptr);
}

std::optional<PlacedFile> ground_of(const Mission& mission, const Trajectory& vehicle,
                                    std::span<const Sonar> sonars, SceneStore& models) {
    const SceneConfig& scene = mission.scene;
    if (!scene.heightmap && !scene.seabed) return std::nullopt;
    const Eigen::AlignedBox2d needed = needed_ground(mission, vehicle, sonars, models);
    return scene.heightmap ? heightmap_of(*scene.heightmap, needed)
                           : seabed_of(*scene.seabed, mission.seed, needed, models.announce);
}

}  // namespace sonarsim
