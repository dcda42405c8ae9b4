#include "export/croissant.h"

#include <array>

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// The short names that the properties of Croissant have in its files.
Json context() {
    Json json = {{"@language", "en"},
                 {"@vocab", "https://schema.org/"},
                 {"sc", "https://schema.org/"},
                 {"cr", "http://mlcommons.org/croissant/"},
                 {"dct", "http://purl.org/dc/terms/"},
                 {"conformsTo", "dct:conformsTo"},
                 {"data", {{"@id", "cr:data"}, {"@type", "@json"}}},
                 {"dataType", {{"@id", "cr:dataType"}, {"@type", "@vocab"}}}};
    for (const char* name : {"extract", "field", "fileObject", "fileSet", "includes", "jsonPath",
                             "key", "recordSet", "repeated", "source"})
        json[name] = std::string("cr:") + name;
    return json;
}

Json reference(const std::string& id) {
    return {{"@id", id}};
}

/// The lines of metadata.jsonl of a part as records.
Json record_set(const std::string& part) {
    struct Column {
        const char* name;
        const char* type;
        const char* path;  ///< JSONPath in a line
        bool repeated;
    };
    constexpr std::array columns{
        Column{"file_name", "sc:Text", "$.file_name", false},
        Column{"width", "sc:Integer", "$.width", false},
        Column{"height", "sc:Integer", "$.height", false},
        Column{"bbox", "cr:BoundingBox", "$.objects.bbox[*]", true},
        Column{"area", "sc:Integer", "$.objects.area[*]", true},
        Column{"categories", "sc:Integer", "$.objects.categories[*]", true}};
    Json fields = Json::array();
    for (const Column& column : columns) {
        Json field = {{"@type", "cr:Field"},
                      {"@id", part + "/" + column.name},
                      {"name", column.name},
                      {"dataType", column.type},
                      {"source",
                       {{"fileObject", reference("metadata-" + part)},
                        {"extract", {{"jsonPath", column.path}}}}}};
        if (column.repeated) field["repeated"] = true;
        fields.push_back(std::move(field));
    }
    return {{"@type", "cr:RecordSet"},
            {"@id", part},
            {"name", part},
            {"key", reference(part + "/file_name")},
            {"field", fields}};
}

Json class_set(const std::vector<std::string>& classes) {
    Json data = Json::array();
    for (std::size_t k = 0; k < classes.size(); ++k)
        data.push_back({{"classes/number", k}, {"classes/name", classes[k]}});
    return {{"@type", "cr:RecordSet"},
            {"@id", "classes"},
            {"name", "classes"},
            {"dataType", "sc:Enumeration"},
            {"key", reference("classes/number")},
            {"field",
             {{{"@type", "cr:Field"},
               {"@id", "classes/number"},
               {"name", "number"},
               {"dataType", "sc:Integer"}},
              {{"@type", "cr:Field"},
               {"@id", "classes/name"},
               {"name", "name"},
               {"dataType", "sc:Text"}}}},
            {"data", data}};
}

}  // namespace

nlohmann::ordered_json croissant_json(const CroissantInput& input) {
    Json json = {{"@context", context()},
                 {"@type", "sc:Dataset"},
                 {"conformsTo", "http://mlcommons.org/croissant/1.0"},
                 {"name", input.name},
                 {"description", input.description},
                 {"license", input.licence}};
    json["distribution"] = Json::array();
    json["recordSet"] = Json::array({class_set(input.classes)});
    for (const auto& [part, sum] : input.parts) {
        json["distribution"].push_back({{"@type", "cr:FileObject"},
                                        {"@id", "metadata-" + part},
                                        {"name", "metadata-" + part},
                                        {"contentUrl", part + "/metadata.jsonl"},
                                        {"encodingFormat", "application/jsonlines"},
                                        {"sha256", sum}});
        json["distribution"].push_back({{"@type", "cr:FileSet"},
                                        {"@id", "pictures-" + part},
                                        {"name", "pictures-" + part},
                                        {"encodingFormat", "image/png"},
                                        {"includes", part + "/*.png"}});
        json["recordSet"].push_back(record_set(part));
    }
    return json;
}

}  // namespace sonarsim
