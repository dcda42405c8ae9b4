#include "input/mission/reference.h"

#include <initializer_list>
#include <iterator>
#include <variant>

#include "core/text.h"
#include "input/mission/mission.h"
#include "input/mission/value_types.h"

namespace sonarsim {

namespace {

std::string unit_of(std::string_view key) {
    using Unit = std::pair<std::string_view, const char*>;
    // Longer endings first: a speed ends in _m_s and a length in _m.
    constexpr Unit units[] = {{"_kg_m3", "kg/m^3"}, {"_db", "dB"},   {"_rad", "rad"},
                              {"_c", "Celsius"},    {"_psu", "psu"}, {"_m_s", "m/s"},
                              {"_deg", "deg"},      {"_hz", "Hz"},   {"_mb", "MB"},
                              {"_px", "pixels"},    {"_m", "m"},     {"_s", "s"},
                              {"_w", "W"}};
    for (const auto& [ending, unit] : units) {
        if (key.ends_with(ending)) return unit;
    }
    return "";
}

/// Adds the values that are not in `all`.
void add_new(const std::vector<std::string>& values, std::vector<std::string>& all) {
    for (const std::string& value : values) {
        if (!contains(all, value)) all.push_back(value);
    }
}

/// The visitor that lists the keys of a section and of those below it. A sonar is visited once for
/// each kind and model, a trajectory once for each form.
class ReferenceBuilder : public KeyVisitor<ReferenceBuilder> {
  public:
    ReferenceBuilder(SonarKeyTable sonars, std::vector<SectionReference>& sections)
        : sonars_(sonars), sections_(sections) {}

    void value(const char* key, const auto& value, const auto& type, const char* meaning,
               Presence presence) {
        const TypeNote note = type.note(value);
        const std::string yaml = type.yaml(value);
        add(key, note, meaning, presence == required, yaml.empty() ? note.empty : yaml);
    }

    void section(const char* key, auto& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add(key, {"section"}, meaning, presence == required);
        below(key).visit(value);
    }
    template <class... T>
    void section(const char* key, std::variant<T...>& value, const char* meaning,
                 Presence presence = Presence::optional) {
        add(key, {"section"}, meaning, presence == required);
        if (!path_.empty()) return;
        ((value.template emplace<T>(), below(key).visit(value)), ...);
    }
    template <class T>
    void section(const char* key, std::optional<T>&, const char* meaning) {
        T value;
        section(key, value, meaning);
    }

    template <class T>
    void list_of(const char* key, std::vector<T>&, std::size_t fewest, const char* meaning) {
        const bool needed = fewest > 0;
        add(key, {needed ? "list of " + std::to_string(fewest) + " or more" : "list of sections"},
            meaning, needed, "[]");
        T item;
        below(key + std::string(".0")).visit(item);
    }

    void named(const char* key, std::vector<SonarConfig>&, const char* meaning) {
        add(key, {"section per name"}, meaning, true);
        for (const SonarKeys& kind : sonars_) {
            for (const Choice<ModelKind>& model : echo_models) {
                SonarConfig sonar = kind.defaults;
                sonar.model = model.value;
                ReferenceBuilder builder = below(key + std::string(".NAME"));
                builder.kind_ = kind.name;
                builder.sonar_ = builder.kind_ + ", " + model.name;
                builder.visit(sonar);
            }
        }
    }

    /// Each form requires a key of its own.
    void one_of(const TrajectoryConfig& value, std::initializer_list<const char*> keys) {
        form_ = keys.begin()[value.index()];
    }

    const SonarKeys& one_of(const char* key, const SonarConfig& value, const char* meaning) {
        const auto keys = std::ranges::find(sonars_, value.kind, &SonarKeys::kind);
        add(key, {"choice", {}, {std::string(keys->name)}}, meaning, true);
        return *keys;
    }

    void require(bool, std::initializer_list<const char*>, const char* message) {
        add_new({message}, here().checks);
    }

    void visit(auto& value) { describe(*this, value); }

  private:
    ReferenceBuilder below(const std::string& key) const {
        ReferenceBuilder builder = *this;
        builder.path_ = path_.empty() ? key : path_ + "." + key;
        builder.form_.clear();
        builder.last_key_.clear();
        return builder;
    }

    SectionReference& here() {
        const auto found = std::ranges::find_if(sections_, [&](const SectionReference& one) {
            return one.path == path_ && one.form == form_;
        });
        if (found != sections_.end()) return *found;
        return sections_.emplace_back(SectionReference{path_, form_, {}, {}});
    }

    void add(const char* name, const TypeNote& note, const char* meaning, bool needed,
             const std::string& default_text = "") {
        std::vector<KeyReference>& keys = here().keys;
        auto row = std::ranges::find(keys, name, &KeyReference::name);
        if (row == keys.end()) {
            // A key that only a later kind of sonar has is inserted in the order of that kind.
            const auto before = std::ranges::find(keys, last_key_, &KeyReference::name);
            row = keys.insert(before == keys.end() ? before : std::next(before),
                              KeyReference{.name = name,
                                           .type = note.name,
                                           .unit = unit_of(name),
                                           .required = needed,
                                           .limits = note.limits,
                                           .meaning = meaning});
        }
        add_new(note.choices, row->choices);
        add_new({sonar_}, row->sonars);
        last_key_ = name;
        // Both models of a kind have the same defaults.
        const bool known =
            std::ranges::any_of(row->defaults, [&](const auto& one) { return one.first == kind_; });
        if (!needed && !default_text.empty() && !known)
            row->defaults.emplace_back(kind_, default_text);
    }

    SonarKeyTable sonars_;
    std::vector<SectionReference>& sections_;
    std::string path_, form_, last_key_;
    std::string kind_, sonar_;  ///< the visited sonar
};

/// Writes 1e9 for the 1e+09 of C++.
std::string short_text(double value) {
    std::string text = number_text(value);
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return text;
    std::string exponent = text.substr(e + 1);
    const bool negative = exponent[0] == '-';
    exponent.erase(0, exponent.find_first_of("123456789"));
    return text.substr(0, e + 1) + (negative ? "-" : "") + exponent;
}

/// "number, 0 to 1" or "`y`, `z`".
std::string value_text(const KeyReference& key) {
    std::string text = key.type == "choice" ? "" : key.type;
    if (key.limits) {
        const Limits& limits = *key.limits;
        text += (limits.low_allowed ? ", " : ", above ") + short_text(limits.low) + " to ";
        text += limits.high > 1e18 ? "2^64 - 1" : short_text(limits.high);
    }
    for (const std::string& choice : key.choices)
        text += (text.empty() ? "`" : ", `") + choice + "`";
    return text;
}

/// "120 (imaging, profiling), 170 (sidescan)", or one value if all kinds have it.
std::string default_text(const KeyReference& key, std::size_t kinds) {
    if (key.required) return "required";
    if (key.defaults.empty()) return "";
    std::vector<std::pair<std::string, std::string>> kinds_by_value;
    for (const auto& [kind, value] : key.defaults) {
        const auto same =
            std::ranges::find(kinds_by_value, value, &std::pair<std::string, std::string>::first);
        if (same == kinds_by_value.end()) {
            kinds_by_value.emplace_back(value, kind);
        } else {
            same->second += ", " + kind;
        }
    }
    const bool for_all = key.defaults.size() == kinds || key.defaults[0].first.empty();
    const bool bare = for_all && kinds_by_value.size() == 1;
    std::string text;
    for (const auto& [value, names] : kinds_by_value) {
        text += (text.empty() ? "" : ", ") + value + (bare ? "" : " (" + names + ")");
    }
    return text;
}

std::string title(const SectionReference& section) {
    if (section.path.empty()) return "The mission";
    return "`" + section.path + "`" + (section.form.empty() ? "" : " with `" + section.form + "`");
}

}  // namespace

std::vector<SectionReference> mission_reference(SonarKeyTable sonars) {
    std::vector<SectionReference> sections;
    Mission mission;
    ReferenceBuilder(sonars, sections).visit(mission);
    return sections;
}

std::string reference_markdown(const std::vector<SectionReference>& sections) {
    std::size_t kinds = 0;
    for (const SectionReference& section : sections) {
        for (const KeyReference& key : section.keys)
            kinds = std::max(kinds, key.defaults.size());
    }
    std::string text;
    for (const SectionReference& section : sections) {
        text += (text.empty() ? "### " : "\n### ") + title(section) + "\n\n";
        text += "| key | value | default | meaning |\n|---|---|---|---|\n";
        for (const KeyReference& key : section.keys) {
            text += "| `" + key.name + "` | " + value_text(key) + " | ";
            text += default_text(key, kinds) + " | " + key.meaning + " |\n";
        }
        if (!section.checks.empty()) text += "\n";
        for (const std::string& check : section.checks)
            text += "- " + check + "\n";
    }
    return text;
}

}  // namespace sonarsim
