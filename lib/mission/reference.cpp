#include "mission/reference.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

namespace sonarsim {

namespace {

std::string unit_of(std::string_view key) {
    using Unit = std::pair<std::string_view, const char*>;
    // Longer endings first: a speed ends in _m_s and a length in _m.
    constexpr std::array units{Unit{"_kg_m3", "kg/m^3"}, Unit{"_db", "dB"},   Unit{"_rad", "rad"},
                               Unit{"_c", "Celsius"},    Unit{"_psu", "psu"}, Unit{"_m_s", "m/s"},
                               Unit{"_deg", "deg"},      Unit{"_hz", "Hz"},   Unit{"_mb", "MB"},
                               Unit{"_px", "pixels"},    Unit{"_m", "m"},     Unit{"_s", "s"},
                               Unit{"_w", "W"}};
    for (const auto& [ending, unit] : units) {
        if (key.ends_with(ending)) return unit;
    }
    return "";
}

}  // namespace

SectionReference& KeyTables::section(const std::string& path, const std::string& form) {
    const auto found = std::ranges::find_if(sections, [&](const SectionReference& one) {
        return one.path == path && one.form == form;
    });
    if (found != sections.end()) return *found;
    return sections.emplace_back(SectionReference{path, form, {}, {}});
}

void KeyTables::add(const std::string& path, const std::string& form, const std::string& kind,
                    KeyReference key, const std::string& default_text) {
    std::vector<KeyReference>& keys = section(path, form).keys;
    auto row = std::ranges::find(keys, key.name, &KeyReference::name);
    if (row == keys.end()) {
        // A key that only a later kind of sonar has is inserted in the order of that kind.
        const auto before = std::ranges::find(keys, last_key_, &KeyReference::name);
        key.unit = unit_of(key.name);
        row = keys.insert(before == keys.end() ? before : std::next(before), std::move(key));
    } else {
        for (const std::string& choice : key.choices) {
            if (std::ranges::find(row->choices, choice) == row->choices.end())
                row->choices.push_back(choice);
        }
    }
    last_key_ = row->name;
    // Both models of a kind have the same defaults.
    const auto is_of_kind = [&](const auto& one) { return one.first == kind; };
    if (!row->required && !default_text.empty() && std::ranges::none_of(row->defaults, is_of_kind))
        row->defaults.emplace_back(kind, default_text);
}

void KeyTables::add_check(const std::string& path, const std::string& form,
                          const std::string& check) {
    std::vector<std::string>& checks = section(path, form).checks;
    if (std::ranges::find(checks, check) == checks.end()) checks.push_back(check);
}

}  // namespace sonarsim
