#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace sonarsim {

/// The part of a glTF's JSON that describes surfaces, every value of the type that glTF asks for,
/// indices small enough for an int. tinygltf takes defaults for values of a wrong type, wraps large
/// integers, recurses as deep as the JSON does and reads textures; so it gets to see only this.
/// InputError with `file` for JSON that is malformed, nested more than 64 deep or too large, for
/// values of a wrong type, and for versions other than 2.x.
nlohmann::json reduce_gltf_json(std::string_view text, const std::string& file);

}  // namespace sonarsim
