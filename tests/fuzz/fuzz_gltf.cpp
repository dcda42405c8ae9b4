#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "scene/gltf/load.h"
#include "scene/summary.h"
#include "scene_promises.h"

// Any bytes as a .gltf or .glb: a scene that keeps its promises, or InputError.

using namespace sonarsim;

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
