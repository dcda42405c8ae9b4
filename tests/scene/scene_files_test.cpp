#include "scene/gltf/builder.h"
#include "support/source_folder.h"

TEST_CASE("tank.glb is what the script writes, byte by byte, and 8 x 6 x 3 m large") {
    const std::filesystem::path root = source_folder();
    const TemporaryFolder folder;
    const std::string command = "python3 '" + (root / "scripts/make_scenes.py").string() +
                                "' tank --out '" + folder.path.string() + "' > /dev/null";
    REQUIRE(std::system(command.c_str()) == 0);
    CHECK(read_file(folder.path / "tank.glb", 1 << 20) ==
          read_file(root / "scenes/tank.glb", 1 << 20));
    const Scene tank = load_scene(root / "scenes/tank.glb", root / "scenes/materials.csv");
    CHECK(tank.triangles.size() < 5000);
    CHECK(tank.rejects.degenerate_triangles == 0);
    check_point(tank.bounds_min, -4, -3, 0, 1e-4);
    check_point(tank.bounds_max, 4, 3, 3, 1e-4);
}
