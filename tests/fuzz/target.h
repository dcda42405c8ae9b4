#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/file.h"
#include "input/scene/gltf/load.h"
#include "input/scene/scene.h"
#include "input/scene/summary.h"

// The targets share this. Each takes any bytes: the reader is right or throws InputError.

namespace sonarsim {

inline void require(bool holds) {
    if (!holds) std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Writes a file in a folder of this process, where no input finds another file to read.
inline std::filesystem::path write_input(const std::string& name, std::string_view bytes) {
    static const std::filesystem::path folder = [] {
        auto path = std::filesystem::temp_directory_path() / ("fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directory(path);
        return path;
    }();
    write_file(folder / name, bytes);
    return folder / name;
}

/// Ends the process for a scene that breaks what scene.h says of it.
inline void check_promises(const Scene& scene) {
    require(scene.triangle_material.size() == scene.triangles.size());
    require(scene.triangle_instance.size() == scene.triangles.size());
    require(scene.origin.allFinite());
    for (const auto& vertex : scene.vertices)
        require(vertex.allFinite());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        for (const std::uint32_t vertex : scene.triangles[i])
            require(vertex < scene.vertices.size());
        require(scene.triangle_material[i] < scene.materials.size());
        require(scene.triangle_instance[i] < scene.instances.size());
    }
    require(!describe_scene(scene).empty());
}

/// Reads and checks an input, which may be refused; returns what a target does.
template <class Read>
int read_or_refuse(Read read) {
    try {
        read();
    } catch (const InputError&) {
    }
    return 0;
}

inline int check_scene_file(const std::filesystem::path& file) {
    return read_or_refuse([&] { check_promises(load_scene_geometry(file)); });
}

}  // namespace sonarsim
