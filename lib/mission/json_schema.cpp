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
        add(key, within_limits("number", limits), meaning, presence, number_json(value));
    }
    void number_or_auto(const char* key, double value, const Limits& limits, const char* meaning) {
        const SchemaJson either{{"anyOf", {{{"const", "auto"}}, within_limits("number", limits)}}};
        add(key, either, meaning, Presence::optional,
            value == 0.0 ? SchemaJson("auto") : number_json(value));
    }
    void integer(const char* key, int value, const Limits& limits, const char* meaning) {
        add(key, within_limits("integer", limits), meaning, Presence::optional, value);
    }
    void integer(const char* key, std::uint64_t value, const char* meaning) {
        add(key,
            {{"type", "integer"},
             {"minimum", 0},
             {"maximum", std::numeric_limits<std::uint64_t>::max()}},
            meaning, Presence::optional, value);
    }
    void flag(const char* key, bool value, const char* meaning) {
        add(key, {{"type", "boolean"}}, meaning, Presence::optional, value);
    }
    void text(const char* key, const std::string&, const char* meaning,
              Presence presence = Presence::optional) {
        add(key, text_json(), meaning, presence);
    }
    void texts(const char* key, const std::vector<std::string>&, const char* meaning) {
        add(key, list_json(text_json(), 0), meaning);
    }
    void renaming(const char* key, const std::vector<std::pair<std::string, std::string>>&,
                  const char* meaning) {
        add(key, {{"type", "object"}, {"additionalProperties", text_json()}}, meaning);
    }
    void values(const char* key, const std::vector<std::string>&, const char* meaning) {
        add(key, list_json(SchemaJson::object(), 1), meaning);
    }
    void range(const char* key, const std::array<double, 2>& value, const Limits& limits,
               const char* meaning) {
        const SchemaJson either{
            {"anyOf", {within_limits("number", limits), numbers_json(2, limits)}}};
        add(key, either, meaning, Presence::optional,
            value[0] == value[1] ? number_json(value[0]) : list_of(value));
    }
    void path(const char* key, const std::filesystem::path&, const char* meaning,
              Presence presence = Presence::optional) {
        add(key, text_json(), meaning, presence);
    }
    void paths(const char* key, const std::vector<std::filesystem::path>&, const char* meaning,
               Presence presence) {
        add(key, {{"anyOf", {text_json(), list_json(text_json(), 1)}}}, meaning, presence);
    }

    template <std::size_t N>
    void numbers(const char* key, const std::array<double, N>& values, const Limits& limits,
                 const char* meaning, Presence presence = Presence::optional) {
        add(key, numbers_json(N, limits), meaning, presence, list_of(values));
    }
    template <std::size_t N>
    void optional_numbers(const char* key, const std::optional<std::array<double, N>>&,
                          const Limits& limits, const char* meaning) {
        add(key, numbers_json(N, limits), meaning);
    }

    template <class T, std::size_t N>
    void choice(const char* key, const T& value, const std::array<Choice<T>, N>& choices,
                const char* meaning, Presence presence = Presence::optional) {
        const auto chosen = std::ranges::find(choices, value, &Choice<T>::value);
        add(key, {{"enum", names_of(choices)}}, meaning, presence,
            chosen == choices.end() ? SchemaJson() : SchemaJson(chosen->name));
    }

    template <class T, std::size_t N>
    void subset(const char* key, const std::vector<T>&, const std::array<Choice<T>, N>& choices,
                const char* meaning) {
        SchemaJson some = list_json({{"enum", names_of(choices)}}, 0);
        some["uniqueItems"] = true;
        add(key, {{"anyOf", {{{"type", "boolean"}}, some}}}, meaning, Presence::optional, false);
    }

    void place(const MissionPlace&) const {}
    void place(const char*, const MissionPlace&) const {}

    const SonarKeys& sonar_kind(const char* key, const SonarConfig& value, const char* meaning) {
        const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
        add(key, {{"const", keys->name}}, meaning, required);
        return *keys;
    }

    template <class T>
    void section(const char* key, T& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add(key, object_of(value), meaning, presence);
    }
    /// Describes a section that has several forms.
    template <class... T>
    void section(const char* key, std::variant<T...>& value, const char* meaning,
                 Presence presence = Presence::optional) {
        SchemaJson forms = SchemaJson::array();
        ((value.template emplace<T>(), forms.push_back(object_of(value))), ...);
        add(key, {{"type", "object"}, {"oneOf", std::move(forms)}}, meaning, presence);
    }
    template <class T>
    void optional_section(const char* key, std::optional<T>&, const char* meaning) {
        T value;
        section(key, value, meaning);
    }

    template <class T>
    void list(const char* key, std::vector<T>&, std::size_t fewest, const char* meaning) {
        T item;
        add(key, list_json(object_of(item), fewest), meaning,
            fewest > 0 ? Presence::required : Presence::optional);
    }

    void named(const char* key, std::vector<SonarConfig>&, const char* meaning) {
        add(key,
            {{"type", "object"},
             {"minProperties", 1},
             {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]{1,64}$"}}},
             {"additionalProperties", sonar_json()}},
            meaning, required);
    }

    /// Each form requires a key of its own.
    template <class... T>
    void one_of(const std::variant<T...>&, const std::array<const char*, sizeof...(T)>&) {}

    void require(bool, std::initializer_list<const char*>, const char* message) {
        checks_ += (checks_.empty() ? "" : "; ") + std::string(message);
    }

    SchemaJson finish() {
        SchemaJson json{{"type", "object"}, {"properties", std::move(properties_)}};
        if (!required_.empty()) json["required"] = required_;
        json["additionalProperties"] = false;
        if (!checks_.empty()) json["$comment"] = checks_;
        return json;
    }

  private:
    void add(const char* key, SchemaJson type, const char* meaning,
             Presence presence = Presence::optional, const SchemaJson& value = {}) {
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

    /// Adds the missing keys to `all`, and also to the sections that both have: the beam of a
    /// side-scan sonar has other keys than the beam of an imaging sonar.
    static void add_missing_keys(const SchemaJson& own, SchemaJson& all) {
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
                // What is no model at all is checked by the rule of the default.
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
    std::string checks_;
};

}  // namespace

nlohmann::ordered_json mission_json_schema(SonarKeyTable sonars) {
    SchemaBuilder builder(sonars);
    Mission mission;
    describe(builder, mission);
    SchemaJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                      {"title", "sonarsim mission"},
                      {"description", "A scene, a trajectory and sonars, for sonarsim render."}};
    schema.update(builder.finish());
    return schema;
}

}  // namespace sonarsim
