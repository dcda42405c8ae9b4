#include "input/mission/reference.h"

#include "mission/fixtures.h"

TEST_CASE("every key has a meaning, and a default unless it is required or free text") {
    for (const SectionReference& section : mission_reference(sonar_keys())) {
        for (const KeyReference& key : section.keys) {
            CAPTURE_ALL(section.path, key.name);
            CHECK(!key.meaning.empty());
            // Sections that vary, seabeds, rules and targets need only one of several keys.
            const bool free = key.type == "text" || key.type == "path" || key.type == "section" ||
                              section.path == "vary.0" || key.name == "size_m" ||
                              key.name.starts_with("area_m") || key.name == "files" ||
                              key.name.starts_with("target_");
            CHECK((key.required || free || !key.defaults.empty()));
        }
    }
}

TEST_CASE("defaults of the reference are what a mission without these keys has") {
    for (const std::string kind : {"imaging", "profiling", "sidescan", "echosounder", "scanning"}) {
        CAPTURE(kind);
        std::vector<std::string> settings{"output.folder=/o", "sensors.fls.kind=" + kind};
        const Mission mission = parse(smallest_mission, settings);
        for (const SectionReference& section : mission_reference(sonar_keys())) {
            // The smallest mission has no optional sections and no keys of the calibrated model.
            if (section.path.starts_with("trajectory") || section.path.ends_with(".0") ||
                section.path == "scene.water_surface" || section.path == "scene.heightmap" ||
                section.path == "scene.clutter" || section.path.starts_with("scene.seabed") ||
                section.path.ends_with("_map") || section.path.ends_with("profile") ||
                section.path.starts_with("sensors.NAME.instrument"))
                continue;
            std::string path = section.path.empty() ? "" : section.path + ".";
            if (path.starts_with("sensors.NAME")) path.replace(8, 4, "fls");
            for (const KeyReference& key : section.keys) {
                for (const auto& [default_kind, value] : key.defaults) {
                    if (default_kind.empty() || default_kind == kind)
                        settings.push_back(path + key.name + "=" + value);
                }
            }
        }
        CHECK(settings.size() > 40);
        CHECK(yaml_of(parse(smallest_mission, settings)) == yaml_of(mission));
    }
}
