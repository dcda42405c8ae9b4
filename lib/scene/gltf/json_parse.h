#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace sonarsim {

/// Parses the JSON of a glTF and keeps what json_rules.h names, unchanged. The rest, which may be
/// most of a file (textures, animations, extras of other programs), is checked and dropped, so that
/// it takes no memory; a value of a wrong type is kept without its contents. InputError with `file`
/// for JSON that is malformed, nested more than 64 deep, longer than 256 MiB, or that takes more
/// than a gigabyte of memory for the kept part.
nlohmann::json parse_gltf_json(std::string_view text, const std::string& file);

}  // namespace sonarsim
