#include "scene/summary.h"

#include <doctest/doctest.h>

#include "scene/gltf_builder.h"

using namespace sonarsim;

TEST_SUITE("scene") {
    TEST_CASE("summary: bounds, areas, materials, instances and what was dropped") {
        GltfBuilder gltf = one_triangle();
        // A second, rubber triangle of 3 x 4 m, and a primitive of points.
        gltf.node({{"name", "large tri"},
                   {"mesh", 0},
                   {"scale", {3, 4, 1}},
                   {"extras", {{"sonar", {{"material", "rubber"}}}}}});
        gltf.document["meshes"][0]["primitives"].push_back(
            {{"attributes", nlohmann::json::object()}, {"mode", 0}});
        CHECK(describe_scene(load(gltf)) ==
              "bounds     (0.000, 0.000, 0.000) to (3.000, 0.000, 4.000) m\n"
              "size       (3.000, 0.000, 4.000) m\n"
              "origin     (0.000, 0.000, 0.000) m\n"
              "triangles  2 with 6 vertices, 6.500 m^2\n"
              "dropped    0 triangles without area, 0 that are not finite, 2 primitives of points "
              "or lines\n"
              "\n"
              "material   triangles     area m^2\n"
              "steel              1        0.500\n"
              "rubber             1        6.000\n"
              "\n"
              "instance    triangles     area m^2\n"
              "tri                 1        0.500\n"
              "large tri           1        6.000\n");
    }

    TEST_CASE("summary: an empty scene") {
        CHECK(describe_scene(Scene{}).find("triangles  0 with 0 vertices, 0.000 m^2\n") !=
              std::string::npos);
    }
}
