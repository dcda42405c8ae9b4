#include "input/scene/gltf/load.h"
#include "support/test.h"

using namespace sonarsim;
namespace fs = std::filesystem;

TEST_SUITE("scene") {
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
                scenes[fs::relative(entry.path(), root).string()] =
                    load_scene_geometry(entry.path());
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
}
