#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "scene/gltf/load.h"
#include "scene/summary.h"

// Any bytes as a .gltf or .glb: a scene that keeps its promises, or InputError.

using namespace sonarsim;

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void check_promises(const Scene& scene) {
    require(scene.triangle_material.size() == scene.triangles.size());
    require(scene.triangle_instance.size() == scene.triangles.size());
    require(scene.origin.allFinite());
    for (const auto& vertex : scene.vertices)
        require(vertex.allFinite());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        for (const std::uint32_t vertex : scene.triangles[i]) {
            require(vertex < scene.vertices.size());
        }
        require(scene.triangle_material[i] < scene.materials.size());
        require(scene.triangle_instance[i] < scene.instances.size());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // In a folder of its own, so that no buffer finds a file to read.
    static const std::filesystem::path folder = [] {
        auto path =
            std::filesystem::temp_directory_path() / ("fuzz_gltf_" + std::to_string(getpid()));
        std::filesystem::create_directory(path);
        return path;
    }();
    const std::filesystem::path file = folder / "x.glb";
    write_file(file, std::string_view(reinterpret_cast<const char*>(data), size));
    try {
        const Scene scene = load_scene_geometry(file);
        check_promises(scene);
        require(!describe_scene(scene).empty());
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
