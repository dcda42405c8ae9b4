#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "core/text.h"
#include "input/mission/document.h"
#include "input/mission/limits.h"
#include "input/mission/seabed_keys.h"
#include "input/mission/variation_keys.h"

// The types of the keys that have one value. A type reads a value from YAML, writes it as YAML, and
// is described in the tables of keys. `key`: for messages. read() throws InputError with the place.

namespace sonarsim {

/// Throws "'key' must be WANTED, not FOUND".
[[noreturn]] void refuse_type(const YamlNode& node, const std::string& key,
                              const std::string& wanted);

/// "at least 0" for a number that is not within the limits, else "".
std::string fault_of(double value, const Limits& limits);

/// Returns the index of the node's text in `names`.
std::size_t index_of(const YamlNode& node, const char* key, const std::vector<std::string>& names);

/// Returns for each name whether it is chosen: `true` chooses all, `false` none, a list some.
std::vector<bool> chosen_of(const YamlNode& node, const char* key,
                            const std::vector<std::string>& names);

// The value of a key as YAML; "": the key is not written.

/// YAML 1.1, as of PyYAML, takes 1e+06 for text, but 1.0e+06 for a number.
inline std::string yaml_text(double value) {
    std::string text = number_text(value);
    const std::size_t exponent = text.find('e');
    if (exponent < text.find('.')) text.insert(exponent, ".0");
    return text;
}
inline std::string yaml_text(std::integral auto value) {
    return std::to_string(value);
}
inline std::string yaml_text(bool value) {
    return value ? "true" : "false";
}
inline std::string yaml_text(const std::optional<double>& value) {
    return value ? yaml_text(*value) : "auto";
}

/// Text is always quoted, so that a sensor named "null" stays text.
inline std::string yaml_text(const std::string& value) {
    return value.empty() ? "" : quoted_text(value);
}
inline std::string yaml_text(const std::filesystem::path& value) {
    return yaml_text(value.string());
}

/// "[1, 2]"; "" for no items.
inline std::string yaml_text(const YamlValues& values) {
    return values.items.empty() ? "" : "[" + listed(values.items) + "]";
}
std::string yaml_text(const std::ranges::range auto& values) {
    YamlValues texts;
    for (const auto& value : values)
        texts.items.push_back(yaml_text(value));
    return yaml_text(texts);
}
template <std::size_t N>
std::string yaml_text(const std::optional<std::array<double, N>>& values) {
    return values ? yaml_text(*values) : "";
}
inline std::string yaml_text(const Renaming& values) {
    std::string map;
    for (const auto& [from, to] : values)
        map += (map.empty() ? "{" : ", ") + quoted_text(from) + ": " + quoted_text(to);
    return map.empty() ? "" : map + "}";
}

/// The description of a type in the tables of keys.
struct TypeNote {
    std::string name;
    std::optional<Limits> limits = {};      ///< limits of the number, or of every number of a list
    std::vector<std::string> choices = {};  ///< allowed names; empty: anything
    std::string empty = {};                 ///< default of a value that is not written
};

/// A number, or with std::array a number or a list of the least and the largest.
struct NumberType {
    Limits limits;
    bool automatic = false;  ///< takes the word auto, which is kept as 0

    void read(const YamlNode& node, const char* key, double& value) const;
    void read(const YamlNode& node, const char* key, int& value) const;
    void read(const YamlNode& node, const char* key, std::uint64_t& value) const;
    void read(const YamlNode& node, const char* key, std::optional<double>& value) const;
    void read(const YamlNode& node, const char* key, std::array<double, 2>& value) const;
    void read(const YamlNode& node, const char* key,
              std::optional<std::array<double, 2>>& value) const {
        read(node, key, value.emplace());
    }
    template <class T>
    std::string yaml(const T& value) const {
        return automatic && value == T{} ? "auto" : yaml_text(value);
    }
    TypeNote note(double) const {
        return automatic ? note(std::optional<double>()) : TypeNote{"number", limits};
    }
    TypeNote note(const std::optional<double>&) const { return {"number", limits, {"auto"}}; }
    TypeNote note(std::integral auto) const { return {"whole number", limits}; }
    TypeNote note(const std::array<double, 2>&) const {
        return {"number or [least, largest]", limits};
    }
    TypeNote note(const std::optional<std::array<double, 2>>&) const {
        return note(std::array<double, 2>{});
    }
};

/// A list of exactly as many numbers as the value has.
struct ArrayType {
    Limits limits;

    void read(const YamlNode& node, const char* key, std::span<double> values) const;
    template <std::size_t N>
    void read(const YamlNode& node, const char* key,
              std::optional<std::array<double, N>>& values) const {
        read(node, key, values.emplace());
    }
    std::string yaml(const auto& values) const { return yaml_text(values); }
    TypeNote note(std::span<const double> values) const {
        return {std::to_string(values.size()) + " numbers", limits};
    }
    template <std::size_t N>
    TypeNote note(const std::optional<std::array<double, N>>&) const {
        return note(std::array<double, N>{});
    }
};

/// A text, a list of texts, a map from texts to texts, or a list of any values.
struct TextType {
    void read(const YamlNode& node, const char* key, std::string& value) const;
    void read(const YamlNode& node, const char* key, std::vector<std::string>& values) const;
    void read(const YamlNode& node, const char* key, Renaming& values) const;
    void read(const YamlNode& node, const char* key, YamlValues& values) const;
    std::string yaml(const auto& value) const { return yaml_text(value); }
    TypeNote note(const std::string&) const { return {"text"}; }
    TypeNote note(const std::vector<std::string>&) const {
        return {.name = "list of texts", .empty = "[]"};
    }
    TypeNote note(const Renaming&) const { return {.name = "text per name", .empty = "{}"}; }
    TypeNote note(const YamlValues&) const { return {"list of values"}; }
};

struct FlagType {
    void read(const YamlNode& node, const char* key, bool& value) const;
    std::string yaml(bool value) const { return yaml_text(value); }
    TypeNote note(bool) const { return {"true or false"}; }
};

/// A path, or a list of one or more. Relative ones start at the base folder of the mission.
struct PathType {
    void read(const YamlNode& node, const char* key, std::filesystem::path& path,
              const std::filesystem::path& base_folder) const;
    void read(const YamlNode& node, const char* key, std::vector<std::filesystem::path>& paths,
              const std::filesystem::path& base_folder) const;
    std::string yaml(const auto& value) const { return yaml_text(value); }
    TypeNote note(const std::filesystem::path&) const { return {"path"}; }
    TypeNote note(const std::vector<std::filesystem::path>&) const {
        return {"path or list of paths"};
    }
};

/// One of some names.
template <class T>
struct ChoiceType {
    Choices<T> choices;

    void read(const YamlNode& node, const char* key, T& value) const {
        value = choices[index_of(node, key, names_of(choices))].value;
    }
    std::string yaml(const T& value) const {
        return std::ranges::find(choices, value, &Choice<T>::value)->name;
    }
    TypeNote note(const T&) const { return {"choice", {}, names_of(choices)}; }
};

/// `true` for all names, `false` for none, or a list of some.
template <class T>
struct SubsetType {
    Choices<T> choices;

    void read(const YamlNode& node, const char* key, std::vector<T>& values) const {
        const std::vector<bool> chosen = chosen_of(node, key, names_of(choices));
        values.clear();
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            if (chosen[i]) values.push_back(choices[i].value);
        }
    }
    std::string yaml(const std::vector<T>& values) const {
        YamlValues chosen;
        for (const Choice<T>& one : choices) {
            if (contains(values, one.value)) chosen.items.emplace_back(one.name);
        }
        return chosen.items.empty() ? "false" : yaml_text(chosen);
    }
    TypeNote note(const std::vector<T>&) const {
        return {"true, false or a list", {}, names_of(choices)};
    }
};

/// The base of a visitor of keys: passes them to its value(key, value, type, meaning, presence).
template <class Visitor>
class KeyVisitor {
  public:
    void number(const char* key, auto& value, const Limits& limits, const char* meaning,
                Presence presence = Presence::optional) {
        self().value(key, value, NumberType{limits, presence == or_auto}, meaning, presence);
    }
    void flag(const char* key, bool& value, const char* meaning) {
        self().value(key, value, FlagType{}, meaning, Presence::optional);
    }
    void text(const char* key, auto& value, const char* meaning,
              Presence presence = Presence::optional) {
        self().value(key, value, TextType{}, meaning, presence);
    }
    void path(const char* key, auto& value, const char* meaning,
              Presence presence = Presence::optional) {
        self().value(key, value, PathType{}, meaning, presence);
    }
    void array(const char* key, auto& values, const Limits& limits, const char* meaning,
               Presence presence = Presence::optional) {
        self().value(key, values, ArrayType{limits}, meaning, presence);
    }
    template <class T>
    void choice(const char* key, T& value, std::type_identity_t<Choices<T>> choices,
                const char* meaning) {
        self().value(key, value, ChoiceType<T>{choices}, meaning, Presence::optional);
    }
    template <class T>
    void subset(const char* key, std::vector<T>& values, std::type_identity_t<Choices<T>> choices,
                const char* meaning) {
        self().value(key, values, SubsetType<T>{choices}, meaning, Presence::optional);
    }
    /// Readers note in `given` whether the mission has a key.
    void note_given(const char* /*key*/, bool& /*given*/) {}

  private:
    Visitor& self() { return static_cast<Visitor&>(*this); }
};

}  // namespace sonarsim
