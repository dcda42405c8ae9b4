#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>

#include "core/error.h"
#include "scene/gltf/load.h"

using namespace sonarsim;
namespace fs = std::filesystem;

TEST_SUITE("scene") {
    TEST_CASE("glTF: models that others made are read or refused") {
        const fs::path root = "/usr/share/assimp/models";
        if (!fs::exists(root)) {
            MESSAGE("skipped: Debian's package assimp-testmodels is not installed");
            return;
        }
        std::map<std::string, std::string> outcome;  // message by file: "" if it was read
        std::map<std::string, Scene> scenes;
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".gltf" && extension != ".glb") continue;
            const std::string name = fs::relative(entry.path(), root).string();
            try {
                scenes[name] = load_scene_geometry(entry.path());
                outcome[name] = "";
            } catch (const InputError& error) {
                outcome[name] = error.what();
            }
        }
        // Each of these files has its own fault.
        for (const char* name :
             {"glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf",
              "glTF2/IndexOutOfRange/IndexOutOfRange.gltf", "glTF2/MissingBin/BoxTextured.gltf",
              "glTF2/RecursiveNodes/RecursiveNodes.gltf",
              "glTF2/SchemaFailures/sceneWrongType.gltf", "glTF2/draco/2CylinderEngine.gltf",
              "glTF2/wrongTypes/badArray.gltf", "glTF/TwoBoxes/TwoBoxes.gltf"}) {
            CAPTURE(name);
            REQUIRE(outcome.contains(name));
            CHECK(outcome[name] != "");
        }
        // A cube of edge 1 around the origin, 12 triangles, in three packagings.
        for (const char* name : {"glTF2/BoxTextured-glTF/BoxTextured.gltf",
                                 "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
                                 "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf"}) {
            CAPTURE(name);
            REQUIRE(outcome.contains(name));
            REQUIRE(outcome[name] == "");
            const Scene& box = scenes[name];
            CHECK(box.triangles.size() == 12);
            CHECK((box.bounds_max - box.bounds_min - Eigen::Vector3d::Ones()).norm() < 1e-6);
        }
        const auto read = std::count_if(outcome.begin(), outcome.end(),
                                        [](const auto& entry) { return entry.second.empty(); });
        // With version 5.2.5 of the package, that of Debian 12.
        CHECK(outcome.size() >= 53);
        CHECK(read >= 35);
    }
}
