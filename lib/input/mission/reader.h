#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "input/mission/document.h"
#include "input/mission/sonar_keys.h"
#include "input/mission/trajectory_keys.h"
#include "input/mission/value_types.h"

namespace sonarsim {

/// The visitor that fills a section of a mission from YAML. A key that the document leaves out
/// keeps its value. Errors are collected in `errors` with their place. An InputError is thrown
/// only when the rest of a section cannot be checked because its kind is unknown.
class MissionReader : public KeyVisitor<MissionReader> {
  public:
    /// `name`: in messages. Relative paths start at `base_folder`. InputError if not a section.
    MissionReader(const YamlNode& node, std::string name, const std::filesystem::path& base_folder,
                  SonarKeyTable sonars, ErrorList& errors);

    template <class T, class Type>
    void value(const char* key, T& value, const Type& type, const char* /*meaning*/,
               Presence presence) {
        read_key(key, presence, [&](const YamlNode& node) {
            if constexpr (std::is_same_v<Type, PathType>) {
                type.read(node, key, value, base_folder_);
            } else {
                type.read(node, key, value);
            }
        });
        // Numbers, given or default, are for messages of require().
        constexpr bool is_number = std::is_same_v<Type, NumberType> || requires {
            std::tuple_size<T>::value;
        };
        if constexpr (is_number) numbers_.emplace_back(key, type.yaml(value));
    }

    void section(const char* key, auto& value, const char* /*meaning*/,
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

    void note_given(const char* key, bool& given) { given = node_.find(key) != nullptr; }

    /// Sets the form of a trajectory by the one key of `keys` that is present.
    void one_of(TrajectoryConfig& value, const std::vector<std::string>& keys) const;

    /// Reads the kind of a sonar and fills in its defaults, except for the name.
    const SonarKeys& one_of(const char* key, SonarConfig& value, const char* meaning);

    /// Checks a condition on several keys. A failure is reported at the last of `keys` in the file,
    /// with the values of those that are numbers.
    /// The check is skipped if one of the keys is faulty; if it fails, all of them are faulty.
    void require(bool holds, std::initializer_list<const char*> keys, const char* message);

    /// To be called after all keys are read: reports the other keys as unknown.
    void finish();

  private:
    void read(const YamlNode& node, std::string name, auto& value) {
        errors_.attempt([&] {
            MissionReader reader(node, std::move(name), base_folder_, sonars_, errors_);
            if constexpr (requires { value.place; }) value.place = node.place;
            describe(reader, value);
            reader.finish();
        });
    }

    /// Reads one key. If it is faulty, its value must not be used.
    void attempt(const char* key, const auto& read_key) {
        const std::size_t before = errors_.count();
        errors_.attempt(read_key);
        if (errors_.count() > before) faulty_.emplace_back(key);
    }

    /// The same for a key of this section, if it is there.
    void read_key(const char* key, Presence presence, const auto& read_node) {
        attempt(key, [&] {
            if (const YamlNode* node = find(key, presence)) read_node(*node);
        });
    }

    const YamlNode* find(const char* key, Presence presence);
    std::span<const YamlNode> list_items(const char* key, std::size_t fewest);
    const std::vector<YamlNode>& named_items(const char* key);

    const YamlNode& node_;
    std::string name_;
    const std::filesystem::path& base_folder_;
    SonarKeyTable sonars_;
    ErrorList& errors_;
    std::vector<std::string> known_;
    std::vector<std::string> faulty_;  ///< keys with an error
    /// Numbers read so far as YAML, by key.
    std::vector<std::pair<std::string, std::string>> numbers_;
};

}  // namespace sonarsim
