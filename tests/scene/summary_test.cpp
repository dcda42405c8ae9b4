#include "input/scene/summary.h"

#include "scene/gltf/builder.h"

TEST_CASE("summary: bounds, areas, materials, instances and what was dropped") {
    GltfBuilder gltf = one_triangle();
    // A second, rubber triangle of 3 x 4 m, and a primitive of points.
    gltf.node({{"name", "large tri"},
               {"mesh", 0},
               {"scale", {3, 4, 1}},
               {"extras", {{"sonar", {{"material", "rubber"}}}}}});
    gltf.document["meshes"][0]["primitives"].push_back(
        {{"attributes", nlohmann::json::object()}, {"mode", 0}});
    CHECK(describe_scene(load(gltf)) ==
          "bounds     (0.000, 0.000, 0.000) to (3.000, 0.000, 4.000) m\n"
          "size       (3.000, 0.000, 4.000) m\n"
          "origin     (0.000, 0.000, 0.000) m\n"
          "triangles  2 with 6 vertices, 6.500 m^2\n"
          "dropped    0 triangles without area, 0 that are not finite, 2 primitives of points "
          "or lines\n"
          "\n"
          "material   triangles     area m^2\n"
          "steel              1        0.500\n"
          "rubber             1        6.000\n"
          "\n"
          "instance    triangles     area m^2\n"
          "tri                 1        0.500\n"
          "large tri           1        6.000\n");
}

TEST_CASE("summary: vertices that floats have rounded") {
    // Half a unit in the last place at 4.8e6 is 0.25 m.
    GltfBuilder gltf = one_triangle();
    CHECK(describe_scene(load(gltf)).find("rounding") == std::string::npos);
    gltf.points({{0, 0, -4.8e6F}, {8, 0, -4.8e6F}, {0, 8, -4.8e6F}}, "sand");
    gltf.document["nodes"].erase(0);
    CHECK(describe_scene(load(gltf))
              .find("\nrounding   0.250 m, since vertices lie far from "
                    "the origin of their file or node\n") != std::string::npos);
}

TEST_CASE("vertices are coarse from a millimetre on, or from 1e-4 of a small scene") {
    struct {
        double size, rounding;
        bool is_coarse;
    } const cases[] = {{100.0, 0.9e-3, false}, {100.0, 1.1e-3, true}, {0.01, 0.9e-6, false},
                       {0.01, 1.1e-6, true},   {5e4, 0.04, false},    {5e4, 0.25, true}};
    for (const auto& one : cases) {
        Scene scene;
        scene.bounds_max = {one.size, 0.5 * one.size, 0.0};
        scene.vertex_rounding_m = one.rounding;
        CHECK(has_coarse_vertices(scene) == one.is_coarse);
    }
}

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
