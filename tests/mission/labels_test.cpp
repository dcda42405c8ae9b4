#include "mission/fixtures.h"
#include "mission/resolved.h"
#include "sonar/kinds.h"

namespace sonarsim {

TEST_SUITE_BEGIN("mission");

TEST_CASE("labels: all, none or a list, in one order") {
    CHECK(parse(smallest_mission).output.labels.empty());
    CHECK(parse(smallest_mission + "output: {labels: false}\n").output.labels.empty());
    CHECK(parse(smallest_mission + "output: {labels: true}\n").output.labels.size() == 14);
    const Mission mission = parse(smallest_mission + "output: {labels: [shadow, instance]}\n");
    CHECK(mission.output.labels == std::vector<Label>{Label::instance, Label::shadow});
    CHECK(reads_back(mission));

    CHECK(refusal(smallest_mission + "output: {labels: maybe}\n")
              .starts_with("m.yaml:6:18: 'labels' must be true, false or a list of: instance"));
    CHECK(refusal(smallest_mission + "output: {labels: [shadows]}\n")
              .starts_with("m.yaml:6:19: unknown labels 'shadows' (did you mean 'shadow'?)"));
    CHECK(refusal(smallest_mission + "output: {labels: [clean, clean]}\n") ==
          "m.yaml:6:26: 'clean' stands twice in 'labels'");
}

TEST_CASE("keys and labels that are gone say what to do instead") {
    CHECK(refusal(smallest_mission + "output: {split: {train: 0.8, val: 0.2}}\n") ==
          "m.yaml:6:10: 'split' is no longer there; give the shares to the export: sonarsim export "
          "--split");
    CHECK(refusal(smallest_mission + "water: {assumed_profile: {named: summer}}\n") ==
          "m.yaml:6:9: 'assumed_profile' is no longer there; soundings use water.profile; leave it "
          "out");
    CHECK(
        refusal(smallest_mission + "slices: {per_beam: 2}\n") ==
        "m.yaml:6:1: 'slices' is no longer there; leave it out: the number of slices follows from "
        "accuracy.relative_l1");
    CHECK(refusal(smallest_mission + "vehicle: {motion: {lag_s: 2}}\n")
              .starts_with("m.yaml:6:20: 'lag_s' is no longer there"));
    CHECK(refusal(smallest_mission + "vehicle: {navigation: {speed_scale: 0.1}}\n")
              .starts_with("m.yaml:6:24: 'speed_scale' is no longer there"));
    CHECK(
        refusal(smallest_mission + "output: {labels: [instance, coco]}\n") ==
        "m.yaml:6:29: 'coco' is no longer there; write labels: [objects], then run sonarsim export "
        "--format coco");
}

TEST_CASE("classes: rules in the order of the file, and where they stand") {
    const Mission mission = parse(smallest_mission +
                                  "classes:\n  - {nodes: 'ship_*', class: ship, instance: s1}\n"
                                  "  - {nodes: '*', class: other}\n");
    REQUIRE(mission.classes.size() == 2);
    CHECK(mission.classes[0].instance == "s1");
    CHECK(mission.classes[1].nodes == "*");
    CHECK(mission.classes[1].place.text() == "m.yaml:8:5");
    CHECK(reads_back(mission));

    CHECK(refusal(smallest_mission + "classes:\n  - {nodes: a}\n") ==
          "m.yaml:7:5: a rule for classes needs the keys 'nodes' and 'class'");
    CHECK(refusal(smallest_mission + "classes: {}\n").find("'classes' must be a list") !=
          std::string::npos);
}

TEST_SUITE_END();

}  // namespace sonarsim
