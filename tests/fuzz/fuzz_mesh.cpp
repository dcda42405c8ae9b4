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

// Any bytes as an .obj, .stl or .ply, as the first of them says: a scene that keeps its promises,
// or InputError.

using namespace sonarsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path folder = [] {
        auto path =
            std::filesystem::temp_directory_path() / ("fuzz_mesh_" + std::to_string(getpid()));
        std::filesystem::create_directory(path);
        return path;
    }();
    if (size == 0) return 0;
    const std::string ending = data[0] == 'o' ? ".obj" : ".ply";
    const std::filesystem::path file = folder / (data[0] == 's' ? "x.stl" : "x" + ending);
    write_file(file, std::string_view(reinterpret_cast<const char*>(data) + 1, size - 1));
    try {
        const Scene scene = load_scene_geometry(file);
        check_promises(scene);
        require(!describe_scene(scene).empty());
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
