#include "scene/gltf/builder.h"

using nlohmann::json;
namespace fs = std::filesystem;

TEST_CASE("glTF: node transforms, as TRS and as matrix, compose down the tree") {
    // Parent: 90 degrees about glTF's y (x to -z). Child: scaled by 2, moved by (10 0 0).
    const double h = std::sqrt(0.5);
    GltfBuilder trs = one_triangle();
    trs.document["nodes"][0]["translation"] = {10, 0, 0};
    trs.document["nodes"][0]["scale"] = {2, 2, 2};
    trs.node({{"rotation", {0, h, 0, h}}, {"children", {0}}});
    GltfBuilder matrices = one_triangle();
    matrices.document["nodes"][0]["matrix"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1};
    matrices.node(
        {{"matrix", {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}}, {"children", {0}}});
    for (const GltfBuilder& gltf : {trs, matrices}) {
        const Scene scene = load(gltf);
        // In the parent: (10 0 0), (12 0 0), (10 2 0); turned: (0 0 -10), (0 0 -12), (0 2 -10);
        // in the world (x, -z, y): (0 10 0), (0 12 0), (0 10 2).
        check_triangle(scene, 0, {{{0, 10, 0}, {0, 12, 0}, {0, 10, 2}}});
    }
}

TEST_CASE("glTF: instanced meshes and unique instance names") {
    GltfBuilder gltf = one_triangle();
    gltf.node({{"name", "tri"}, {"mesh", 0}, {"translation", {5, 0, 0}}});
    gltf.node({{"mesh", 0}, {"translation", {6, 0, 0}}});
    gltf.node({{"name", "tri_2"}, {"mesh", 0}, {"translation", {7, 0, 0}}});
    const Scene scene = load(gltf);
    CHECK(scene.instances == std::vector<std::string>{"tri", "tri_2", "node2", "tri_2_2"});
    CHECK(scene.own_names == std::vector<std::string>{"tri", "tri", "node2", "tri_2"});
    CHECK(scene.instance_classes == std::vector<std::string>{"", "tri", "", "tri_2"});
    CHECK(scene.triangle_instance == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(scene.vertices.size() == 12);
    check_point(world_corner(scene, 3, 0), 7, 0, 0);
}

TEST_CASE("glTF: default scene, first scene, all roots") {
    GltfBuilder gltf = one_triangle();
    gltf.node({{"name", "b"}, {"mesh", 0}});
    CHECK(load(gltf).instances == std::vector<std::string>{"tri", "b"});
    gltf.document["scenes"] = {{{"nodes", {1}}}, {{"nodes", {0}}}};
    CHECK(load(gltf).instances == std::vector<std::string>{"b"});
    gltf.document["scene"] = 1;
    CHECK(load(gltf).instances == std::vector<std::string>{"tri"});
}

TEST_CASE("glTF: extras.sonar.material of node, ancestor and material") {
    const auto extras = [](const char* name) -> json { return {{"sonar", {{"material", name}}}}; };
    GltfBuilder gltf = one_triangle();
    const auto check_material = [&](const std::string& name) {
        const Scene scene = load(gltf);
        REQUIRE(scene.materials.size() == 1);
        CHECK(scene.materials[0].name == name);
    };
    gltf.document["materials"][0]["extras"] = extras("rubber");
    check_material("rubber");
    gltf.document["materials"][0]["extras"] = "anything goes";
    check_material("steel");
    gltf.node({{"children", {0}}, {"extras", extras("sand")}});
    check_material("sand");  // inherited
    gltf.document["nodes"][0]["extras"] = extras("rubber");
    check_material("rubber");  // the nearest wins
    gltf.document["meshes"][0]["primitives"][0].erase("material");
    check_material("rubber");  // the node's material serves a primitive without one
}

TEST_CASE("glTF: textures, cameras, animations and unknown members are nobody's business") {
    GltfBuilder gltf = one_triangle();
    gltf.document["images"] = {{{"uri", "/etc/passwd"}}, {{"bufferView", 999}}};
    gltf.document["animations"] = "not even an array";
    gltf.document["cameras"] = {nullptr};
    gltf.document["extensionsUsed"] = {"KHR_materials_unlit", "VENDOR_anything"};
    gltf.document["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform"};
    gltf.document["meshes"][0]["weights"] = {0, 0};
    gltf.document["extras"] = nlohmann::json::array({1, 2});
    CHECK(load(gltf).triangles.size() == 1);
}

TEST_CASE("glTF: as text, with data URI and with files next to and below") {
    GltfBuilder gltf = one_triangle();
    const std::string binary = gltf.binary;
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path / "sub");
    written(folder, "a b+c.bin", binary);
    written(folder, "sub/d.bin", binary);
    const auto count = [&](const std::string& uri) {
        gltf.document["buffers"] = {{{"byteLength", binary.size()}, {"uri", uri}}};
        return load_scene_geometry(written(folder, "x.gltf", gltf.text())).triangles.size();
    };
    CHECK(count("a%20b+c.bin") == 1);
    CHECK(count("sub/d.bin") == 1);
    // 36 bytes: nine floats; the fourth and the eighth are 1 (00 00 80 3f).
    CHECK(count("data:application/octet-stream;base64,"
                "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA") == 1);
}

TEST_CASE("glTF: models that others made are read or refused") {
    const fs::path root = "/usr/share/assimp/models";
    if (!fs::exists(root)) {
        MESSAGE("skipped: Debian's package assimp-testmodels is not installed");
        return;
    }
    std::map<std::string, Scene> scenes;
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        ++files;
        try {
            scenes[fs::relative(entry.path(), root).string()] = load_scene_geometry(entry.path());
        } catch (const InputError&) {
            continue;  // refused, and nothing crashes
        }
    }
    // A cube of edge 1 around the origin, 12 triangles, in three packagings.
    for (const char* name : {"glTF2/BoxTextured-glTF/BoxTextured.gltf",
                             "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
                             "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf"}) {
        CAPTURE(name);
        REQUIRE(scenes.contains(name));
        const Scene& box = scenes[name];
        CHECK(box.triangles.size() == 12);
        CHECK((box.bounds_max - box.bounds_min - Eigen::Vector3d::Ones()).norm() < 1e-6);
    }
    // With version 5.2.5 of the package, that of Debian 12.
    CHECK(files >= 53);
    CHECK(scenes.size() >= 35);
}
