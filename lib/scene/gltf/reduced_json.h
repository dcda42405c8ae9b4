#pragma once

#include <string>
#include <string_view>

namespace sonarsim {

/// The part of a glTF's JSON that describes surfaces, as JSON text. tinygltf takes defaults for
/// values of a wrong type, wraps large integers, recurses as deep as the JSON does, and loads
/// textures; so it gets only this part. Every value in it has the type that glTF asks for, and
/// indices fit an int. InputError with `file` for JSON that is malformed, nested more than 64 deep,
/// longer than 256 MiB or that would take more than 1 GiB of memory, for values of a wrong type,
/// and for versions other than 2.x.
std::string reduced_gltf_json(std::string_view text, const std::string& file);

}  // namespace sonarsim
