#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

// The members of a glTF's JSON that are read, and their types.

namespace sonarsim::gltf_rules {

enum class Kind {
    text,
    name,
    names,
    flag,
    size,
    index,
    indices,
    numbers,
    object,
    objects,
    extras,    ///< an object; only `extras_members` of it are read
    anything,  ///< any value, with all its contents
};

/// A member of a JSON object that is read; other members are dropped.
struct Rule {
    std::string_view key;
    Kind kind;
    std::size_t count = 0;               ///< required count of numbers; 0: any
    std::span<const Rule> members = {};  ///< members of an object, or of each object of an array
};

// Extras may hold keys of other programs; only `sonar` is read.
inline constexpr std::array extras_members{Rule{"sonar", Kind::anything}};
inline constexpr std::array asset{Rule{"version", Kind::name}};
inline constexpr std::array scene{Rule{"nodes", Kind::indices}};
inline constexpr std::array node{
    Rule{"name", Kind::name},           Rule{"mesh", Kind::index},
    Rule{"skin", Kind::index},          Rule{"children", Kind::indices},
    Rule{"matrix", Kind::numbers, 16},  Rule{"translation", Kind::numbers, 3},
    Rule{"rotation", Kind::numbers, 4}, Rule{"scale", Kind::numbers, 3},
    Rule{"weights", Kind::numbers},     Rule{"extras", Kind::extras}};
inline constexpr std::array attributes{Rule{"POSITION", Kind::index}};
inline constexpr std::array primitive{Rule{"attributes", Kind::object, 0, attributes},
                                      Rule{"indices", Kind::index}, Rule{"material", Kind::index},
                                      Rule{"mode", Kind::index}};
inline constexpr std::array mesh{Rule{"name", Kind::name}, Rule{"weights", Kind::numbers},
                                 Rule{"primitives", Kind::objects, 0, primitive}};
inline constexpr std::array material{Rule{"name", Kind::name}, Rule{"extras", Kind::extras}};
inline constexpr std::array sparse_indices{Rule{"bufferView", Kind::index},
                                           Rule{"byteOffset", Kind::index},
                                           Rule{"componentType", Kind::index}};
inline constexpr std::array sparse_values{Rule{"bufferView", Kind::index},
                                          Rule{"byteOffset", Kind::index}};
inline constexpr std::array sparse{Rule{"count", Kind::index},
                                   Rule{"indices", Kind::object, 0, sparse_indices},
                                   Rule{"values", Kind::object, 0, sparse_values}};
inline constexpr std::array accessor{Rule{"bufferView", Kind::index},
                                     Rule{"byteOffset", Kind::size},
                                     Rule{"componentType", Kind::index},
                                     Rule{"count", Kind::size},
                                     Rule{"type", Kind::name},
                                     Rule{"normalized", Kind::flag},
                                     Rule{"sparse", Kind::object, 0, sparse}};
inline constexpr std::array buffer_view{Rule{"buffer", Kind::index}, Rule{"byteOffset", Kind::size},
                                        Rule{"byteLength", Kind::size},
                                        Rule{"byteStride", Kind::size}};
inline constexpr std::array buffer{Rule{"uri", Kind::text}, Rule{"byteLength", Kind::size}};
inline constexpr std::array root{Rule{"asset", Kind::object, 0, asset},
                                 Rule{"scene", Kind::index},
                                 Rule{"scenes", Kind::objects, 0, scene},
                                 Rule{"nodes", Kind::objects, 0, node},
                                 Rule{"meshes", Kind::objects, 0, mesh},
                                 Rule{"materials", Kind::objects, 0, material},
                                 Rule{"accessors", Kind::objects, 0, accessor},
                                 Rule{"bufferViews", Kind::objects, 0, buffer_view},
                                 Rule{"buffers", Kind::objects, 0, buffer},
                                 Rule{"extensionsUsed", Kind::names},
                                 Rule{"extensionsRequired", Kind::names}};

/// The rule for `key`, or nullptr if it is not read.
inline const Rule* find_rule(std::span<const Rule> rules, std::string_view key) {
    for (const Rule& rule : rules) {
        if (rule.key == key) return &rule;
    }
    return nullptr;
}

}  // namespace sonarsim::gltf_rules
