#pragma once

#include <cstddef>
#include <cstdint>

// The interface between the program and its module of meshes (apps/modules/meshes.cpp), which alone
// is linked with libassimp. C, so that a symbol's name is all that dlsym needs.

extern "C" {

/// The triangles of one object or group that have one material. Valid during the call that gets it.
struct SonarsimMeshPart {
    const char* node;        ///< name of the object or group; "": none
    const char* material;    ///< "": none
    const float* positions;  ///< x, y, z of each vertex, in the file's axes and unit
    std::size_t vertices;
    const std::uint32_t* corners;  ///< three vertices of each triangle; may lie out of range
    std::size_t triangles;
    std::size_t others;  ///< points and lines, which have no surface
};

using SonarsimAddPart = void (*)(void* user, const SonarsimMeshPart* part);

/// Reads the bytes of a file of `format` "obj", "stl" or "ply" and opens no other file. Calls `add`
/// for every part in order. Returns 0, or 1 with the reason in `error`, which ends with a zero.
using SonarsimReadMesh = int (*)(const char* format, const char* bytes, std::size_t size,
                                 SonarsimAddPart add, void* user, char* error,
                                 std::size_t error_size);
}

namespace sonarsim {

inline constexpr const char* mesh_module = "meshes";
/// The number rises with every change above, so that a module of another version is not used.
inline constexpr const char* mesh_module_symbol = "sonarsim_read_mesh_1";

}  // namespace sonarsim
