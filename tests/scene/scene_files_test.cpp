#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "core/file.h"
#include "scene/gltf/builder.h"
#include "support/approx.h"

using namespace sonarsim;
namespace fs = std::filesystem;

namespace {

const fs::path root = SONARSIM_SOURCE_DIR;

void make_scenes(const std::string& arguments) {
    const std::string command = "python3 '" + (root / "scripts/make_scenes.py").string() + "' " +
                                arguments + " > /dev/null";
    REQUIRE(std::system(command.c_str()) == 0);
}

Eigen::AlignedBox3d box_of(const Scene& scene, const std::string& instance) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        if (scene.instances[scene.triangle_instance[i]] != instance) continue;
        for (std::size_t k = 0; k < 3; ++k)
            box.extend(world_corner(scene, i, k));
    }
    return box;
}

std::set<std::string> materials_of(const Scene& scene) {
    std::set<std::string> names;
    for (const Material& material : scene.materials)
        names.insert(material.name);
    return names;
}

void check_near(const Eigen::Vector3d& p, const Eigen::Vector3d& expected) {
    CAPTURE(p.transpose());
    CHECK((p - expected).cwiseAbs().maxCoeff() < 1e-4);
}

}  // namespace

TEST_SUITE("scene") {
    TEST_CASE("tank.glb: 8 x 6 x 3 m of water and objects of known size") {
        const fs::path file = root / "scenes/tank.glb";
        CHECK(fs::file_size(file) < 200'000);
        const Scene tank = load_scene(file, root / "scenes/materials.csv", Water{});
        CHECK(tank.triangles.size() < 5000);
        CHECK(tank.rejects.degenerate_triangles == 0);
        check_near(tank.bounds_min, {-4, -3, 0});
        check_near(tank.bounds_max, {4, 3, 3});
        CHECK(materials_of(tank) == std::set<std::string>{"aluminium", "concrete", "pvc", "rock",
                                                          "rubber", "sand", "steel", "wood"});
        check_near(box_of(tank, "pole").sizes(), {0.12, 0.12, 3});
        check_near(box_of(tank, "wall_east").sizes(), {0, 6, 3});
        check_near(box_of(tank, "sphere").min(), {2.55, 0.25, 1.25});
        CHECK(box_of(tank, "box").sizes().z() == test::approx(0.5));
    }

    TEST_CASE("tank.glb is what the script writes, byte by byte") {
        const TemporaryFolder folder;
        make_scenes("tank --out '" + folder.path().string() + "'");
        CHECK(read_file(folder.path() / "tank.glb", 1 << 20) ==
              read_file(root / "scenes/tank.glb", 1 << 20));
    }

    TEST_CASE("the sea floor comes in smaller sizes") {
        const TemporaryFolder folder;
        make_scenes("seafloor --cells 40 --area 30 --out '" + folder.path().string() + "'");
        const Scene floor =
            load_scene(folder.path() / "seafloor.glb", root / "scenes/materials.csv", Water{});
        const auto of_floor =
            std::count(floor.triangle_instance.begin(), floor.triangle_instance.end(), 0U);
        CHECK(of_floor == 2 * 40 * 40);
        CHECK(floor.rejects.degenerate_triangles == 0);
        CHECK(floor.instances.size() == 1 + 9);  // 30 x 30 m / 100 m^2
        const Eigen::AlignedBox3d box = box_of(floor, "floor");
        CHECK(box.sizes().x() == test::approx(30.0));
        CHECK(std::max(-box.min().z(), box.max().z()) < 1.0);
    }
}
