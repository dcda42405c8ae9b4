#include "mission/json_schema.h"

#include <string>
#include <utility>

#include "mission/schema_builder.h"

namespace sonarsim {

/// The keys of a sonar of this kind and model.
SchemaJson SchemaBuilder::sonar_of(const SonarKeys& kind, const Choice<ModelKind>& model,
                                   const std::string& path) const {
    SonarConfig sonar = kind.defaults;
    sonar.model = model.value;
    SchemaJson json = object_of(sonar, {at_.tables, path, "", std::string(kind.name)});
    json["properties"]["model"]["enum"] = {model.name};
    json["properties"]["model"]["default"] = echo_models[0].name;
    if (model.value != echo_models[0].value) json["required"].push_back("model");
    return json;
}

/// A sonar's keys depend on its kind and model. A preset may give these, so that with a preset
/// all keys of all kinds are allowed.
SchemaJson SchemaBuilder::sonar_json(const std::string& path) const {
    SchemaJson kinds = SchemaJson::array();
    SchemaJson all_keys = SchemaJson::object();
    SchemaJson rules = SchemaJson::array();
    for (const SonarKeys& kind : sonars_) {
        kinds.push_back(kind.name);
        for (const Choice<ModelKind>& model : echo_models) {
            const bool is_default = model.value == echo_models[0].value;
            SchemaJson own = sonar_of(kind, model, path);
            add_missing_keys(own["properties"], all_keys);
            SchemaJson if_this{{"properties", {{"kind", {{"const", kind.name}}}}},
                               {"required", {"kind"}},
                               {"not", {{"required", {"preset"}}}}};
            // The rule of the default model also holds for an unknown model, so that its name
            // is checked.
            SchemaJson others = names_of(echo_models);
            others.erase(0);
            if_this["properties"]["model"] =
                is_default ? SchemaJson{{"not", {{"enum", std::move(others)}}}}
                           : SchemaJson{{"const", model.name}};
            if (!is_default) if_this["required"].push_back("model");
            rules.push_back({{"if", std::move(if_this)}, {"then", std::move(own)}});
        }
    }
    all_keys["kind"] = {{"enum", std::move(kinds)}, {"description", "the kind of sonar"}};
    all_keys["model"] = {{"enum", names_of(echo_models)},
                         {"description", all_keys["model"]["description"]}};
    return {{"type", "object"},
            {"properties", std::move(all_keys)},
            {"additionalProperties", false},
            {"anyOf", {{{"required", {"kind"}}}, {{"required", {"preset"}}}}},
            {"allOf", std::move(rules)}};
}

namespace {

/// Visits all keys of a mission; returns their schema.
SchemaJson visit_mission(SonarKeyTable sonars, KeyTables& tables) {
    SchemaBuilder builder(sonars, {&tables});
    Mission mission;
    describe(builder, mission);
    return builder.finish();
}

}  // namespace

nlohmann::ordered_json mission_json_schema(SonarKeyTable sonars) {
    KeyTables tables;
    SchemaJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                      {"title", "sonarsim mission"},
                      {"description", "A scene, a trajectory and sonars, for sonarsim render."}};
    schema.update(visit_mission(sonars, tables));
    return schema;
}

std::vector<SectionReference> mission_reference(SonarKeyTable sonars) {
    KeyTables tables;
    visit_mission(sonars, tables);
    // A section with several forms lists its keys by form.
    std::erase_if(tables.sections,
                  [](const SectionReference& section) { return section.keys.empty(); });
    return std::move(tables.sections);
}

}  // namespace sonarsim
