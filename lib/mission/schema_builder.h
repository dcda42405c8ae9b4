#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mission/json_types.h"
#include "mission/reference.h"
#include "mission/schema.h"

namespace sonarsim {

/// The visited section of the tables of keys, and the kind of sonar.
struct Visited {
    KeyTables* tables;  ///< null: the section is in the tables already
    std::string path = {};
    std::string form = {};
    std::string kind = {};

    Visited below(const std::string& key) const {
        return {tables, path.empty() ? key : path + "." + key, "", kind};
    }
};

/// The visitor that turns one section into an object of the schema, and into tables of keys.
class SchemaBuilder {
  public:
    SchemaBuilder(SonarKeyTable sonars, Visited at) : sonars_(sonars), at_(std::move(at)) {}

    void number(const char* key, double value, const Limits& limits, const char* meaning,
                Presence presence = Presence::optional) {
        if (presence == or_auto) {
            number(key, value == 0.0 ? std::nullopt : std::optional(value), limits, meaning);
            return;
        }
        add({key, "number", meaning, presence, limits}, within_limits("number", limits),
            number_json(value), number_text(value));
    }
    void number(const char* key, const std::optional<double>& value, const Limits& limits,
                const char* meaning) {
        add({key, "number", meaning, Presence::optional, limits, {"auto"}},
            {{"anyOf", {{{"const", "auto"}}, within_limits("number", limits)}}},
            value ? number_json(*value) : SchemaJson("auto"));
    }
    void number(const char* key, int value, const Limits& limits, const char* meaning) {
        add({key, "whole number", meaning, Presence::optional, limits},
            within_limits("integer", limits), value);
    }
    void number(const char* key, std::uint64_t value, const Limits& limits, const char* meaning) {
        add({key, "whole number", meaning, Presence::optional, limits},
            {{"type", "integer"},
             {"minimum", 0},
             {"maximum", std::numeric_limits<std::uint64_t>::max()}},
            value);
    }
    void number(const char* key, const std::array<double, 2>& value, const Limits& limits,
                const char* meaning) {
        add({key, "number or [least, largest]", meaning, Presence::optional, limits},
            {{"anyOf", {within_limits("number", limits), numbers_json(2, limits)}}},
            value[0] == value[1] ? number_json(value[0]) : numbers_of(value));
    }

    void flag(const char* key, bool value, const char* meaning) {
        add({key, "true or false", meaning}, {{"type", "boolean"}}, value);
    }

    void text(const char* key, const std::string&, const char* meaning,
              Presence presence = Presence::optional) {
        add({key, "text", meaning, presence}, text_json());
    }
    void text(const char* key, const std::vector<std::string>& values, const char* meaning) {
        add({key, "list of texts", meaning}, list_json(text_json(), 0),
            values.empty() ? SchemaJson() : SchemaJson(values), values.empty() ? "[]" : "");
    }
    void text(const char* key, const Renaming&, const char* meaning) {
        add({key, "text per name", meaning},
            {{"type", "object"}, {"additionalProperties", text_json()}}, {}, "{}");
    }
    void text(const char* key, const YamlValues&, const char* meaning) {
        add({key, "list of values", meaning}, list_json(SchemaJson::object(), 1));
    }

    void path(const char* key, const std::filesystem::path&, const char* meaning,
              Presence presence = Presence::optional) {
        add({key, "path", meaning, presence}, text_json());
    }
    void path(const char* key, const std::vector<std::filesystem::path>&, const char* meaning,
              Presence presence) {
        add({key, "path or list of paths", meaning, presence},
            {{"anyOf", {text_json(), list_json(text_json(), 1)}}});
    }

    template <std::size_t N>
    void array(const char* key, const std::array<double, N>& values, const Limits& limits,
               const char* meaning, Presence presence = Presence::optional) {
        add({key, std::to_string(N) + " numbers", meaning, presence, limits},
            numbers_json(N, limits), numbers_of(values));
    }
    template <std::size_t N>
    void array(const char* key, const std::optional<std::array<double, N>>&, const Limits& limits,
               const char* meaning) {
        add({key, std::to_string(N) + " numbers", meaning}, numbers_json(N, limits));
    }
    void array(const char* key, const std::vector<double>&, const Limits& limits,
               const char* meaning) {
        add({key, "list of numbers", meaning, Presence::optional, limits},
            list_json(within_limits("number", limits), 0), SchemaJson::array());
    }

    template <class T, std::size_t N>
    void choice(const char* key, const T& value, const std::array<Choice<T>, N>& choices,
                const char* meaning, Presence presence = Presence::optional) {
        const auto chosen = std::ranges::find(choices, value, &Choice<T>::value);
        SchemaJson names = SchemaJson::array();
        for (const Choice<T>& one : choices)
            names.push_back(choice_json(one.name));
        add({key, "choice", meaning, presence, {}, names_of(choices)}, {{"enum", std::move(names)}},
            chosen == choices.end() ? SchemaJson() : choice_json(chosen->name));
    }

    template <class T, std::size_t N>
    void subset(const char* key, const std::vector<T>&, const std::array<Choice<T>, N>& choices,
                const char* meaning) {
        SchemaJson some = list_json({{"enum", names_of(choices)}}, 0);
        some["uniqueItems"] = true;
        add({key, "true, false or a list", meaning, Presence::optional, {}, names_of(choices)},
            {{"anyOf", {{{"type", "boolean"}}, some}}}, false);
    }

    template <class T>
    void section(const char* key, T& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add({key, "section", meaning, presence}, {});
        complete(key, object_of(value, at_.below(key)));
    }
    /// Describes a section that has several forms. The tables have those of the vehicle.
    template <class... T>
    void section(const char* key, std::variant<T...>& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add({key, "section", meaning, presence}, {});
        SchemaJson forms = SchemaJson::array();
        ((value.template emplace<T>(), forms.push_back(object_of(value, at_.below(key)))), ...);
        complete(key, {{"type", "object"}, {"oneOf", std::move(forms)}});
    }
    template <class T>
    void section(const char* key, std::optional<T>&, const char* meaning) {
        T value;
        section(key, value, meaning);
    }

    template <class T>
    void list_of(const char* key, std::vector<T>&, std::size_t fewest, const char* meaning) {
        T item;
        const bool needed = fewest > 0;
        add({key,
             needed ? "list of " + std::to_string(fewest) + " or more"
                    : std::string("list of sections"),
             meaning, needed ? Presence::required : Presence::optional},
            {}, {}, needed ? "" : "[]");
        complete(key, list_json(object_of(item, at_.below(key + std::string(".0"))), fewest));
    }

    void named(const char* key, std::vector<SonarConfig>&, const char* meaning) {
        add({key, "section per name", meaning, required}, {});
        complete(key, {{"type", "object"},
                       {"minProperties", 1},
                       {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]{1,64}$"}}},
                       {"additionalProperties", sonar_json(key + std::string(".NAME"))}});
    }

    /// Each form requires a key of its own.
    template <class... T>
    void one_of(const std::variant<T...>& value,
                const std::array<const char*, sizeof...(T)>& keys) {
        at_.form = keys[value.index()];
        if (at_.path != "trajectory") at_.tables = nullptr;
    }

    const SonarKeys& one_of(const char* key, const SonarConfig& value, const char* meaning) {
        const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
        add({key, "choice", meaning, required, {}, {std::string(keys->name)}},
            {{"const", keys->name}});
        return *keys;
    }

    void require(bool, std::initializer_list<const char*>, const char* message) {
        checks_ += (checks_.empty() ? "" : "; ") + std::string(message);
        if (at_.tables != nullptr) at_.tables->add_check(at_.path, at_.form, message);
    }

    SchemaJson finish() {
        SchemaJson json{{"type", "object"}, {"properties", std::move(properties_)}};
        if (!required_.empty()) json["required"] = required_;
        json["additionalProperties"] = false;
        if (!checks_.empty()) json["$comment"] = checks_;
        return json;
    }

  private:
    struct Key {
        const char* name;
        std::string type;
        const char* meaning;
        Presence presence = Presence::optional;
        std::optional<Limits> limits = {};
        std::vector<std::string> choices = {};
    };

    /// `text`: the default in the tables, if it is not that of the schema.
    void add(Key key, SchemaJson json, const SchemaJson& value = {}, const std::string& text = "") {
        const bool needed = key.presence == required;
        json["description"] = key.meaning;
        if (needed) required_.emplace_back(key.name);
        if (!needed && !value.is_null()) json["default"] = value;
        properties_[key.name] = std::move(json);
        if (at_.tables == nullptr) return;
        at_.tables->add(at_.path, at_.form, at_.kind,
                        {.name = key.name,
                         .type = std::move(key.type),
                         .unit = {},
                         .required = needed,
                         .defaults = {},
                         .limits = key.limits,
                         .choices = std::move(key.choices),
                         .meaning = key.meaning},
                        text.empty() ? default_text(value) : text);
    }

    /// Adds the keys below a key to its schema.
    void complete(const char* key, SchemaJson json) {
        json["description"] = properties_[key]["description"];
        properties_[key] = std::move(json);
    }

    template <class T>
    SchemaJson object_of(T& value, Visited at) const {
        SchemaBuilder inner(sonars_, std::move(at));
        describe(inner, value);
        return inner.finish();
    }

    SchemaJson sonar_of(const SonarKeys& kind, const Choice<ModelKind>& model,
                        const std::string& path) const;
    SchemaJson sonar_json(const std::string& path) const;

    template <std::size_t N>
    static SchemaJson numbers_of(const std::array<double, N>& values) {
        SchemaJson list = SchemaJson::array();
        for (const double value : values)
            list.push_back(number_json(value));
        return list;
    }

    SonarKeyTable sonars_;
    Visited at_;
    SchemaJson properties_ = SchemaJson::object();
    std::vector<std::string> required_;
    std::string checks_;
};

}  // namespace sonarsim
