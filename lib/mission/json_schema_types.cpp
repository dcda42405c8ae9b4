#include "mission/json_schema_types.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace sonarsim {

SchemaJson number_json(double value) {
    constexpr double exact = 9007199254740992.0;  // 2^53
    if (value == std::floor(value) && std::abs(value) <= exact)
        return static_cast<std::int64_t>(value);
    return value;
}

SchemaJson choice_json(const std::string& name) {
    if (name == "true" || name == "false") return name == "true";
    return name;
}

SchemaJson within_limits(const char* type, const Limits& limits) {
    SchemaJson json{{"type", type}};
    json[limits.low_allowed ? "minimum" : "exclusiveMinimum"] = number_json(limits.low);
    json["maximum"] = number_json(limits.high);
    return json;
}

SchemaJson text_json() {
    return {{"type", {"string", "number", "boolean"}},
            {"minLength", 1},
            {"pattern", "^[^\\u0000-\\u001f\\u007f]*$"}};
}

SchemaJson list_json(SchemaJson items, std::size_t fewest) {
    SchemaJson json{{"type", "array"}, {"items", std::move(items)}};
    if (fewest > 0) json["minItems"] = fewest;
    return json;
}

SchemaJson numbers_json(std::size_t count, const Limits& limits) {
    SchemaJson json = list_json(within_limits("number", limits), count);
    json["maxItems"] = count;
    return json;
}

void add_missing_keys(const SchemaJson& own, SchemaJson& all) {
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

}  // namespace sonarsim
