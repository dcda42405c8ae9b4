#include "input/scene/objects.h"

#include "support/test.h"

TEST_CASE("objects: patterns") {
    CHECK(fits_pattern("*", ""));
    CHECK(fits_pattern("*ip_*", "ship_mast"));
    CHECK(fits_pattern("a*b*c", "aXbYbZc"));
    CHECK((fits_pattern("rock?", "rock1") && !fits_pattern("rock?", "rock")));
    CHECK_FALSE(fits_pattern("ship", "ship_mast"));
    CHECK_FALSE(fits_pattern("a*b", "abc"));
}

TEST_CASE("objects: nodes by themselves, classes of the file, groups of the mission") {
    Scene scene;
    scene.instances = {"floor", "ship_hull", "rock", "ship_mast"};
    scene.instance_classes = {"", "", "stone", ""};
    SceneObjects objects = group_objects(scene, {});
    CHECK(objects.classes == std::vector<std::string>{"floor", "ship_hull", "stone", "ship_mast"});

    const std::vector<ClassConfig> rules{{"ship_*", "", "ship", "ship_1", {}},
                                         {"*", "", "other", "", {}}};
    objects = group_objects(scene, rules);
    CHECK(objects.object_of_instance == std::vector<std::uint32_t>{0, 1, 2, 1});
    CHECK(objects.objects[1].name == "ship_1");
    CHECK(objects.classes == std::vector<std::string>{"other", "ship"});
    CHECK((objects.class_of(1) == 1 && objects.class_of(2) == 0));
}

TEST_CASE("objects: copies of a node are of one class") {
    Scene scene;
    scene.instances = {"Mine", "Mine.001", "Mine.1000", "v1.2", "Rock.01", ".001", "Mine.003"};
    scene.instance_classes = {"", "", "", "", "", "", "threat.004"};
    const SceneObjects objects = group_objects(scene, {});
    CHECK(objects.objects.size() == 7);
    CHECK(objects.objects[1].name == "Mine.001");
    CHECK(objects.classes ==
          std::vector<std::string>{"Mine", "v1.2", "Rock.01", ".001", "threat.004"});
    CHECK(objects.class_of(2) == 0);
    // A name that a rule gives is kept.
    const std::vector<ClassConfig> rules{{"Mine.*", "", "Mine.001", "", {}}};
    CHECK(group_objects(scene, rules).classes[1] == "Mine.001");
}

TEST_CASE("objects: rules that cannot be meant") {
    Scene scene;
    scene.instances = {"floor", "ship_hull", "ship_mast"};
    const Location place{"m.yaml", 7, 3};
    const std::pair<std::vector<ClassConfig>, std::string> faulty[] = {
        {{{"boat*", "", "boat", "", place}}, "no node of the scene fits 'boat*'"},
        {{{"", "Glas", "pane", "", place}}, "no material of the scene fits 'Glas'"},
        {{{"*", "", "thing", "", {}}, {"floor", "", "bottom", "", place}},
         "no node of the scene is left for 'floor'"},
        {{{"ship_hull", "", "ship", "ship_1", {}}, {"ship_mast", "", "mast", "ship_1", place}},
         "the instance 'ship_1' has the class 'mast' here and 'ship'"},
        {{{"ship_*", "", "ship", "floor", place}}, "the instance 'floor' has the name of a node"}};
    for (const auto& rules : faulty)
        CHECK_THROWS_WITH_AS(group_objects(scene, rules.first),
                             doctest::Contains(("m.yaml:7:3: " + rules.second).c_str()),
                             InputError);
}
