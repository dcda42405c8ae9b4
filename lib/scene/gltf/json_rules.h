#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

// The members of a glTF's JSON that are read, and their types.

namespace sonarsim::gltf_rules {

enum class Kind { uri, name, version, flag, number, size, length, index, object, extras, sonar };
enum class Holds { one, array };

/// A member of a JSON object that is read, or the elements of an array; other members are dropped.
struct Rule {
    std::string_view key;
    Kind kind;
    Holds holds = Holds::one;
    std::span<const Rule> members = {};  ///< members of an object, or of each object of an array
    std::size_t count = 0;               ///< required size of an array; 0: any
};

inline constexpr std::array asset{Rule{"version", Kind::version}};
inline constexpr std::array scene{Rule{"nodes", Kind::index, Holds::array}};
inline constexpr std::array sonar{Rule{"material", Kind::name}, Rule{"class", Kind::name}};
// Extras may hold keys of other programs.
inline constexpr std::array extras{Rule{"sonar", Kind::sonar, Holds::one, sonar}};
inline constexpr std::array node{Rule{"name", Kind::name},
                                 Rule{"mesh", Kind::index},
                                 Rule{"skin", Kind::index},
                                 Rule{"children", Kind::index, Holds::array},
                                 Rule{"matrix", Kind::number, Holds::array, {}, 16},
                                 Rule{"translation", Kind::number, Holds::array, {}, 3},
                                 Rule{"rotation", Kind::number, Holds::array, {}, 4},
                                 Rule{"scale", Kind::number, Holds::array, {}, 3},
                                 Rule{"weights", Kind::number, Holds::array},
                                 Rule{"extras", Kind::extras, Holds::one, extras}};
inline constexpr std::array attributes{Rule{"POSITION", Kind::index},
                                       Rule{"TEXCOORD_0", Kind::index}};
inline constexpr std::array primitive{Rule{"attributes", Kind::object, Holds::one, attributes},
                                      Rule{"indices", Kind::index}, Rule{"material", Kind::index},
                                      Rule{"mode", Kind::index}};
inline constexpr std::array mesh{Rule{"name", Kind::name},
                                 Rule{"weights", Kind::number, Holds::array},
                                 Rule{"primitives", Kind::object, Holds::array, primitive}};
inline constexpr std::array material{Rule{"name", Kind::name},
                                     Rule{"extras", Kind::extras, Holds::one, extras}};
inline constexpr std::array sparse_part{Rule{"bufferView", Kind::index},
                                        Rule{"byteOffset", Kind::index},
                                        Rule{"componentType", Kind::index}};
inline constexpr std::array sparse{Rule{"count", Kind::index},
                                   Rule{"indices", Kind::object, Holds::one, sparse_part},
                                   Rule{"values", Kind::object, Holds::one, sparse_part}};
inline constexpr std::array accessor{Rule{"bufferView", Kind::index},
                                     Rule{"byteOffset", Kind::size},
                                     Rule{"componentType", Kind::index},
                                     Rule{"count", Kind::size},
                                     Rule{"type", Kind::name},
                                     Rule{"normalized", Kind::flag},
                                     Rule{"sparse", Kind::object, Holds::one, sparse}};
inline constexpr std::array buffer_view{Rule{"buffer", Kind::index}, Rule{"byteOffset", Kind::size},
                                        Rule{"byteLength", Kind::size},
                                        Rule{"byteStride", Kind::index}};
inline constexpr std::array buffer{Rule{"uri", Kind::uri}, Rule{"byteLength", Kind::length}};
inline constexpr std::array document{Rule{"asset", Kind::object, Holds::one, asset},
                                     Rule{"scene", Kind::index},
                                     Rule{"scenes", Kind::object, Holds::array, scene},
                                     Rule{"nodes", Kind::object, Holds::array, node},
                                     Rule{"meshes", Kind::object, Holds::array, mesh},
                                     Rule{"materials", Kind::object, Holds::array, material},
                                     Rule{"accessors", Kind::object, Holds::array, accessor},
                                     Rule{"bufferViews", Kind::object, Holds::array, buffer_view},
                                     Rule{"buffers", Kind::object, Holds::array, buffer},
                                     Rule{"extensionsUsed", Kind::name, Holds::array},
                                     Rule{"extensionsRequired", Kind::name, Holds::array}};
inline constexpr Rule whole_document{"", Kind::extras, Holds::one, document};
inline constexpr Rule only_version{"", Kind::extras, Holds::one, std::span(document).first(1)};

/// The type that a value of `kind` must have, for a message; "" if `got` has this type.
inline std::string missing_type(Kind kind, const nlohmann::json& got) {
    // Children inherit names, so a long name would be stored many times.
    constexpr std::size_t max_name = 1000;
    const auto whole_number = [&](std::uint64_t first, std::uint64_t last) {
        const bool fits = got.is_number_unsigned() && got.get<std::uint64_t>() >= first &&
                          got.get<std::uint64_t>() <= last;
        return fits
                   ? ""
                   : "a whole number from " + std::to_string(first) + " to " + std::to_string(last);
    };
    constexpr std::uint64_t max_size = std::uint64_t{1} << 53;
    switch (kind) {
        case Kind::uri:
            return got.is_string() ? "" : "a text";
        case Kind::name:
        case Kind::version:
            return got.is_string() && got.get_ref<const std::string&>().size() <= max_name
                       ? ""
                       : "a text of at most 1000 bytes";
        case Kind::flag:
            return got.is_boolean() ? "" : "true or false";
        case Kind::number:
            return got.is_number() ? "" : "a number";
        case Kind::size:
            return whole_number(0, max_size);
        case Kind::length:
            return whole_number(1, max_size);
        case Kind::index:
            return whole_number(0, std::numeric_limits<int>::max());
        default:
            return got.is_object() ? "" : "an object";
    }
}

}  // namespace sonarsim::gltf_rules
