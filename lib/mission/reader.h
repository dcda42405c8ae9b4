#pragma once

#include <array>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.h"
#include "mission/document.h"
#include "mission/limits.h"
#include "mission/node_values.h"
#include "mission/sonar_keys.h"
#include "mission/value_text.h"

namespace sonarsim {

/// The visitor that fills a section of a mission from YAML. A key that the document leaves out
/// keeps its value. Errors are collected in `errors` with their place. An InputError is thrown
/// only when the rest of a section cannot be checked because its kind is unknown.
class MissionReader {
  public:
    /// `name` is the section's name in messages. Relative paths start at `base_folder`. Throws
    /// InputError when the node is no section.
    MissionReader(const YamlNode& node, std::string name, const std::filesystem::path& base_folder,
                  SonarKeyTable sonars, ErrorList& errors);

    template <class T>
    void number(const char* key, T& value, const Limits& limits, const char* /*meaning*/,
                Presence presence = Presence::optional) {
        read_key(key, presence, [&](const YamlNode& node) {
            if constexpr (std::is_same_v<T, double>) {
                if (presence == or_auto) return read_or_auto(node, key, limits, value);
            }
            read_value(node, key, limits, value);
        });
        note(key, yaml_text(value));
    }

    void flag(const char* key, bool& value, const char* meaning);

    template <class T>
    void text(const char* key, T& value, const char* /*meaning*/,
              Presence presence = Presence::optional) {
        read_key(key, presence, [&](const YamlNode& node) { read_value(node, key, value); });
    }

    void path(const char* key, std::filesystem::path& value, const char* meaning,
              Presence presence = Presence::optional);
    /// Reads one path, or a list of one or more.
    void path(const char* key, std::vector<std::filesystem::path>& values, const char* meaning,
              Presence presence);

    template <std::size_t N>
    void array(const char* key, std::array<double, N>& values, const Limits& limits,
               const char* /*meaning*/, Presence presence = Presence::optional) {
        read_key(key, presence,
                 [&](const YamlNode& node) { read_numbers(node, key, values.data(), N, limits); });
        note(key, yaml_text(values));
    }
    template <std::size_t N>
    void array(const char* key, std::optional<std::array<double, N>>& values, const Limits& limits,
               const char* /*meaning*/) {
        read_key(key, Presence::optional, [&](const YamlNode& node) {
            read_numbers(node, key, values.emplace().data(), N, limits);
        });
    }
    /// Reads a list of any number of numbers.
    void array(const char* key, std::vector<double>& values, const Limits& limits,
               const char* meaning);

    template <class T, std::size_t N>
    void choice(const char* key, T& value, const std::array<Choice<T>, N>& choices,
                const char* /*meaning*/, Presence presence = Presence::optional) {
        read_key(key, presence, [&](const YamlNode& node) {
            value = choices[index_of(node, key, names_of(choices))].value;
        });
    }

    /// Reads `true` for all of the choices, `false` for none, or a list of some of them.
    template <class T, std::size_t N>
    void subset(const char* key, std::vector<T>& values, const std::array<Choice<T>, N>& choices,
                const char* /*meaning*/) {
        read_key(key, Presence::optional, [&](const YamlNode& node) {
            const std::vector<bool> chosen = chosen_of(node, key, names_of(choices));
            values.clear();
            for (std::size_t i = 0; i < N; ++i) {
                if (chosen[i]) values.push_back(choices[i].value);
            }
        });
    }

    template <class T>
    void section(const char* key, T& value, const char* /*meaning*/,
                 Presence presence = Presence::optional) {
        read_key(key, presence, [&](const YamlNode& node) { read(node, key, value); });
    }

    template <class T>
    void section(const char* key, std::optional<T>& value, const char* /*meaning*/) {
        read_key(key, Presence::optional,
                 [&](const YamlNode& node) { read(node, key, value.emplace()); });
    }

    /// Reads a list of at least `fewest` sections. If `fewest` is 0, the key is optional.
    template <class T>
    void list_of(const char* key, std::vector<T>& values, std::size_t fewest,
                 const char* /*meaning*/) {
        attempt(key, [&] {
            for (const YamlNode& item : list_items(key, fewest)) {
                std::string item_name = key + ("." + std::to_string(values.size()));
                read(item, std::move(item_name), values.emplace_back());
            }
        });
    }

    /// Reads a map from names to at least one section. Elements get their `name`.
    template <class T>
    void named(const char* key, std::vector<T>& values, const char* /*meaning*/) {
        attempt(key, [&] {
            for (const YamlNode& item : named_items(key)) {
                T& value = values.emplace_back();
                value.name = item.key;
                read(item, item.key, value);
            }
        });
    }

    /// Sets the alternative of `value` by the one key of `keys` that is present.
    template <class... T>
    void one_of(std::variant<T...>& value, const std::array<const char*, sizeof...(T)>& keys) {
        const std::size_t chosen = index_of_present({keys.begin(), keys.end()});
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            ((chosen == I ? void(value.template emplace<I>()) : void()), ...);
        }
        (std::index_sequence_for<T...>{});
    }

    /// Reads the kind of a sonar and fills in its defaults, except for the name.
    const SonarKeys& one_of(const char* key, SonarConfig& value, const char* meaning);

    /// Checks a condition on several keys. A failure is reported at the last of `keys` in the file,
    /// with the values of those that are numbers.
    /// The check is skipped if one of the keys is faulty; if it fails, all of them are faulty.
    void require(bool holds, std::initializer_list<const char*> keys, const char* message);

    /// To be called after all keys are read: reports the other keys as unknown.
    void finish();

  private:
    template <class T>
    void read(const YamlNode& node, std::string name, T& value) {
        errors_.attempt([&] {
            MissionReader reader(node, std::move(name), base_folder_, sonars_, errors_);
            if constexpr (requires { value.place; }) value.place.location = node.place.location();
            if constexpr (requires { value.laid; })
                value.laid.place.location = node.place.location();
            describe(reader, value);
            reader.finish();
        });
    }

    /// Reads one key. If it is faulty, its value must not be used.
    template <class Read>
    void attempt(const char* key, Read&& read_key) {
        const std::size_t before = errors_.count();
        errors_.attempt(read_key);
        if (errors_.count() > before) faulty_.emplace_back(key);
    }

    /// The same for a key of this section, if it is there.
    template <class Read>
    void read_key(const char* key, Presence presence, const Read& read_node) {
        attempt(key, [&] {
            if (const YamlNode* node = find(key, presence)) read_node(*node);
        });
    }

    /// Keeps the value of a key, given or default, for messages of require().
    void note(const char* key, std::string value) { values_.emplace_back(key, std::move(value)); }

    static void read_or_auto(const YamlNode& node, const char* key, const Limits& limits,
                             double& value);
    const YamlNode* find(const char* key, Presence presence);
    std::filesystem::path path_of(const YamlNode& node, const char* key) const;
    std::size_t index_of_present(const std::vector<std::string>& keys) const;
    std::span<const YamlNode> list_items(const char* key, std::size_t fewest);
    const std::vector<YamlNode>& named_items(const char* key);

    const YamlNode& node_;
    std::string name_;
    const std::filesystem::path& base_folder_;
    SonarKeyTable sonars_;
    ErrorList& errors_;
    std::vector<std::string> known_;
    std::vector<std::string> faulty_;  ///< keys with an error
    KeyTexts values_;                  ///< numbers read so far, by key
};

}  // namespace sonarsim
