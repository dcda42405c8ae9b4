#include "mission/json_schema.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mission/json_schema_types.h"
#include "mission/schema.h"

namespace sonarsim {

namespace {

/// The visitor that turns one section into an object of the schema.
class SchemaBuilder {
  public:
    explicit SchemaBuilder(SonarKeyTable sonars) : sonars_(sonars) {}

    void number(const char* key, double value, const Limits& limits, const char* meaning,
                Presence presence = Presence::optional) {
        add(key, "number", within_limits("number", limits), meaning, presence, number_json(value));
    }
    void number_or_auto(const char* key, double value, const Limits& limits, const char* meaning) {
        number_or_auto(key, value == 0.0 ? std::nullopt : std::optional(value), limits, meaning);
    }
    void number_or_auto(const char* key, const std::optional<double>& value, const Limits& limits,
                        const char* meaning) {
        const SchemaJson either{{"anyOf", {{{"const", "auto"}}, within_limits("number", limits)}}};
        add(key, "number", either, meaning, Presence::optional,
            value ? number_json(*value) : SchemaJson("auto"));
    }
    void integer(const char* key, int value, const Limits& limits, const char* meaning) {
        add(key, "whole number", within_limits("integer", limits), meaning, Presence::optional,
            value);
    }
    void integer(const char* key, std::uint64_t value, const char* meaning) {
        add(key, "whole number",
            {{"type", "integer"},
             {"minimum", 0},
             {"maximum", std::numeric_limits<std::uint64_t>::max()}},
            meaning, Presence::optional, value);
    }
    void flag(const char* key, bool value, const char* meaning) {
        add(key, "true or false", {{"type", "boolean"}}, meaning, Presence::optional, value);
    }
    void text(const char* key, const std::string&, const char* meaning,
              Presence presence = Presence::optional) {
        add(key, "text", text_json(), meaning, presence);
    }
    void texts(const char* key, const std::vector<std::string>& values, const char* meaning) {
        add(key, "list of texts", list_json(text_json(), 0), meaning, Presence::optional,
            values.empty() ? SchemaJson() : SchemaJson(values));
    }
    void renaming(const char* key, const std::vector<std::pair<std::string, std::string>>&,
                  const char* meaning) {
        add(key, "text per name", {{"type", "object"}, {"additionalProperties", text_json()}},
            meaning);
    }
    void values(const char* key, const std::vector<std::string>&, const char* meaning) {
        add(key, "list of values", list_json(SchemaJson::object(), 1), meaning);
    }
    void range(const char* key, const std::array<double, 2>& value, const Limits& limits,
               const char* meaning) {
        const SchemaJson either{
            {"anyOf", {within_limits("number", limits), numbers_json(2, limits)}}};
        add(key, "number or [least, largest]", either, meaning, Presence::optional,
            value[0] == value[1] ? number_json(value[0]) : list_of(value));
    }
    void path(const char* key, const std::filesystem::path&, const char* meaning,
              Presence presence = Presence::optional) {
        add(key, "path", text_json(), meaning, presence);
    }
    void paths(const char* key, const std::vector<std::filesystem::path>&, const char* meaning,
               Presence presence) {
        add(key, "path or list of paths", {{"anyOf", {text_json(), list_json(text_json(), 1)}}},
            meaning, presence);
    }

    template <std::size_t N>
    void numbers(const char* key, const std::array<double, N>& values, const Limits& limits,
                 const char* meaning, Presence presence = Presence::optional) {
        add(key, std::to_string(N) + " numbers", numbers_json(N, limits), meaning, presence,
            list_of(values));
    }
    void numbers(const char* key, const std::vector<double>&, const Limits& limits,
                 const char* meaning) {
        add(key, "list of numbers", list_json(within_limits("number", limits), 0), meaning,
            Presence::optional, SchemaJson::array());
    }
    template <std::size_t N>
    void optional_numbers(const char* key, const std::optional<std::array<double, N>>&,
                          const Limits& limits, const char* meaning) {
        add(key, std::to_string(N) + " numbers", numbers_json(N, limits), meaning);
    }

    template <class T, std::size_t N>
    void choice(const char* key, const T& value, const std::array<Choice<T>, N>& choices,
                const char* meaning, Presence presence = Presence::optional) {
        const auto chosen = std::ranges::find(choices, value, &Choice<T>::value);
        SchemaJson names = SchemaJson::array();
        for (const Choice<T>& one : choices)
            names.push_back(choice_json(one.name));
        add(key, "choice", {{"enum", std::move(names)}}, meaning, presence,
            chosen == choices.end() ? SchemaJson() : choice_json(chosen->name));
    }

    template <class T, std::size_t N>
    void subset(const char* key, const std::vector<T>&, const std::array<Choice<T>, N>& choices,
                const char* meaning) {
        SchemaJson some = list_json({{"enum", names_of(choices)}}, 0);
        some["uniqueItems"] = true;
        add(key, "true, false or a list", {{"anyOf", {{{"type", "boolean"}}, some}}}, meaning,
            Presence::optional, false);
    }

    void place(const MissionPlace&) const {}
    void place(const char*, const MissionPlace&) const {}

    const SonarKeys& sonar_kind(const char* key, const SonarConfig& value, const char* meaning) {
        const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
        add(key, "choice", {{"const", keys->name}}, meaning, required);
        return *keys;
    }

    template <class T>
    void section(const char* key, T& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add(key, "section", object_of(value), meaning, presence);
    }
    /// Describes a section that has several forms.
    template <class... T>
    void section(const char* key, std::variant<T...>& value, const char* meaning,
                 Presence presence = Presence::optional) {
        SchemaJson forms = SchemaJson::array();
        ((value.template emplace<T>(), forms.push_back(object_of(value))), ...);
        add(key, "section", {{"type", "object"}, {"oneOf", std::move(forms)}}, meaning, presence);
    }
    template <class T>
    void optional_section(const char* key, std::optional<T>&, const char* meaning) {
        T value;
        section(key, value, meaning);
    }

    template <class T>
    void list(const char* key, std::vector<T>&, std::size_t fewest, const char* meaning) {
        T item;
        const std::string fewest_text = "list of " + std::to_string(fewest) + " or more";
        add(key, fewest > 0 ? fewest_text : "list of sections", list_json(object_of(item), fewest),
            meaning, fewest > 0 ? Presence::required : Presence::optional);
    }

    void named(const char* key, std::vector<SonarConfig>&, const char* meaning) {
        add(key, "section per name",
            {{"type", "object"},
             {"minProperties", 1},
             {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]{1,64}$"}}},
             {"additionalProperties", sonar_json()}},
            meaning, required);
    }

    /// Each form requires a key of its own.
    template <class... T>
    void one_of(const std::variant<T...>& value,
                const std::array<const char*, sizeof...(T)>& keys) {
        form_ = keys[value.index()];
    }

    void require(bool, std::initializer_list<const char*>, const char* message) {
        checks_.push_back(message);
    }

    SchemaJson finish() {
        SchemaJson json{{"type", "object"}, {"properties", std::move(properties_)}};
        if (!required_.empty()) json["required"] = required_;
        json["additionalProperties"] = false;
        if (!checks_.empty()) json["$comment"] = checks_;
        if (!form_.empty()) json[schema_note_form] = form_;
        return json;
    }

  private:
    void add(const char* key, const std::string& type_name, SchemaJson type, const char* meaning,
             Presence presence = Presence::optional, const SchemaJson& value = {}) {
        type[schema_note_type] = type_name;
        type["description"] = meaning;
        if (presence == Presence::required) {
            required_.emplace_back(key);
        } else if (!value.is_null()) {
            type["default"] = value;
        }
        properties_[key] = std::move(type);
    }

    template <class T>
    SchemaJson object_of(T& value) const {
        SchemaBuilder inner(sonars_);
        describe(inner, value);
        return inner.finish();
    }

    /// The keys of a sonar of this kind and model.
    SchemaJson sonar_of(const SonarKeys& kind, const Choice<ModelKind>& model) const {
        SonarConfig sonar = kind.defaults;
        sonar.model = model.value;
        SchemaJson json = object_of(sonar);
        json["properties"]["model"]["enum"] = {model.name};
        json["properties"]["model"]["default"] = echo_models[0].name;
        if (model.value != echo_models[0].value) json["required"].push_back("model");
        return json;
    }

    /// A sonar's keys depend on its kind and model. A preset may give these, so that with a preset
    /// all keys of all kinds are allowed.
    SchemaJson sonar_json() const {
        SchemaJson kinds = SchemaJson::array();
        SchemaJson all_keys = SchemaJson::object();
        SchemaJson rules = SchemaJson::array();
        for (const SonarKeys& kind : sonars_) {
            kinds.push_back(kind.name);
            for (const Choice<ModelKind>& model : echo_models) {
                const bool is_default = model.value == echo_models[0].value;
                SchemaJson own = sonar_of(kind, model);
                add_missing_keys(own["properties"], all_keys);
                SchemaJson if_this{{"properties", {{"kind", {{"const", kind.name}}}}},
                                   {"required", {"kind"}},
                                   {"not", {{"required", {"preset"}}}}};
                // The rule of the default model also holds for an unknown model, so that its name
                // is checked.
                SchemaJson others = names_of(echo_models);
                others.erase(0);
                if_this["properties"]["model"] =
                    is_default ? SchemaJson{{"not", {{"enum", std::move(others)}}}}
                               : SchemaJson{{"const", model.name}};
                if (!is_default) if_this["required"].push_back("model");
                rules.push_back({{"if", std::move(if_this)}, {"then", std::move(own)}});
            }
        }
        all_keys["kind"] = {{"enum", std::move(kinds)}, {"description", "the kind of sonar"}};
        all_keys["model"] = {{"enum", names_of(echo_models)},
                             {"description", all_keys["model"]["description"]}};
        return {{"type", "object"},
                {"properties", std::move(all_keys)},
                {"additionalProperties", false},
                {"anyOf", {{{"required", {"kind"}}}, {{"required", {"preset"}}}}},
                {"allOf", std::move(rules)}};
    }

    SonarKeyTable sonars_;
    SchemaJson properties_ = SchemaJson::object();
    std::vector<std::string> required_;
    SchemaJson checks_ = SchemaJson::array();
    std::string form_;  ///< key that selects this form of a section with several forms
};

/// Removes the notes for the tables of keys, and joins the checks.
void remove_notes(SchemaJson& json) {
    if (json.is_object()) {
        json.erase(schema_note_type);
        json.erase(schema_note_form);
        const auto comment = json.find("$comment");
        if (comment != json.end() && comment->is_array()) {
            std::string text;
            for (const SchemaJson& check : *comment)
                text += (text.empty() ? "" : "; ") + check.get<std::string>();
            *comment = text;
        }
    }
    for (SchemaJson& child : json) {
        if (child.is_structured()) remove_notes(child);
    }
}

}  // namespace

nlohmann::ordered_json mission_json_schema(SonarKeyTable sonars) {
    SchemaJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                      {"title", "sonarsim mission"},
                      {"description", "A scene, a trajectory and sonars, for sonarsim render."}};
    schema.update(noted_json_schema(sonars));
    remove_notes(schema);
    return schema;
}

nlohmann::ordered_json noted_json_schema(SonarKeyTable sonars) {
    SchemaBuilder builder(sonars);
    Mission mission;
    describe(builder, mission);
    return builder.finish();
}

}  // namespace sonarsim
