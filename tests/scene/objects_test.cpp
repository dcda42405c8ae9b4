#include "scene/objects.h"

#include <doctest/doctest.h>

using namespace sonarsim;

namespace {

Scene named_objects(std::vector<std::string> names) {
    Scene scene;
    scene.instances = std::move(names);
    return scene;
}

std::string refusal_of_rules(const Scene& scene, const std::vector<ClassRule>& rules) {
    try {
        group_objects(scene, rules);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_SUITE_BEGIN("scene");

TEST_CASE("objects: patterns") {
    CHECK(fits_pattern("*", ""));
    CHECK(fits_pattern("ship_*", "ship_mast"));
    CHECK(fits_pattern("*mast*", "ship_mast_2"));
    CHECK(fits_pattern("a*b*c", "aXbYbZc"));
    CHECK(fits_pattern("rock?", "rock1"));
    CHECK_FALSE(fits_pattern("rock?", "rock"));
    CHECK_FALSE(fits_pattern("ship", "ship_mast"));
    CHECK_FALSE(fits_pattern("a*b", "abc"));
}

TEST_CASE("objects: nodes by themselves, classes of the file, groups of the mission") {
    Scene scene = named_objects({"floor", "ship_hull", "rock", "ship_mast"});
    scene.instance_classes = {"", "", "stone", ""};
    SceneObjects objects = group_objects(scene, {});
    CHECK(objects.objects.size() == 4);
    CHECK(objects.classes == std::vector<std::string>{"floor", "ship_hull", "stone", "ship_mast"});

    const std::vector<ClassRule> rules{{"ship_*", "ship", "ship_1", {}}, {"*", "other", "", {}}};
    objects = group_objects(scene, rules);
    CHECK(objects.object_of_instance == std::vector<std::uint32_t>{0, 1, 2, 1});
    CHECK(objects.objects[1].name == "ship_1");
    CHECK(objects.classes == std::vector<std::string>{"other", "ship"});
    CHECK(objects.class_of(1) == 1);
    CHECK(objects.class_of(2) == 0);
}

TEST_CASE("objects: rules that cannot be meant") {
    const Scene scene = named_objects({"floor", "ship_hull", "ship_mast"});
    const Location place{"m.yaml", 7, 3};
    CHECK(refusal_of_rules(scene, {{"boat*", "boat", "", place}})
              .starts_with("m.yaml:7:3: no node of the scene fits 'boat*'"));
    CHECK(refusal_of_rules(scene, {{"*", "thing", "", {}}, {"floor", "bottom", "", place}})
              .starts_with("m.yaml:7:3: no node of the scene is left for 'floor'"));
    CHECK(
        refusal_of_rules(
            scene, {{"ship_hull", "ship", "ship_1", {}}, {"ship_mast", "mast", "ship_1", place}})
            .starts_with("m.yaml:7:3: the instance 'ship_1' has the class 'mast' here and 'ship'"));
    CHECK(refusal_of_rules(scene, {{"ship_*", "ship", "floor", place}})
              .starts_with("m.yaml:7:3: the instance 'floor' has the name of a node"));
}

TEST_SUITE_END();
