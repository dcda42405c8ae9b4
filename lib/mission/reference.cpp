#include "mission/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string_view>
#include <variant>

#include "core/text.h"
#include "mission/schema.h"

namespace sonarsim {

namespace {

std::string unit_of(std::string_view key) {
    using Unit = std::pair<std::string_view, const char*>;
    // Longer endings first: a speed ends in _m_s and a length in _m.
    constexpr std::array units{Unit{"_kg_m3", "kg/m^3"}, Unit{"_db", "dB"},   Unit{"_rad", "rad"},
                               Unit{"_c", "Celsius"},    Unit{"_psu", "psu"}, Unit{"_m_s", "m/s"},
                               Unit{"_deg", "deg"},      Unit{"_hz", "Hz"},   Unit{"_mb", "MB"},
                               Unit{"_px", "pixels"},    Unit{"_m", "m"}};
    for (const auto& [ending, unit] : units) {
        if (key.ends_with(ending)) return unit;
    }
    return "";
}

/// The visitor that collects the documentation of every key. It visits a sonar once for each kind
/// and a trajectory once for each form.
class KeyCollector {
  public:
    explicit KeyCollector(SonarKeyTable sonars) : sonars_(sonars) {}

    std::vector<SectionReference> sections{{}};

    void number(const char* key, double value, const Limits& limits, const char* meaning,
                Presence presence = Presence::optional) {
        add(key, "number", number_text(value), meaning, presence).limits = limits;
    }
    void number_or_auto(const char* key, double value, const Limits& limits, const char* meaning) {
        KeyReference& row = add(key, "number", value == 0.0 ? "auto" : number_text(value), meaning);
        row.limits = limits;
        row.choices = {"auto"};
    }
    void integer(const char* key, int value, const Limits& limits, const char* meaning) {
        add(key, "whole number", std::to_string(value), meaning).limits = limits;
    }
    void integer(const char* key, std::uint64_t value, const char* meaning) {
        // The largest double that is a 64-bit number.
        const double largest = std::nextafter(std::ldexp(1.0, 64), 0.0);
        add(key, "whole number", std::to_string(value), meaning).limits = between(0, largest);
    }
    void flag(const char* key, bool value, const char* meaning) {
        add(key, "true or false", value ? "true" : "false", meaning);
    }
    void text(const char* key, const std::string&, const char* meaning,
              Presence presence = Presence::optional) {
        add(key, "text", "", meaning, presence);
    }
    void texts(const char* key, const std::vector<std::string>&, const char* meaning) {
        add(key, "list of texts", "[]", meaning);
    }
    void renaming(const char* key, const std::vector<std::pair<std::string, std::string>>&,
                  const char* meaning) {
        add(key, "text per name", "{}", meaning);
    }
    void values(const char* key, const std::vector<std::string>&, const char* meaning) {
        add(key, "list of values", "", meaning);
    }
    void range(const char* key, const std::array<double, 2>& value, const Limits& limits,
               const char* meaning) {
        const std::string low = number_text(value[0]);
        const bool is_one = value[0] == value[1];
        add(key, "number or [least, largest]",
            is_one ? low : "[" + low + ", " + number_text(value[1]) + "]", meaning)
            .limits = limits;
    }
    void paths(const char* key, const std::vector<std::filesystem::path>&, const char* meaning,
               Presence presence) {
        add(key, "path or list of paths", "", meaning, presence);
    }
    template <std::size_t N>
    void optional_numbers(const char* key, const std::optional<std::array<double, N>>&,
                          const Limits&, const char* meaning) {
        add(key, std::to_string(N) + " numbers", "", meaning);
    }
    void path(const char* key, const std::filesystem::path&, const char* meaning,
              Presence presence = Presence::optional) {
        add(key, "path", "", meaning, presence);
    }

    template <std::size_t N>
    void numbers(const char* key, const std::array<double, N>& values, const Limits& limits,
                 const char* meaning, Presence presence = Presence::optional) {
        std::string list;
        for (const double value : values)
            list += (list.empty() ? "[" : ", ") + number_text(value);
        add(key, std::to_string(N) + " numbers", list + "]", meaning, presence).limits = limits;
    }

    template <class T, std::size_t N>
    void choice(const char* key, const T& value, const std::array<Choice<T>, N>& choices,
                const char* meaning, Presence presence = Presence::optional) {
        std::vector<std::string> names;
        std::string chosen;
        for (const Choice<T>& one : choices) {
            names.emplace_back(one.name);
            if (one.value == value) chosen = one.name;
        }
        add(key, "choice", chosen, meaning, presence).choices = std::move(names);
    }

    template <class T, std::size_t N>
    void subset(const char* key, const std::vector<T>&, const std::array<Choice<T>, N>& choices,
                const char* meaning) {
        std::vector<std::string> names;
        for (const Choice<T>& one : choices)
            names.emplace_back(one.name);
        add(key, "true, false or a list", "false", meaning).choices = std::move(names);
    }

    void place(const MissionPlace&) const {}
    void place(const char*, const MissionPlace&) const {}

    const SonarKeys& sonar_kind(const char* key, const SonarConfig& value, const char* meaning) {
        std::vector<std::string> names;
        for (const SonarKeys& one : sonars_)
            names.emplace_back(one.name);
        const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
        add(key, "choice", std::string(keys->name), meaning, required).choices = std::move(names);
        return *keys;
    }

    template <class T>
    void section(const char* key, T& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add(key, "section", "", meaning, presence);
        enter(path_below(key), value);
    }

    template <class T>
    void optional_section(const char* key, std::optional<T>&, const char* meaning) {
        T value;
        section(key, value, meaning);
    }
    /// The tables of a trajectory are at the vehicle's trajectory.
    void optional_section(const char* key, std::optional<TrajectoryConfig>&, const char* meaning) {
        add(key, "section", "", meaning);
    }

    /// Visits a section that has several forms.
    template <class... T>
    void section(const char* key, std::variant<T...>& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add(key, "section", "", meaning, presence);
        ((value.template emplace<T>(), enter(path_below(key), value)), ...);
    }

    template <class T>
    void list(const char* key, std::vector<T>&, std::size_t fewest, const char* meaning) {
        const std::string type = "list of " + std::to_string(fewest) + " or more";
        if (fewest > 0) {
            add(key, type, "", meaning, required);
        } else {
            add(key, "list of sections", "[]", meaning);
        }
        T item;
        enter(path_below(key) + ".0", item);
    }

    void named(const char* key, std::vector<SonarConfig>&, const char* meaning) {
        add(key, "section per name", "", meaning, required);
        for (const SonarKeys& kind : sonars_) {
            kind_ = kind.name;
            for (const auto& [name, model] : echo_models) {
                SonarConfig sonar = kind.defaults;
                sonar.model = model;
                enter(path_below(key) + ".NAME", sonar);
            }
            kind_.clear();
        }
    }

    template <class... T>
    void one_of(const std::variant<T...>& value,
                const std::array<const char*, sizeof...(T)>& keys) {
        current_ = index_of(sections[current_].path, keys[value.index()]);
    }

    void require(bool, std::initializer_list<const char*>, const char* message) {
        std::vector<std::string>& checks = sections[current_].checks;
        if (std::ranges::find(checks, message) == checks.end()) checks.emplace_back(message);
    }

  private:
    /// Returns the key's entry in the current section. Defaults of kinds visited before are kept.
    KeyReference& add(const char* key, std::string type, std::string value, const char* meaning,
                      Presence presence = Presence::optional) {
        std::vector<KeyReference>& keys = sections[current_].keys;
        auto row = std::ranges::find(keys, key, &KeyReference::name);
        if (row == keys.end()) {
            // A key that only a later kind of sonar has is inserted in the order of that kind.
            const auto before = std::ranges::find(keys, last_key_, &KeyReference::name);
            row = keys.insert(before == keys.end() ? before : std::next(before),
                              {.name = key,
                               .type = std::move(type),
                               .unit = unit_of(key),
                               .required = presence == Presence::required,
                               .defaults = {},
                               .limits = {},
                               .choices = {},
                               .meaning = meaning});
        }
        last_key_ = key;
        // Both models of a kind have the same defaults; the default of `model` is `paper`.
        const bool told = std::ranges::find(row->defaults, kind_, [](const auto& one) {
                              return std::string_view(one.first);
                          }) != row->defaults.end();
        if (!row->required && !value.empty() && !(told && !kind_.empty()))
            row->defaults.emplace_back(kind_, std::move(value));
        return *row;
    }

    std::string path_below(std::string_view key) const {
        const std::string& path = sections[current_].path;
        return path.empty() ? std::string(key) : path + "." + std::string(key);
    }

    std::size_t index_of(const std::string& path, const std::string& form) {
        for (std::size_t i = 0; i < sections.size(); ++i) {
            if (sections[i].path == path && sections[i].form == form) return i;
        }
        sections.push_back({.path = path, .form = form, .keys = {}, .checks = {}});
        return sections.size() - 1;
    }

    template <class T>
    void enter(const std::string& path, T& value) {
        const std::size_t above = current_;
        current_ = index_of(path, "");
        describe(*this, value);
        current_ = above;
    }

    std::size_t current_ = 0;  ///< index in `sections`
    SonarKeyTable sonars_;
    std::string kind_;      ///< kind of the visited sonar
    std::string last_key_;  ///< last visited key
};

}  // namespace

std::vector<SectionReference> mission_reference(SonarKeyTable sonars) {
    KeyCollector collector(sonars);
    Mission mission;
    describe(collector, mission);
    // A section with several forms lists its keys by form.
    std::erase_if(collector.sections,
                  [](const SectionReference& section) { return section.keys.empty(); });
    return collector.sections;
}

}  // namespace sonarsim
