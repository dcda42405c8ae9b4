#include "simulate/assembly/assemble.h"

#include <iterator>

#include "core/error.h"
#include "core/text.h"
#include "input/mission/files.h"
#include "input/scene/gltf/load.h"
#include "input/scene/images/read_image.h"
#include "input/scene/maps/ground_maps.h"
#include "input/scene/maps/read_maps.h"
#include "simulate/assembly/brightness.h"
#include "simulate/assembly/mission_objects.h"
#include "simulate/assembly/particles.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/assembly/poses.h"
#include "simulate/assembly/scene_parts.h"
#include "simulate/assembly/sound_profiles.h"
#include "simulate/trace/visible_water_surface.h"

namespace sonarsim {

namespace {

std::vector<InputFile> inputs_of(const Mission& mission, SceneStore& models) {
    std::vector<InputFile> inputs;
    for (const std::filesystem::path& file : files_of(mission)) {
        const bool known =
            std::ranges::any_of(inputs, [&](const InputFile& input) { return input.path == file; });
        if (!known) inputs.push_back({file, models.sum_of(file)});
    }
    return inputs;
}

/// Sets the origin and the bounds of a scene in which all surface moves.
void place_moving_scene(const Trajectory& vehicle, std::span<const Trajectory> motions,
                        Scene& scene) {
    if (scene.bodies.empty() || !scene.vertices.empty() || !scene.copies.empty()) return;
    Eigen::AlignedBox3d bounds;
    for (std::size_t k = 0; k < motions.size(); ++k) {
        float radius_m = 0.0F;
        for (const Eigen::Vector3f& vertex : scene.bodies[k].vertices)
            radius_m = std::max(radius_m, vertex.norm());
        for (const TimedPose& at : motions[k]) {
            const Eigen::Array3d place = at.T_world_vehicle.translation.array();
            bounds.extend(Eigen::AlignedBox3d(place - radius_m, place + radius_m));
        }
    }
    scene.bounds_min = bounds.min();
    scene.bounds_max = bounds.max();
    scene.origin = vehicle.front().T_world_vehicle.translation.array().round();
}

/// The warning that the surface of the water has no effect on some or all pings; "": none.
std::string surface_warning(const Mission& mission, const Assembly& assembly) {
    const WaterSurfaceConfig& config = *mission.scene.water_surface;
    std::size_t pings = 0;
    std::size_t above = 0;
    bool multipath = false;
    for (const Sonar& sonar : assembly.sonars) {
        multipath = multipath || sonar.config.multipath.method != MultipathMethod::none;
        const auto every = static_cast<std::size_t>(sonar.config.every);
        for (std::size_t i = 0; i < assembly.trajectory.size(); i += every) {
            const auto pose = static_cast<std::uint32_t>(i);
            const Pose at = sensor_pose(*SonarAtPose(mission, sonar, pose),
                                        assembly.trajectory[i].T_world_vehicle, pose);
            ++pings;
            above += at.translation.z() > config.height_m + just_below_m;
        }
    }
    const std::string name = "scene.water_surface ";
    // Without multipath the surface bounds the water, and depths count from it, as of bubbles.
    const bool has_sources = std::ranges::any_of(
        assembly.sonars, [](const Sonar& sonar) { return !sonar.settings.sources.empty(); });
    if (!multipath && !some_water_scatters(mission) && !mission.water.profile && !has_sources) {
        return name +
               "reflects no sound because no sensor has multipath, and gives depths alone: set "
               "sensors.NAME.multipath.method";
    }
    if (multipath && config.roughness == 1.0)
        return name + "has no effect because a roughness of 1 reflects nothing: lower it";
    if (multipath && config.height_m <= assembly.scene.bounds_min.z()) {
        return name + fmt::format("at {:.4g} m lies below all of the scene: raise height_m",
                                  config.height_m);
    }
    if (above == 0) return "";
    return name + fmt::format(
                      "at {:.4g} m lies below the sonar in {} of {} pings, which receive no echo "
                      "of it: raise height_m or lower the trajectory",
                      config.height_m, above, pings);
}

/// The boundary to air reflects nearly all of the sound; the scattered share is lost.
void add_water_surface(const Mission& mission, Assembly& assembly) {
    if (!mission.scene.water_surface) return;
    constexpr double air_kg_m3 = 1.2;
    constexpr double air_m_s = 343.0;
    const WaterSurfaceConfig& config = *mission.scene.water_surface;
    const Water water{mission.water.density_kg_m3, mission.water.sound_speed_m_s};
    const double reflected = power_reflection(air_kg_m3, air_m_s, water) * (1.0 - config.roughness);
    WaterSurface& surface = assembly.scene.water_surface.emplace();
    surface.height_m = config.height_m;
    surface.reflection = static_cast<float>(reflected);
    if (config.scatters) {
        surface.wind_m_s = mission.water.wind_m_s;
        for (Sonar& sonar : assembly.sonars)
            sonar.settings.sources.push_back(std::make_shared<const ScatteringSurface>());
    }
    const std::string warning = surface_warning(mission, assembly);
    if (!warning.empty()) assembly.scene.warnings.push_back(warning);
}

void warn_of_empty_scatter(const Mission& mission, Scene& scene) {
    for (const ScatterConfig& scatter : mission.scene.scatter) {
        if (scatter.count[1] > 0.0) continue;
        scene.warnings.push_back("scene.scatter: of '" + printable(scatter.name) +
                                 "' no object is placed because its count is 0");
    }
}

/// Makes a sonar. Throws InputError if the mission's engine does not support it.
Sonar checked_sonar(const Mission& mission, const SonarConfig& sensor,
                    const EngineSettings& settings) {
    Sonar sonar = make_sonar(sensor, mission.accuracy, mission.water);
    const std::string refusal = unsupported(settings, sonar.settings.view);
    if (!refusal.empty()) throw InputError("sensor '" + sensor.name + "': " + refusal);
    return sonar;
}

/// Throws InputError for the files of the scene that cannot be read.
void read_scene_files(const Mission& mission, SceneFiles& models) {
    ErrorList errors;
    const auto read = [&](const std::filesystem::path& file, const Location& place) {
        if (file.empty()) return;
        errors.attempt([&] { models.model({.file = file, .place = place}); });
    };
    read(mission.scene.file, mission.scene.place);
    if (mission.scene.heightmap)
        errors.attempt([&] { models.model(file_of(*mission.scene.heightmap)); });
    for (const ObjectConfig& object : mission.scene.objects)
        read(object.file, object.place);
    for (const ScatterConfig& scatter : mission.scene.scatter) {
        for (const std::filesystem::path& file : scatter.files)
            read(file, scatter.place);
    }
    errors.raise();
}

/// The triangles beyond which load_scene() shares meshes. A million triangles take 170 MB.
std::size_t sharing_threshold(EngineKind engine) {
    constexpr std::size_t many_triangles = 4'000'000;
    const bool may_be_rays = engine == EngineKind::automatic || engine == EngineKind::rays;
    return may_be_rays ? many_triangles : share_nothing;
}

/// Sets the trajectory and the sonars, and places the scene.
std::pair<MaterialTable, SceneParts> place(const Mission& mission, const EngineSettings& settings,
                                           SceneStore& models, Assembly& assembly,
                                           bool places_only = false) {
    ErrorList errors;
    errors.attempt([&] { assembly.trajectory = vehicle_poses(mission); });
    for (const SonarConfig& sensor : mission.sensors)
        errors.attempt(
            [&] { assembly.sonars.push_back(checked_sonar(mission, sensor, settings)); });
    MaterialTable materials;
    errors.attempt([&] {
        materials = read_named_at(mission.scene.place,
                                  [&] { return read_materials(mission.scene.materials); });
        if (!mission.scene.material_default.empty()) {
            require_material(materials, mission.scene.material_default, mission.scene.place);
        }
    });
    // Without a trajectory or materials only the files themselves are checked.
    if (errors.count() > 0) errors.attempt([&] { read_scene_files(mission, models); });
    errors.raise();
    add_ping_motions(mission, assembly.trajectory, assembly.sonars);
    return {std::move(materials),
            place_scene(mission, assembly.trajectory, assembly.sonars, models, places_only)};
}

SceneObjects objects_of(const Mission& mission, const Scene& scene) {
    SceneObjects objects = group_objects(scene, mission.classes, possible_objects(mission, scene));
    objects.background = background_classes(mission, scene, objects);
    objects.shadow = shadow_classes(mission, objects);
    return objects;
}

/// Finds the poses that depend on the scene: of `trajectory.look_at`, before targets are scattered
/// in the water around them, and of a lawnmower above the ground.
void find_poses(const Mission& mission, const Bottom* bottom, Assembly& assembly) {
    keep_altitude(mission, bottom, assembly.trajectory);
    if (const auto* look_at = std::get_if<LookAtTrajectoryConfig>(&mission.trajectory)) {
        const Scene& scene = assembly.scene;
        const auto fan = std::ranges::find_if(assembly.sonars, [](const Sonar& sonar) {
            return kind_of(sonar.config.kind).has_images;
        });
        const Pose* const mount = fan != assembly.sonars.end() ? &fan->T_vehicle_sensor : nullptr;
        assembly.trajectory = moved_vehicle(
            mission,
            look_at_poses(*look_at, scene, objects_of(mission, scene), mount, mission.seed));
    }
    assembly.reported = navigation_poses(mission, assembly.trajectory);
}

}  // namespace

Assembly assemble(const Mission& mission) {
    SceneStore models;
    return assemble(mission, models);
}

void check_places(const Mission& mission, SceneStore& models) {
    Assembly assembly;
    place(mission, engine_settings(mission), models, assembly, true);
}

Assembly assemble(const Mission& mission, SceneStore& models) {
    Assembly assembly;
    Scene& scene = assembly.scene;
    assembly.trees = models.trees;
    assembly.fans = models.fans;
    const Water water{mission.water.density_kg_m3, mission.water.sound_speed_m_s};
    // 1. The trajectory, the sonars and the materials; then the places of the scene's files.
    const EngineSettings settings = engine_settings(mission);
    auto [materials, parts] = place(mission, settings, models, assembly);
    // 2. The scene. Where all of it moves, its motions bound it.
    for (PlacedFile& file : parts.files)
        file.parts = parts_of(mission, file);
    scene = load_scene(parts.files, models, materials, mission.scene.material_default, water,
                       sharing_threshold(settings.type));
    place_moving_scene(assembly.trajectory, parts.motions, scene);
    // 3. Poses that look at the scene, before particles are drawn around them.
    find_poses(mission, parts.bottom.get(), assembly);
    // 4. Maps of the ground, which replace materials.
    apply_ground_maps(mission.scene, materials, water, scene);
    if (const auto& map = mission.scene.heightmap; map && map->pixel_m == 0.0)
        assembly.epsg = epsg_of(map->file);
    std::ranges::move(parts.orientation_warnings, std::back_inserter(scene.warnings));
    assembly.motions = std::move(parts.motions);
    assembly.bottom = std::move(parts.bottom);
    assembly.seabed = std::move(parts.seabed);
    // 5. The water: what swims in it, its surface (whose warning needs all poses), its layers.
    add_particles(mission, assembly.trajectory, scene, assembly.sonars);
    add_water_surface(mission, assembly);
    add_sound_profiles(mission, scene, assembly.sonars);
    warn_of_empty_scatter(mission, scene);
    // 6. Objects for labels: nodes and particles.
    if (!mission.output.labels.empty() || !mission.classes.empty())
        assembly.objects = objects_of(mission, scene);
    // 7. The sonars get ready for the materials of the scene, then for its targets.
    const std::string refusal = unsupported(settings, scene);
    if (!refusal.empty()) throw InputError(refusal);
    for (Sonar& sonar : assembly.sonars)
        prepare_for(scene, sonar);
    find_targets(assembly.sonars, scene);
    assembly.inputs = inputs_of(mission, models);
    // 8. The white of pictures, by pings of the finished sonars.
    Brightness brightness = find_full_scales(mission, scene, assembly.trajectory, assembly.motions,
                                             assembly.sonars, *models.trees);
    assembly.full_scales = std::move(brightness.full_scales);
    assembly.caster = std::move(brightness.caster);
    return assembly;
}

std::vector<Pose> body_poses(const Assembly& assembly, double t_s) {
    return poses_at(assembly.motions, t_s);
}

std::unique_ptr<VisibilityEngine> make_engine(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineKind::octree)
        settings.caster = std::make_shared<const Caster>(assembly.make_caster());
    return make_engine(assembly.scene, settings);
}

RenderedPing render_at_pose(const Mission& mission, const Assembly& assembly,
                            const VisibilityEngine& engine, const PingId& id) {
    const TimedPose& at = assembly.trajectory[id.pose];
    const SonarAtPose sonar(mission, assembly.sonars[id.sensor], id.pose);
    const std::shared_ptr<const VisibilityEngine> now = engine_at(engine, assembly.motions, at.t_s);
    TracedPing traced = trace(*sonar, assembly.scene, *now, at.T_world_vehicle, id.pose);
    Ping ping = form_image(traced, sonar->settings, assembly.scene, {mission.seed, id.pose});
    return {id, sonar, now, std::move(traced), std::move(ping)};
}

}  // namespace sonarsim
