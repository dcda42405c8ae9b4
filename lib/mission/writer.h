#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "mission/document.h"
#include "mission/limits.h"
#include "mission/sonar_keys.h"

namespace sonarsim {

/// The visitor that writes a mission as YAML, with all values. It checks nothing.
class MissionWriter {
  public:
    explicit MissionWriter(SonarKeyTable sonars) : sonars_(sonars) {}

    const std::string& yaml() const { return yaml_; }

    void number(const char* key, double value, const Limits&, const char* meaning,
                Presence = Presence::optional);
    void number_or_auto(const char* key, double value, const Limits&, const char* meaning);
    void number_or_auto(const char* key, const std::optional<double>& value, const Limits&,
                        const char* meaning);
    void integer(const char* key, int value, const Limits&, const char* meaning);
    void integer(const char* key, std::uint64_t value, const char* meaning);
    void flag(const char* key, bool value, const char* meaning);
    void text(const char* key, std::string_view value, const char* meaning,
              Presence = Presence::optional);
    void texts(const char* key, const std::vector<std::string>& values, const char* meaning);
    void renaming(const char* key, const std::vector<std::pair<std::string, std::string>>& values,
                  const char* meaning);
    void values(const char* key, const std::vector<std::string>& values, const char* meaning);
    void range(const char* key, const std::array<double, 2>& value, const Limits&,
               const char* meaning);
    void paths(const char* key, const std::vector<std::filesystem::path>& values,
               const char* meaning, Presence);
    void path(const char* key, const std::filesystem::path& value, const char* meaning,
              Presence = Presence::optional);

    template <std::size_t N>
    void numbers(const char* key, const std::array<double, N>& values, const Limits&,
                 const char* /*meaning*/, Presence = Presence::optional) {
        write_list(key, values.data(), N);
    }

    void numbers(const char* key, const std::vector<double>& values, const Limits&,
                 const char* /*meaning*/) {
        if (!values.empty()) write_list(key, values.data(), values.size());
    }

    template <std::size_t N>
    void optional_numbers(const char* key, const std::optional<std::array<double, N>>& values,
                          const Limits&, const char* /*meaning*/) {
        if (values) write_list(key, values->data(), N);
    }

    template <class T, std::size_t N>
    void choice(const char* key, const T& value, const std::array<Choice<T>, N>& choices,
                const char* /*meaning*/, Presence = Presence::optional) {
        for (const Choice<T>& one : choices) {
            if (one.value == value) line(key, one.name);
        }
    }

    template <class T, std::size_t N>
    void subset(const char* key, const std::vector<T>& values,
                const std::array<Choice<T>, N>& choices, const char* /*meaning*/) {
        std::string list;
        for (const Choice<T>& one : choices) {
            if (std::ranges::find(values, one.value) == values.end()) continue;
            list += (list.empty() ? "[" : ", ") + std::string(one.name);
        }
        line(key, list.empty() ? "false" : list + "]");
    }

    void place(const MissionPlace&) const {}
    void place(const char*, const MissionPlace&) const {}

    const SonarKeys& sonar_kind(const char* key, const SonarConfig& value, const char* meaning);

    template <class T>
    void section(std::string_view key, T& value, const char* /*meaning*/,
                 Presence = Presence::optional) {
        line(key, "");
        indent_ += 2;
        describe(*this, value);
        indent_ -= 2;
    }

    template <class T>
    void optional_section(const char* key, std::optional<T>& value, const char* meaning) {
        if (value) section(key, *value, meaning);
    }

    template <class T>
    void list(const char* key, std::vector<T>& values, std::size_t, const char* /*meaning*/) {
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

    void require(bool, std::initializer_list<const char*>, const char*) const {}

  private:
    void write_list(const char* key, const double* values, std::size_t count);
    void line(std::string_view key, std::string_view value);

    SonarKeyTable sonars_;
    std::string yaml_;
    std::size_t indent_ = 0;
    bool item_ = false;  ///< the next line begins an item of a list
};

}  // namespace sonarsim
