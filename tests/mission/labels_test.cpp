#include "mission/fixtures.h"
#include "mission/resolved.h"
#include "sonar/kinds.h"

namespace sonarsim {

TEST_SUITE_BEGIN("mission");

TEST_CASE("labels: all, none or a list, in one order") {
    CHECK(parse(smallest_mission).output.labels.empty());
    CHECK(parse(smallest_mission + "output: {labels: false}\n").output.labels.empty());
    CHECK(parse(smallest_mission + "output: {labels: true}\n").output.labels.size() == 18);
    const Mission mission = parse(smallest_mission + "output: {labels: [shadow, instance]}\n");
    CHECK(mission.output.labels == std::vector<Label>{Label::instance, Label::shadow});
    CHECK(parse(resolved_yaml(mission, sonar_keys())) == mission);

    CHECK(refusal(smallest_mission + "output: {labels: maybe}\n")
              .starts_with("m.yaml:6:18: 'labels' must be true, false or a list of: instance"));
    CHECK(refusal(smallest_mission + "output: {labels: [shadows]}\n")
              .starts_with("m.yaml:6:19: unknown labels 'shadows' (did you mean 'shadow'?)"));
    CHECK(refusal(smallest_mission + "output: {labels: [clean, clean]}\n") ==
          "m.yaml:6:26: 'clean' stands twice in 'labels'");
}

TEST_CASE("split: shares that add up to 1, or none") {
    CHECK_FALSE(parse(smallest_mission).output.split.is_on());
    const Mission mission =
        parse(smallest_mission + "output: {split: {train: 0.8, val: 0.1, test: 0.1, gap: 4}}\n");
    CHECK(mission.output.split.is_on());
    CHECK(mission.output.split.gap == 4);
    CHECK(mission.output.split.place.location.text() == "m.yaml:6:17");
    CHECK(parse(resolved_yaml(mission, sonar_keys())) == mission);
    CHECK(
        refusal(smallest_mission + "output: {split: {train: 0.8, val: 0.1}}\n") ==
        "m.yaml:6:35: train, val and test must add up to 1 (train is 0.8, val is 0.1, test is 0)");
}

TEST_CASE("classes: rules in the order of the file, and where they stand") {
    const Mission mission = parse(smallest_mission +
                                  "classes:\n  - {nodes: 'ship_*', class: ship, instance: s1}\n"
                                  "  - {nodes: '*', class: other}\n");
    REQUIRE(mission.classes.size() == 2);
    CHECK(mission.classes[0].instance == "s1");
    CHECK(mission.classes[1].nodes == "*");
    CHECK(mission.classes[1].place.location.text() == "m.yaml:8:5");
    CHECK(parse(resolved_yaml(mission, sonar_keys())) == mission);

    CHECK(refusal(smallest_mission + "classes:\n  - {nodes: a}\n") ==
          "m.yaml:7:5: a rule for classes needs the keys 'nodes' and 'class'");
    CHECK(refusal(smallest_mission + "classes: {}\n").find("'classes' must be a list") !=
          std::string::npos);
}

TEST_SUITE_END();

}  // namespace sonarsim
