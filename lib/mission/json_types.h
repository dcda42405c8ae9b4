#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/text.h"
#include "mission/limits.h"

// The types of values in JSON Schema.

namespace sonarsim {

using SchemaJson = nlohmann::ordered_json;

/// Writes a whole number as 5, not as 5.0.
inline SchemaJson number_json(double value) {
    constexpr double exact = 9007199254740992.0;  // 2^53
    if (value == std::floor(value) && std::abs(value) <= exact)
        return static_cast<std::int64_t>(value);
    return value;
}

/// `true` and `false` among the names of a choice are flags.
inline SchemaJson choice_json(const std::string& name) {
    if (name == "true" || name == "false") return name == "true";
    return name;
}

/// `type`: "number" or "integer".
inline SchemaJson within_limits(const char* type, const Limits& limits) {
    SchemaJson json{{"type", type}};
    json[limits.low_allowed ? "minimum" : "exclusiveMinimum"] = number_json(limits.low);
    json["maximum"] = number_json(limits.high);
    return json;
}

/// The reader accepts any scalar as text, even a number.
inline SchemaJson text_json() {
    return {{"type", {"string", "number", "boolean"}},
            {"minLength", 1},
            {"pattern", "^[^\\u0000-\\u001f\\u007f]*$"}};
}

inline SchemaJson list_json(SchemaJson items, std::size_t fewest) {
    SchemaJson json{{"type", "array"}, {"items", std::move(items)}};
    if (fewest > 0) json["minItems"] = fewest;
    return json;
}

inline SchemaJson numbers_json(std::size_t count, const Limits& limits) {
    SchemaJson json = list_json(within_limits("number", limits), count);
    json["maxItems"] = count;
    return json;
}

/// Adds the keys of `own` that `all` lacks, and also those of the sections that both have: the beam
/// of a side-scan sonar has other keys than the beam of an imaging sonar.
inline void add_missing_keys(const SchemaJson& own, SchemaJson& all) {
    for (const auto& [key, value] : own.items()) {
        const bool section = value.contains("properties");
        if (!all.contains(key)) {
            all[key] = value;
            // Other kinds have other defaults.
            if (!section) all[key].erase("default");
        } else if (section) {
            add_missing_keys(value["properties"], all[key]["properties"]);
        }
    }
}

/// A default as it stands in YAML.
inline std::string default_text(const SchemaJson& value) {
    if (value.is_null()) return "";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return number_text(value.get<double>());
    if (!value.is_array() || value.empty()) return value.dump();
    std::string list;
    for (const SchemaJson& item : value)
        list += (list.empty() ? "[" : ", ") +
                (item.is_string() ? item.get<std::string>() : number_text(item.get<double>()));
    return list + "]";
}

}  // namespace sonarsim
