#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "mission/limits.h"
#include "mission/sonar_keys.h"
#include "mission/value_text.h"

namespace sonarsim {

/// The visitor that writes a mission as YAML, with all values. It checks nothing.
class MissionWriter {
  public:
    explicit MissionWriter(SonarKeyTable sonars) : sonars_(sonars) {}

    const std::string& yaml() const { return yaml_; }

    template <class T>
    void number(const char* key, const T& value, const Limits&, const char* /*meaning*/,
                Presence presence = Presence::optional) {
        write(key, presence == or_auto && value == T{} ? "auto" : yaml_text(value));
    }

    void flag(const char* key, bool value, const char* /*meaning*/) {
        write(key, yaml_text(value));
    }

    template <class T>
    void text(const char* key, const T& value, const char* /*meaning*/,
              Presence = Presence::optional) {
        write(key, yaml_text(value));
    }

    template <class T>
    void path(const char* key, const T& value, const char* /*meaning*/,
              Presence = Presence::optional) {
        write(key, yaml_text(value));
    }

    template <class T>
    void array(const char* key, const T& values, const Limits&, const char* /*meaning*/,
               Presence = Presence::optional) {
        write(key, yaml_text(values));
    }

    template <class T, std::size_t N>
    void choice(const char* key, const T& value, const std::array<Choice<T>, N>& choices,
                const char* /*meaning*/, Presence = Presence::optional) {
        write(key, std::ranges::find(choices, value, &Choice<T>::value)->name);
    }

    template <class T, std::size_t N>
    void subset(const char* key, const std::vector<T>& values,
                const std::array<Choice<T>, N>& choices, const char* /*meaning*/) {
        std::vector<Choice<T>> chosen;
        std::ranges::copy_if(choices, std::back_inserter(chosen), [&](const Choice<T>& one) {
            return std::ranges::find(values, one.value) != values.end();
        });
        write(key, chosen.empty() ? "false" : yaml_list(chosen, [](const auto& one) {
                  return std::string(one.name);
              }));
    }

    template <class T>
    void section(std::string_view key, T& value, const char* /*meaning*/,
                 Presence = Presence::optional) {
        line(key, "");
        indent_ += 2;
        describe(*this, value);
        indent_ -= 2;
    }

    template <class T>
    void section(std::string_view key, std::optional<T>& value, const char* meaning) {
        if (value) section(key, *value, meaning);
    }

    template <class T>
    void list_of(const char* key, std::vector<T>& values, std::size_t, const char* /*meaning*/) {
        line(key, values.empty() ? "[]" : "");
        indent_ += 4;
        for (T& value : values) {
            item_ = true;
            describe(*this, value);
        }
        indent_ -= 4;
    }

    template <class T>
    void named(const char* key, std::vector<T>& values, const char* meaning) {
        line(key, "");
        indent_ += 2;
        for (T& value : values)
            section(quoted_text(value.name), value, meaning);
        indent_ -= 2;
    }

    template <class... T>
    void one_of(const std::variant<T...>&, const std::array<const char*, sizeof...(T)>&) const {}

    const SonarKeys& one_of(const char* key, const SonarConfig& value, const char* /*meaning*/) {
        const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
        line(key, keys->name);
        return *keys;
    }

    void require(bool, std::initializer_list<const char*>, const char*) const {}

  private:
    void write(const char* key, const std::string& value) {
        if (!value.empty()) line(key, value);
    }

    void line(std::string_view key, std::string_view value) {
        yaml_.append(item_ ? indent_ - 2 : indent_, ' ');
        if (item_) yaml_ += "- ";
        item_ = false;
        yaml_.append(key).append(":");
        if (!value.empty()) yaml_.append(" ").append(value);
        yaml_ += '\n';
    }

    SonarKeyTable sonars_;
    std::string yaml_;
    std::size_t indent_ = 0;
    bool item_ = false;  ///< the next line begins an item of a list
};

}  // namespace sonarsim
