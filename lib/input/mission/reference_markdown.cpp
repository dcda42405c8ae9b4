#include <algorithm>
#include <utility>

#include "core/text.h"
#include "input/mission/reference.h"

namespace sonarsim {

namespace {

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
