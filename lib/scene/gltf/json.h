#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace sonarsim {

/// Reduces a glTF's JSON to the part that describes surfaces. Every value has the type that glTF
/// asks for, and indices fit an int. tinygltf takes defaults for values of a wrong type, wraps
/// large integers, recurses as deep as the JSON does and reads textures; so it gets only this part.
/// InputError with `file` for JSON that is malformed, nested more than 64 deep or too large, for
/// values of a wrong type, and for versions other than 2.x.
nlohmann::json reduce_gltf_json(std::string_view text, const std::string& file);

}  // namespace sonarsim
