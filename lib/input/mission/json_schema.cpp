#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "input/mission/reference.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// Writes a whole number as 5, not as 5.0.
Json number_json(double value) {
    constexpr double exact = 9007199254740992.0;  // 2^53
    if (value == any_unsigned.high) return std::numeric_limits<std::uint64_t>::max();
    if (value == std::floor(value) && std::abs(value) <= exact)
        return static_cast<std::int64_t>(value);
    return value;
}

/// `type`: "number" or "integer".
Json within(const char* type, const Limits& limits) {
    Json json{{"type", type}};
    json[limits.low_allowed ? "minimum" : "exclusiveMinimum"] = number_json(limits.low);
    json["maximum"] = number_json(limits.high);
    return json;
}

/// A default of the reference as JSON.
Json default_json(const std::string& yaml) {
    Json value = Json::parse(yaml, nullptr, false);
    return value.is_discarded() ? Json(yaml) : value;
}

Json list_json(Json items, std::size_t min_items, std::size_t max_items = 0) {
    Json json{{"type", "array"}, {"items", std::move(items)}};
    if (min_items > 0) json["minItems"] = min_items;
    if (max_items > 0) json["maxItems"] = max_items;
    return json;
}

/// The values that a key may have, unless it has keys below it.
Json type_json(const KeyReference& key) {
    // The reader accepts any scalar as text, even a number.
    Json text{{"type", {"string", "number", "boolean"}},
              {"minLength", 1},
              {"pattern", "^[^\\u0000-\\u001f\\u007f]*$"}};
    Json number = key.limits ? within("number", *key.limits) : Json();
    if (key.type == "number" && key.choices.empty()) return number;
    if (key.type == "number") return {{"anyOf", {{{"const", "auto"}}, number}}};
    if (key.type == "whole number") return within("integer", *key.limits);
    if (key.type == "number or [least, largest]")
        return {{"anyOf", {number, list_json(number, 2, 2)}}};
    if (key.type.ends_with(" numbers")) {
        const std::size_t count = std::stoul(key.type);
        return list_json(number, count, count);
    }
    if (key.type == "true or false") return {{"type", "boolean"}};
    if (key.type == "choice") return {{"enum", key.choices}};
    if (key.type == "true, false or a list") {
        Json some = list_json({{"enum", key.choices}}, 0);
        some["uniqueItems"] = true;
        return {{"anyOf", {{{"type", "boolean"}}, some}}};
    }
    if (key.type == "list of texts") return list_json(text, 0);
    if (key.type == "list of values") return list_json(Json::object(), 1);
    if (key.type == "text per name") return {{"type", "object"}, {"additionalProperties", text}};
    if (key.type == "path or list of paths") return {{"anyOf", {text, list_json(text, 1)}}};
    return text;
}

/// Makes the schema of the sections of a reference. `sonar` is the kind and model of a sonar whose
/// keys are wanted, as KeyReference::sonars has them; "": all keys.
class SchemaMaker {
  public:
    SchemaMaker(const std::vector<SectionReference>& sections, SonarKeyTable sonars)
        : sections_(sections), sonars_(sonars) {}

    /// The schema of a section, which has one form or several.
    Json section_json(const std::string& path, const std::string& sonar = "") const {
        Json forms = Json::array();
        for (const SectionReference& section : sections_) {
            if (section.path == path) forms.push_back(form_json(section, sonar));
        }
        if (forms.size() == 1) return forms[0];
        return {{"type", "object"}, {"oneOf", std::move(forms)}};
    }

  private:
    Json form_json(const SectionReference& section, const std::string& sonar) const {
        Json json{{"type", "object"}, {"properties", Json::object()}};
        for (const KeyReference& key : section.keys) {
            if (!sonar.empty() && !contains(key.sonars, sonar)) continue;
            json["properties"][key.name] = key_json(section.path, key, sonar);
            if (key.required) json["required"].push_back(key.name);
        }
        json["additionalProperties"] = false;
        if (!section.checks.empty()) json["$comment"] = listed(section.checks, "; ");
        return json;
    }

    Json key_json(const std::string& path, const KeyReference& key,
                  const std::string& sonar) const {
        const std::string own = path.empty() ? key.name : path + "." + key.name;
        Json json;
        if (key.type == "section per name") {
            json = {{"type", "object"},
                    {"minProperties", 1},
                    {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]{1,64}$"}}},
                    {"additionalProperties", sonars_json(own + ".NAME")}};
        } else if (key.type == "section") {
            json = section_json(key.name == "trajectory" ? key.name : own, sonar);
        } else if (key.type == "list of sections") {
            json = list_json(section_json(own + ".0", sonar), 0);
        } else if (key.type.starts_with("list of ") && key.type.ends_with(" or more")) {
            json = list_json(section_json(own + ".0", sonar), std::stoul(key.type.substr(8)));
        } else {
            json = type_json(key);
        }
        json["description"] = key.meaning;
        // Kinds of sonar have other defaults.
        const std::string kind = sonar.substr(0, sonar.find(','));
        for (const auto& [default_kind, yaml] : key.defaults) {
            if (default_kind == kind || default_kind.empty()) json["default"] = default_json(yaml);
        }
        return json;
    }

    /// A sonar's keys depend on its kind and model. A preset may give these: then all are allowed.
    Json sonars_json(const std::string& path) const {
        const std::vector<std::string> models = names_of(echo_models);
        const std::vector<std::string> others(models.begin() + 1, models.end());
        Json rules = Json::array();
        for (const SonarKeys& kind : sonars_) {
            for (const std::string& model : models) {
                const bool is_default = model == models.front();
                Json if_this{{"properties", {{"kind", {{"const", kind.name}}}}},
                             {"required", {"kind"}},
                             {"not", {{"required", {"preset"}}}}};
                // The default model's rule also holds for an unknown one: its name is checked.
                if_this["properties"]["model"] =
                    is_default ? Json{{"not", {{"enum", others}}}} : Json{{"const", model}};
                if (!is_default) if_this["required"].push_back("model");
                rules.push_back(
                    {{"if", std::move(if_this)},
                     {"then", section_json(path, std::string(kind.name) + ", " + model)}});
            }
        }
        Json all = section_json(path);
        all.erase("required");
        all["anyOf"] = {{{"required", {"kind"}}}, {{"required", {"preset"}}}};
        all["allOf"] = std::move(rules);
        return all;
    }

    const std::vector<SectionReference>& sections_;
    SonarKeyTable sonars_;
};

}  // namespace

Json reference_schema(const std::vector<SectionReference>& sections, SonarKeyTable sonars) {
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "sonarsim mission"},
                {"description", "A scene, a trajectory and sonars, for sonarsim render."}};
    schema.update(SchemaMaker(sections, sonars).section_json(""));
    return schema;
}

}  // namespace sonarsim
