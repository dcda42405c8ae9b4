#include "scene/gltf/json.h"

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "scene/gltf/json_parse.h"
#include "scene/gltf/json_rules.h"

namespace sonarsim {

namespace {

using gltf_rules::Kind;
using gltf_rules::Rule;
using nlohmann::json;

constexpr std::size_t max_objects = 2'000'000;
constexpr std::size_t max_name = 1000;

/// A position in the document. Its text is made only for an error message.
struct JsonPath {
    const JsonPath* parent = nullptr;
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

    [[noreturn]] void expected(const JsonPath& place, const std::string& what,
                               const json& got) const {
        const std::string where = place.parent ? place.text() + ": " : "";
        throw InputError(Location{file}, where + "expected " + what + ", not " +
                                             (got.is_number() ? got.dump() : got.type_name()));
    }

    json object(json& from, std::span<const Rule> rules, const JsonPath& place) {
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

    json value(json& from, const Rule& rule, const JsonPath& place) {
        constexpr std::uint64_t max_index = std::numeric_limits<int>::max();
        constexpr std::uint64_t max_size = std::uint64_t{1} << 53;
        switch (rule.kind) {
            case Kind::text:
                if (!from.is_string()) expected(place, "a text", from);
                break;
            case Kind::name:
                // Children inherit names, so a long name would be stored many times.
                if (!from.is_string() || from.get_ref<const std::string&>().size() > max_name) {
                    expected(place, "a text of at most 1000 bytes", from);
                }
                break;
            case Kind::anything:
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

    json array(json& from, const Rule& rule, const JsonPath& place) {
        if (!from.is_array()) expected(place, "an array", from);
        if (rule.count > 0 && from.size() != rule.count) {
            throw InputError(Location{file}, place.text() + ": expected " +
                                                 std::to_string(rule.count) + " numbers, not " +
                                                 std::to_string(from.size()));
        }
        json to = json::array();
        for (std::size_t i = 0; i < from.size(); ++i) {
            const JsonPath at{&place, {}, i};
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

    /// Extras may hold keys of other programs; `sonar` may hold only ours.
    json extras(json& from, const JsonPath& place) {
        const auto sonar = from.is_object() ? from.find("sonar") : from.end();
        if (sonar == from.end()) return json::object();
        const JsonPath at{&place, "sonar"};
        if (!sonar->is_object()) expected(at, "an object", *sonar);
        for (const auto& [key, unused] : sonar->items()) {
            const std::array<std::string, 2> known{"material", "class"};
            if (std::ranges::find(known, key) == known.end()) {
                throw InputError(Location{file}, at.text() + ": unknown key '" + key + "'" +
                                                     did_you_mean(key, known) +
                                                     "; only 'material' and 'class' are read");
            }
        }
        constexpr std::array rules{Rule{"material", Kind::name}, Rule{"class", Kind::name}};
        json to = json::object();
        to["sonar"] = object(*sonar, rules, at);
        return to;
    }
};

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

/// Refuses nodes with both a matrix and its parts: tinygltf would drop one of them silently.
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
    json document = parse_gltf_json(text, file);
    check_version(document, file);
    json reduced = Reducer{file}.object(document, gltf_rules::root, {});
    check_transforms(reduced, file);
    return reduced;
}

}  // namespace sonarsim
