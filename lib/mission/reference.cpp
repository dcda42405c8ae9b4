#include "mission/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "mission/json_schema.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

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

/// A default as it stands in YAML.
std::string yaml_text(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return number_text(value.get<double>());
    if (!value.is_array() || value.empty()) return value.dump();
    std::string list;
    for (const Json& item : value)
        list += (list.empty() ? "[" : ", ") +
                (item.is_string() ? item.get<std::string>() : number_text(item.get<double>()));
    return list + "]";
}

std::string default_of(const Json& key, const std::string& type) {
    if (const auto value = key.find("default"); value != key.end()) {
        const bool is_whole = type == "whole number" || !value->is_number();
        return is_whole ? yaml_text(*value) : number_text(value->get<double>());
    }
    if (type == "text per name") return "{}";
    return type == "list of texts" || type == "list of sections" ? "[]" : "";
}

/// The schemas that the value of a key may have, without the keys of sections.
std::vector<const Json*> value_schemas(const Json& key) {
    std::vector<const Json*> found{&key};
    for (std::size_t i = 0; i < found.size(); ++i) {
        for (const char* const inner : {"anyOf", "items"}) {
            const auto child = found[i]->find(inner);
            if (child == found[i]->end()) continue;
            if (child->is_object()) found.push_back(&*child);
            for (const Json& one : *child) {
                if (child->is_array()) found.push_back(&one);
            }
        }
    }
    return found;
}

void add_values(const Json& key, KeyReference& row) {
    const auto add_choice = [&](const std::string& name) {
        if (std::ranges::find(row.choices, name) == row.choices.end()) row.choices.push_back(name);
    };
    for (const Json* schema : value_schemas(key)) {
        if (schema->contains("const")) add_choice((*schema)["const"].get<std::string>());
        for (const Json& name : schema->value("enum", Json::array()))
            add_choice(name.is_string() ? name.get<std::string>() : name.dump());
        // A list that has no default has no range in the tables.
        if (!schema->contains("maximum") || row.limits) continue;
        if (key.contains("items") && !key.contains("default") && !row.required) continue;
        const bool low_allowed = schema->contains("minimum");
        // The largest double that is a 64-bit number.
        const double largest = std::nextafter(std::ldexp(1.0, 64), 0.0);
        row.limits = Limits{(*schema)[low_allowed ? "minimum" : "exclusiveMinimum"].get<double>(),
                            std::min((*schema)["maximum"].get<double>(), largest), low_allowed};
    }
}

/// Collects the keys of every section of the schema. It visits a sonar once for each kind and model
/// and a trajectory once for each form.
class KeyCollector {
  public:
    std::vector<SectionReference> sections;

    /// `section` is an object of the schema.
    void visit(const Json& section, const std::string& path) {
        const std::size_t index = index_of(path, section.value(schema_note_form, ""));
        const auto required = section.value("required", std::vector<std::string>{});
        for (const auto& [key, value] : section["properties"].items()) {
            add(index, key, value, std::ranges::find(required, key) != required.end());
            visit_below(value, path.empty() ? key : path + "." + key);
        }
        std::vector<std::string>& checks = sections[index].checks;
        for (const std::string& check : section.value("$comment", std::vector<std::string>{})) {
            if (std::ranges::find(checks, check) == checks.end()) checks.push_back(check);
        }
    }

  private:
    void visit_below(const Json& value, const std::string& path) {
        if (value.contains("properties")) visit(value, path);
        if (value.contains("items") && value["items"].contains("properties"))
            visit(value["items"], path + ".0");
        // The forms of an object's trajectory are those of the vehicle's.
        if (value.contains("oneOf") && path == "trajectory") {
            for (const Json& form : value["oneOf"])
                visit(form, path);
        }
        if (path != "sensors") return;
        for (const Json& rule : value["additionalProperties"]["allOf"]) {
            kind_ = rule["if"]["properties"]["kind"]["const"].get<std::string>();
            visit(rule["then"], path + ".NAME");
        }
        kind_.clear();
    }

    /// Adds a key to a section. Defaults of kinds that were visited before are kept.
    void add(std::size_t section, const std::string& name, const Json& value, bool is_required) {
        std::vector<KeyReference>& keys = sections[section].keys;
        const auto type = value[schema_note_type].get<std::string>();
        auto row = std::ranges::find(keys, name, &KeyReference::name);
        if (row == keys.end()) {
            // A key that only a later kind of sonar has is inserted in the order of that kind.
            const auto before = std::ranges::find(keys, last_key_, &KeyReference::name);
            row = keys.insert(before == keys.end() ? before : std::next(before),
                              {.name = name,
                               .type = type,
                               .unit = unit_of(name),
                               .required = is_required,
                               .defaults = {},
                               .limits = {},
                               .choices = {},
                               .meaning = value["description"].get<std::string>()});
        }
        last_key_ = name;
        add_values(value, *row);
        // Both models of a kind have the same defaults.
        const bool is_known = !kind_.empty() && std::ranges::any_of(row->defaults, [&](auto& one) {
            return one.first == kind_;
        });
        const std::string text = default_of(value, type);
        if (!row->required && !text.empty() && !is_known) row->defaults.emplace_back(kind_, text);
    }

    std::size_t index_of(const std::string& path, const std::string& form) {
        const auto found = std::ranges::find_if(sections, [&](const SectionReference& section) {
            return section.path == path && section.form == form;
        });
        if (found != sections.end()) return static_cast<std::size_t>(found - sections.begin());
        sections.push_back({.path = path, .form = form, .keys = {}, .checks = {}});
        return sections.size() - 1;
    }

    std::string kind_;      ///< kind of the visited sonar
    std::string last_key_;  ///< last visited key
};

}  // namespace

std::vector<SectionReference> mission_reference(SonarKeyTable sonars) {
    KeyCollector collector;
    collector.visit(noted_json_schema(sonars), "");
    // A section with several forms lists its keys by form.
    std::erase_if(collector.sections,
                  [](const SectionReference& section) { return section.keys.empty(); });
    return collector.sections;
}

}  // namespace sonarsim
