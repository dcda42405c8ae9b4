#include "scene/gltf/json.h"

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace sonarsim {

namespace {

using nlohmann::json;

constexpr std::size_t max_json_bytes = std::size_t{1} << 28;
constexpr std::size_t max_objects = 2'000'000;
constexpr int max_depth = 64;
constexpr std::size_t max_name = 1000;

enum class Kind { text, name, names, flag, size, index, indices, numbers, object, objects, extras };

/// A member of a JSON object that is read; the others are left behind.
struct Rule {
    std::string_view key;
    Kind kind;
    std::size_t count = 0;               // of numbers; 0: any
    std::span<const Rule> members = {};  // of an object, or of each object of an array
};

constexpr std::array asset{Rule{"version", Kind::name}};
constexpr std::array scene{Rule{"nodes", Kind::indices}};
constexpr std::array node{Rule{"name", Kind::name},           Rule{"mesh", Kind::index},
                          Rule{"skin", Kind::index},          Rule{"children", Kind::indices},
                          Rule{"matrix", Kind::numbers, 16},  Rule{"translation", Kind::numbers, 3},
                          Rule{"rotation", Kind::numbers, 4}, Rule{"scale", Kind::numbers, 3},
                          Rule{"weights", Kind::numbers},     Rule{"extras", Kind::extras}};
constexpr std::array attributes{Rule{"POSITION", Kind::index}};
constexpr std::array primitive{Rule{"attributes", Kind::object, 0, attributes},
                               Rule{"indices", Kind::index}, Rule{"material", Kind::index},
                               Rule{"mode", Kind::index}};
constexpr std::array mesh{Rule{"name", Kind::name}, Rule{"weights", Kind::numbers},
                          Rule{"primitives", Kind::objects, 0, primitive}};
constexpr std::array material{Rule{"name", Kind::name}, Rule{"extras", Kind::extras}};
constexpr std::array sparse_indices{Rule{"bufferView", Kind::index},
                                    Rule{"byteOffset", Kind::index},
                                    Rule{"componentType", Kind::index}};
constexpr std::array sparse_values{Rule{"bufferView", Kind::index},
                                   Rule{"byteOffset", Kind::index}};
constexpr std::array sparse{Rule{"count", Kind::index},
                            Rule{"indices", Kind::object, 0, sparse_indices},
                            Rule{"values", Kind::object, 0, sparse_values}};
constexpr std::array accessor{Rule{"bufferView", Kind::index},
                              Rule{"byteOffset", Kind::size},
                              Rule{"componentType", Kind::index},
                              Rule{"count", Kind::size},
                              Rule{"type", Kind::name},
                              Rule{"normalized", Kind::flag},
                              Rule{"sparse", Kind::object, 0, sparse}};
constexpr std::array buffer_view{Rule{"buffer", Kind::index}, Rule{"byteOffset", Kind::size},
                                 Rule{"byteLength", Kind::size}, Rule{"byteStride", Kind::size}};
constexpr std::array buffer{Rule{"uri", Kind::text}, Rule{"byteLength", Kind::size}};
constexpr std::array root{Rule{"asset", Kind::object, 0, asset},
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

/// The place of a value in the document; its text is made only when something is wrong.
struct Place {
    const Place* parent = nullptr;
    std::string_view key;
    std::size_t index = std::string_view::npos;

    std::string text() const {
        if (!parent) return "";
        if (index != std::string_view::npos)
            return parent->text() + "[" + std::to_string(index) + "]";
        return parent->text() + (parent->parent ? "." : "") + std::string(key);
    }
};

struct Reducer {
    const std::string& file;
    std::size_t objects = 0;

    [[noreturn]] void expected(const Place& place, const std::string& what, const json& got) const {
        const std::string where = place.parent ? place.text() + ": " : "";
        throw InputError(Location{file}, where + "expected " + what + ", not " +
                                             (got.is_number() ? got.dump() : got.type_name()));
    }

    json object(json& from, std::span<const Rule> rules, const Place& place) {
        if (!from.is_object()) expected(place, "an object", from);
        if (++objects > max_objects) {
            throw InputError(Location{file}, "holds more than " + std::to_string(max_objects) +
                                                 " nodes, meshes, accessors and so on");
        }
        json to = json::object();
        for (const Rule& rule : rules) {
            const auto found = from.find(rule.key);
            if (found == from.end()) continue;
            to[std::string(rule.key)] = value(*found, rule, {&place, rule.key});
        }
        return to;
    }

    json value(json& from, const Rule& rule, const Place& place) {
        constexpr std::uint64_t max_index = std::numeric_limits<int>::max();
        constexpr std::uint64_t max_size = std::uint64_t{1} << 53;
        switch (rule.kind) {
            case Kind::text:
                if (!from.is_string()) expected(place, "a text", from);
                break;
            case Kind::name:
                // Children inherit names, so that a long one would be held many times.
                if (!from.is_string() || from.get_ref<const std::string&>().size() > max_name) {
                    expected(place, "a text of at most 1000 bytes", from);
                }
                break;
            case Kind::flag:
                if (!from.is_boolean()) expected(place, "true or false", from);
                break;
            case Kind::index:
            case Kind::size: {
                const std::uint64_t limit = rule.kind == Kind::index ? max_index : max_size;
                if (!from.is_number_unsigned() || from.get<std::uint64_t>() > limit) {
                    expected(place, "a whole number from 0 to " + std::to_string(limit), from);
                }
                break;
            }
            case Kind::object:
                return object(from, rule.members, place);
            case Kind::extras:
                return extras(from, place);
            case Kind::names:
            case Kind::indices:
            case Kind::numbers:
            case Kind::objects:
                return array(from, rule, place);
        }
        return std::move(from);
    }

    json array(json& from, const Rule& rule, const Place& place) {
        if (!from.is_array()) expected(place, "an array", from);
        if (rule.count > 0 && from.size() != rule.count) {
            throw InputError(Location{file}, place.text() + ": expected " +
                                                 std::to_string(rule.count) + " numbers, not " +
                                                 std::to_string(from.size()));
        }
        json to = json::array();
        for (std::size_t i = 0; i < from.size(); ++i) {
            const Place at{&place, {}, i};
            json& element = from[i];
            if (rule.kind == Kind::objects) {
                to.push_back(object(element, rule.members, at));
            } else if (rule.kind == Kind::numbers) {
                if (!element.is_number()) expected(at, "a number", element);
                to.push_back(std::move(element));
            } else {
                const Kind kind = rule.kind == Kind::names ? Kind::name : Kind::index;
                to.push_back(value(element, {{}, kind}, at));
            }
        }
        return to;
    }

    /// Extras belong to everyone and may be anything; `sonar` in them is ours and strict.
    json extras(json& from, const Place& place) {
        const auto sonar = from.is_object() ? from.find("sonar") : from.end();
        if (sonar == from.end()) return json::object();
        const Place at{&place, "sonar"};
        if (!sonar->is_object()) expected(at, "an object", *sonar);
        for (const auto& [key, unused] : sonar->items()) {
            const std::array<std::string, 1> known{"material"};
            if (key != known[0]) {
                throw InputError(Location{file}, at.text() + ": unknown key '" + key + "'" +
                                                     did_you_mean(key, known) +
                                                     "; only 'material' is read");
            }
        }
        constexpr std::array rules{Rule{"material", Kind::name}};
        json to = json::object();
        to["sonar"] = object(*sonar, rules, at);
        return to;
    }
};

/// The parser's own hook for this is quadratic in the length of an array.
void check_depth(std::string_view text, const std::string& file) {
    int depth = 0;
    bool is_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (is_string && c == '\\') {
            ++i;
        } else if (c == '"') {
            is_string = !is_string;
        } else if (!is_string && (c == '[' || c == '{')) {
            if (++depth > max_depth) {
                throw InputError(Location{file}, "the JSON is nested more than 64 deep");
            }
        } else if (!is_string && (c == ']' || c == '}')) {
            --depth;
        }
    }
}

json parse(std::string_view text, const std::string& file) {
    if (text.size() > max_json_bytes) {
        throw InputError(Location{file},
                         "holds more than 256 MiB of JSON; put the vertices into a "
                         ".glb or a .bin file");
    }
    check_depth(text, file);
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        const std::string message = error.what();
        const std::size_t bracket = message.find("] ");
        throw InputError(Location{file},
                         bracket == std::string::npos ? message : message.substr(bracket + 2));
    }
}

void check_version(const json& document, const std::string& file) {
    const json version =
        document.is_object() && document.contains("asset") && document["asset"].is_object()
            ? document["asset"].value("version", json())
            : json();
    if (!version.is_string()) {
        throw InputError(Location{file}, "asset.version is missing; expected glTF version 2.0");
    }
    if (!version.get_ref<const std::string&>().starts_with("2.")) {
        throw InputError(
            Location{file},
            "is glTF version " + version.get<std::string>().substr(0, 20) + "; expected 2.0");
    }
}

/// tinygltf drops the one where there is the other.
void check_transforms(const json& gltf, const std::string& file) {
    if (!gltf.contains("nodes")) return;
    for (std::size_t i = 0; i < gltf["nodes"].size(); ++i) {
        const json& entry = gltf["nodes"][i];
        if (entry.contains("matrix") && (entry.contains("translation") ||
                                         entry.contains("rotation") || entry.contains("scale"))) {
            throw InputError(Location{file}, "nodes[" + std::to_string(i) +
                                                 "] has both a matrix and translation, rotation "
                                                 "or scale");
        }
    }
}

}  // namespace

json reduce_gltf_json(std::string_view text, const std::string& file) {
    json document = parse(text, file);
    check_version(document, file);
    json reduced = Reducer{file}.object(document, root, {});
    check_transforms(reduced, file);
    return reduced;
}

}  // namespace sonarsim
