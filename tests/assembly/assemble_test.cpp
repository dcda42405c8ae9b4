#include "simulate/assembly/assemble.h"

#include "input/mission/parse.h"
#include "output/dataset/metadata.h"
#include "scene/gltf/builder.h"
#include "simulate/assembly/poses.h"
#include "simulate/calibrated/model.h"
#include "simulate/sonar/kinds.h"
#include "support/small_mission.h"

namespace {

/// A concrete wall of 20 x 20 m that stands across x = 5 m. World (x, y, z) is glTF (x, z, -y).
GltfBuilder wall() {
    GltfBuilder gltf;
    gltf.points(
        {{5, -10, -10}, {5, 10, -10}, {5, 10, 10}, {5, -10, -10}, {5, 10, 10}, {5, -10, 10}},
        "concrete");
    gltf.document["nodes"][0]["name"] = "wall";
    return gltf;
}

/// A mission on disk, of the wall.
struct MissionOnDisk {
    TemporaryFolder folder;

    MissionOnDisk() {
        write_file(folder.path / "wall.glb", wall().glb());
        write_file(folder.path / "materials.csv",
                   "material,density_kg_m3,sound_speed_m_s\nconcrete,2400,3100\n");
        write_file(folder.path / "poses.csv",
                   "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n1,1,0,0,0,0,0,1\n");
    }

    Mission load(const std::string& trajectory, std::span<const std::string> overrides = {}) const {
        return parse_mission(
            "scene: {file: wall.glb, materials: materials.csv}\ntrajectory: " + trajectory +
                "\nsensors:\n  fls: {kind: imaging, range_bins: 100, "
                "azimuth_bins: 8, azimuth_deg: 20, elevation_deg: 10}\n"
                "output: {folder: out}\n",
            "mission.yaml", folder.path, overrides, sonar_keys());
    }
};

/// Two copies of the wall at a hundredth of its size.
const std::string two_walls =
    "scene.objects=[{file: wall.glb, scale: 0.01, position_m: [5, 6, 0], name: near, class: box},"
    " {file: wall.glb, scale: 0.01, position_m: [40, -6, 2], name: far, class: post}]";

}  // namespace

TEST_CASE("assemble: the trajectory of a file has the rate that is asked for") {
    // 1 s at 10 Hz: 11 poses.
    const MissionOnDisk disk;
    CHECK(assemble(disk.load("{file: poses.csv, rate_hz: 10}")).trajectory.size() == 11);
}

TEST_CASE("assemble: a made bed is as large wherever in its file an object lies") {
    const MissionOnDisk disk;
    GltfBuilder far = wall();
    far.document["nodes"][0]["translation"] = {1000, 7, -500};
    write_file(disk.folder.path / "far.glb", far.glb());
    const auto size = [&](const std::string& object) -> Eigen::Vector2d {
        const std::vector<std::string> settings{
            "scene={materials: materials.csv, seabed: {cell_m: 0.5, z_m: -10, material: concrete}, "
            "objects: [{name: wall, place: on_bottom, " +
            object + "}]}"};
        const Assembly assembled = assemble(disk.load("{file: poses.csv}", settings));
        return (assembled.scene.bounds_max - assembled.scene.bounds_min).head<2>();
    };
    const Eigen::Vector2d near = size("file: wall.glb");
    CHECK(near.maxCoeff() < 40.0);
    CHECK(size("file: far.glb, position_m: [-1000, -500, 0]") == near);
    // Turned by 90 degrees (x, y) is (-y, x); the wall, as long as that ground, leaves it.
    CHECK(size("file: far.glb, scale: 0.5, rpy_deg: [0, 0, 90], position_m: [250, -500, 0]")
              .maxCoeff() < 40.0);
    // A slope would turn it about its origin, 1118 m away.
    CHECK(size("file: far.glb, align: true, position_m: [-1000, -500, 0], scale: 0.1").minCoeff() >
          200.0);
}

TEST_CASE("assemble: look_at has an object at the distance, bearing and height that were given") {
    const MissionOnDisk disk;
    const std::vector<std::string> settings{two_walls, "labels.background=[wall]", "seed=7"};
    const auto poses = [&](const std::string& of) {
        return assemble(disk.load("{look_at: " + of +
                                      ", count: 200, range_m: [2, 9], "
                                      "bearing_deg: [-30, 10], height_m: [1, 3]}",
                                  settings))
            .trajectory;
    };
    // The middles and the lowest points of the two objects, scaled by 0.01.
    const Eigen::Vector3d near(5.05, 6, -0.1), far(40.05, -6, 1.9);
    int far_count = 0;
    for (const TimedPose& pose : poses("objects")) {
        const Eigen::Vector3d at = pose.T_world_vehicle.translation;
        const bool is_far = (at - far).head<2>().norm() < (at - near).head<2>().norm();
        far_count += is_far;
        const Eigen::Vector3d to = (is_far ? far : near) - at;
        const Eigen::Vector3d visible = pose.T_world_vehicle.rotation.conjugate() * to;
        const double bearing_deg = degrees(std::atan2(visible.y(), visible.x()));
        CHECK(std::abs(to.head<2>().norm() - 5.5) < 3.501);
        CHECK(std::abs(bearing_deg + 10.0) < 20.001);
        CHECK(std::abs(-to.z() - 2.0) < 1.001);
        CHECK(std::abs(at.y()) <= 10.0);  // within the bounds of the scene
    }
    // 200 fair draws have 60 to 140 of one kind but for one in 10^8; bounds favour the nearer.
    CHECK(far_count > 40);
    CHECK(far_count < 160);
    for (const TimedPose& pose : poses("post"))
        CHECK((pose.T_world_vehicle.translation - far).head<2>().norm() < 9.01);
    CHECK_THROWS_WITH_AS(poses("posts"),
                         "trajectory.look_at: the scene has no object at rest of 'posts' that is "
                         "no background (did you mean 'post'?); there are: objects, box, post",
                         InputError);
}

TEST_CASE("assemble: look_at has an object at an azimuth and elevation of the fan, no wall") {
    const MissionOnDisk disk;
    const std::vector<std::string> settings{two_walls, "labels.background=[none]",
                                            "sensors.fls.mount={rpy_deg: [0, 35, 10]}", "seed=7"};
    const Eigen::Quaterniond mount = rotation_from_rpy(0.0, radians(35), radians(10));
    // The middles of the two objects; the wall is longer than range_m.
    const Eigen::Vector3d near(5.05, 6, 0), far(40.05, -6, 2);
    for (const std::string of : {"objects", "post, box"}) {
        const std::string look = "{look_at: '" + of +
                                 "', count: 50, range_m: [2, 9], bearing_deg: "
                                 "[-9, 3], elevation_deg: [2, 5], height_m: [1, 3]}";
        const Assembly assembly = assemble(disk.load(look, settings));
        for (const TimedPose& pose : assembly.trajectory) {
            const Pose& T = pose.T_world_vehicle;
            const bool is_far = T.translation.x() > 20.0;
            const Eigen::Vector3d visible =
                (T.rotation * mount).conjugate() * ((is_far ? far : near) - T.translation);
            CHECK(std::abs(std::atan2(visible.y(), visible.x()) + radians(3)) < radians(6.001));
            CHECK(std::abs(std::asin(visible.normalized().z()) - radians(3.5)) < radians(1.501));
        }
    }
}

TEST_CASE("assemble: a lawnmower keeps its altitude above the bottom") {
    const MissionOnDisk disk;
    const std::string lines =
        "{lawnmower: {area_min_m: [1, 1], area_max_m: [9, 9], altitude_m: 3, speed_m_s: 1, "
        "rate_hz: 1}}";
    CHECK_THROWS_WITH_AS(assemble(disk.load(lines)),
                         "mission.yaml: trajectory.lawnmower.altitude_m: there is no bottom "
                         "below 1, 2.5 m; name one without a hole "
                         "in scene.bottom, or give z_m",
                         InputError);
    const std::vector<std::string> bed{
        "scene={seabed: {cell_m: 1, z_m: -12, size_m: [10, 10], material: concrete}, "
        "materials: materials.csv}"};
    for (const TimedPose& pose : assemble(disk.load(lines, bed)).trajectory)
        CHECK(pose.T_world_vehicle.translation.z() == approx(-9.0));
    // A cliff of 10 m at x = 5 m is climbed without a step: 0.1 m apart, the poses rise by little.
    const std::vector<std::string> rate{"trajectory.lawnmower.rate_hz=10"};
    const Mission often = disk.load(lines, rate);
    Surface cliff;
    for (const double z : {-20.0, -10.0}) {
        const double x = z < -15.0 ? -99.0 : 5.0;
        const auto k = static_cast<std::uint32_t>(cliff.vertices.size());
        for (const double y : {-99.0, 99.0})
            cliff.vertices.insert(cliff.vertices.end(), {{x, y, z}, {x + 104.0, y, z}});
        cliff.triangles.insert(cliff.triangles.end(), {{k, k + 1, k + 3}, {k, k + 3, k + 2}});
    }
    const Bottom bottom(cliff);
    Trajectory poses = poses_of(often.trajectory);
    keep_altitude(often, &bottom, poses);
    for (std::size_t i = 1; i < poses.size(); ++i)
        CHECK(std::fabs(poses[i].T_world_vehicle.translation.z() -
                        poses[i - 1].T_world_vehicle.translation.z()) < 0.5);
    CHECK(std::ranges::max(poses, {}, [](const TimedPose& p) {
              return p.T_world_vehicle.translation.z();
          }).T_world_vehicle.translation.z() == approx(-7.0));
}

TEST_CASE("assemble: calibrated sonars know the scene's materials before the first ping") {
    const MissionOnDisk disk;
    const std::vector<std::string> settings{"sensors.fls.model=calibrated"};
    const Assembly assembly = assemble(disk.load("{file: poses.csv}", settings));
    const auto& model = dynamic_cast<const CalibratedModel&>(*assembly.sonars[0].settings.model);
    CHECK(!assembly.scene.materials.empty());
    CHECK(model.prepared_materials == assembly.scene.materials);
    CHECK(model.scattering.materials.size() == assembly.scene.materials.size());
}

TEST_CASE("assemble: the octree refuses the calibrated model") {
    const MissionOnDisk disk;
    Mission mission = disk.load("{file: poses.csv}");
    mission.engine = EngineKind::octree;
    CHECK_NOTHROW(assemble(mission));
    mission.sensors[0].model = ModelKind::calibrated;
    CHECK_THROWS_WITH_AS(assemble(mission),
                         "sensor 'fls': engine: octree has votes in place of areas, and model: "
                         "calibrated needs areas; use engine: auto",
                         InputError);
}

TEST_CASE("assemble: the instances of the bottom") {
    const MissionOnDisk disk;
    const auto is_bottom = [&](std::vector<std::string> overrides) {
        overrides.emplace_back(
            "scene.objects=[{name: other, file: wall.glb, position_m: [1, 0, 0]}]");
        return assemble(disk.load("{file: poses.csv}", overrides)).scene.is_bottom;
    };
    using Flags = std::vector<std::uint8_t>;
    CHECK(is_bottom({}) == Flags{1, 0});
    CHECK(is_bottom({"output.labels=[height]", "scene.bottom=[wa*]"}) == Flags{1, 0});
}

TEST_CASE("assemble: the inputs' hash tells files, scenes and poses apart") {
    const Assembly assembly = small_assembly(small_mission("out"), 7);
    const std::string hash = inputs_hash(assembly);
    CHECK(hash.size() == 32);
    CHECK(inputs_hash(assembly) == hash);
    const auto changed = [&](auto change) {
        Assembly other = assembly;
        change(other);
        return inputs_hash(other) != hash;
    };
    CHECK(changed([](Assembly& a) { a.scene.vertices[0].x() += 1e-3F; }));
    CHECK(changed([](Assembly& a) { a.scene.origin.x() += 1e-3; }));
    CHECK(
        changed([](Assembly& a) { std::swap(a.scene.triangles[0][0], a.scene.triangles[0][1]); }));
    CHECK(changed([](Assembly& a) { a.inputs.push_back({"other.glb", "0"}); }));
    CHECK(changed([](Assembly& a) { a.trajectory[6].t_s += 1e-6; }));
    CHECK(changed([](Assembly& a) { a.trajectory.pop_back(); }));
}
