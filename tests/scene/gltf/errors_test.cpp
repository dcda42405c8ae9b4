#include <doctest/doctest.h>

#include <string>

#include "scene/gltf/builder.h"

using namespace sonarsim;
using nlohmann::json;

namespace {

/// The error message for the triangle after `bend` has changed its document.
template <class Bend>
std::string error_of(Bend bend) {
    GltfBuilder gltf = one_triangle();
    bend(gltf.document);
    return load_error(gltf);
}

json& primitive(json& document) {
    return document["meshes"][0]["primitives"][0];
}

GltfBuilder chain(int nodes) {
    GltfBuilder gltf = one_triangle();
    for (int i = 1; i < nodes; ++i)
        gltf.node({{"children", {i - 1}}});
    return gltf;
}

}  // namespace

TEST_SUITE("scene") {
    TEST_CASE("glTF errors: materials") {
        GltfBuilder gltf = one_triangle();
        json more = primitive(gltf.document);
        for (const char* name : {"steal", "Material.001", "sand"}) {
            more["material"] = gltf.material(name);
            gltf.document["meshes"][0]["primitives"].push_back(more);
        }
        CHECK(
            load_error(gltf) ==
            "materials.csv: lacks the material 'steal' of 'tri' in x.glb (did you mean "
            "'steel'?); add it to the CSV or give scene.material_default\n"
            "materials.csv: lacks the material 'Material.001' of 'tri' in x.glb; add it to the "
            "CSV or give scene.material_default");
        CHECK(error_of([](json& d) { primitive(d).erase("material"); }) ==
              "x.glb: mesh 'Tri' primitive 0 of node 'tri': has no material; name one in the glTF "
              "material or as extras.sonar.material of the node, or give scene.material_default");
        CHECK(error_of([](json& d) { d["materials"][0].erase("name"); }) ==
              "x.glb: mesh 'Tri' primitive 0 of node 'tri': its material has no name; name one in "
              "the glTF material or as extras.sonar.material of the node, or give "
              "scene.material_default");
        CHECK(error_of([](json& d) { primitive(d)["material"] = 1; }) ==
              "x.glb: mesh 'Tri' primitive 0: material 1 does not exist");
        CHECK(error_of([](json& d) { d["nodes"][0]["extras"]["sonar"] = "steel"; }) ==
              "x.glb: nodes[0].extras.sonar is not an object");
        CHECK(error_of([](json& d) { d["nodes"][0]["extras"]["sonar"]["materail"] = "steel"; }) ==
              "x.glb: nodes[0].extras.sonar: unknown key 'materail' (did you mean 'material'?); "
              "only 'material' and 'class' are read");
        CHECK(error_of([](json& d) { d["materials"][0]["extras"]["sonar"]["material"] = 3; }) ==
              "x.glb: materials[0].extras.sonar.material is not a text of at most 1000 bytes");
    }

    TEST_CASE("glTF errors: accessors that claim too much") {
        const auto accessor = [](json& d) -> json& { return d["accessors"][0]; };
        const auto view = [](json& d) -> json& { return d["bufferViews"][0]; };
        const std::string where = "x.glb: mesh 'Tri' primitive 0: POSITION";
        CHECK(error_of([&](json& d) { accessor(d)["count"] = 6; }) ==
              where + ": claims 6 elements; bufferView 0 is too short for them (36 bytes)");
        CHECK(error_of([&](json& d) { accessor(d)["count"] = 1ULL << 52; }) ==
              where + ": count 4503599627370496 is not between 1 and 268435456");
        CHECK(error_of([&](json& d) { accessor(d)["byteOffset"] = 1ULL << 53; }) ==
              where + ": claims 3 elements; bufferView 0 is too short for them (36 bytes)");
        CHECK(error_of([&](json& d) { view(d)["byteOffset"] = 1ULL << 53; }) ==
              where + ": bufferView 0 reaches beyond the end of its buffer (36 bytes)");
        CHECK(error_of([&](json& d) { view(d)["byteStride"] = 8; }) ==
              where + ": byteStride 8 is less than the size of an element, 12");
        CHECK(error_of([&](json& d) { view(d)["byteStride"] = 1ULL << 63; }) != "");
        CHECK(error_of([&](json& d) { view(d)["buffer"] = 1; }) ==
              where + ": bufferView 0 lies in buffer 1, which does not exist");
        CHECK(error_of([&](json& d) { accessor(d)["bufferView"] = 9; }) ==
              where + ": bufferView 9 does not exist");
        CHECK(error_of([&](json& d) { accessor(d).erase("bufferView"); }) ==
              where + ": has neither a bufferView nor sparse elements");
        CHECK(error_of([&](json& d) { primitive(d)["attributes"]["POSITION"] = 9; }) ==
              where + ": accessor 9 does not exist");
        CHECK(error_of([&](json& d) { primitive(d)["attributes"].erase("POSITION"); }) ==
              "x.glb: mesh 'Tri' primitive 0: has no POSITION");
        CHECK(error_of([&](json& d) { accessor(d)["type"] = "VEC2"; }) ==
              where + ": expected an accessor of type VEC3");
        CHECK(error_of([&](json& d) { accessor(d)["componentType"] = 5125; }) ==
              where + ": positions must be float, or 8- or 16-bit integers");
        CHECK(error_of([&](json& d) { d["meshes"][0].erase("name"), accessor(d)["count"] = 0; }) ==
              "x.glb: mesh 0 primitive 0: POSITION: count 0 is not between 1 and 268435456");
    }

    TEST_CASE("glTF errors: sparse accessors") {
        const auto sparse_error = [](const std::vector<std::uint8_t>& at, int count, auto bend) {
            GltfBuilder gltf = one_triangle();
            const int indices = gltf.view(at);
            const int values = gltf.view(std::vector<Point>{{4, 0, 0}, {0, 5, 0}});
            json& sparse = gltf.document["accessors"][0]["sparse"];
            sparse = {{"count", count},
                      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                      {"values", {{"bufferView", values}}}};
            bend(sparse);
            return load_error(gltf);
        };
        const auto as_it_is = [](json&) {};
        const std::string where = "x.glb: mesh 'Tri' primitive 0: POSITION: ";
        CHECK(sparse_error({0, 2}, 2, as_it_is) == "");
        CHECK(sparse_error({0, 3}, 2, as_it_is) ==
              where + "sparse indices must ascend and stay below 3");
        CHECK(sparse_error({0, 1}, 4, as_it_is) ==
              where + "sparse count 4 is not between 1 and the accessor's 3");
        CHECK(sparse_error({0, 1}, 3, as_it_is) ==
              where +
                  "sparse indices: claims 3 elements; bufferView 1 is too short for them "
                  "(2 bytes)");
        CHECK(sparse_error({0, 1, 2}, 3, as_it_is) ==
              where +
                  "sparse values: claims 3 elements; bufferView 2 is too short for them "
                  "(24 bytes)");
        CHECK(sparse_error({0, 1}, 2, [](json& s) { s["indices"]["componentType"] = 5126; }) ==
              where + "sparse indices must be unsigned integers");
    }

    TEST_CASE("glTF errors: primitives") {
        const auto indexed = [](const std::vector<std::uint16_t>& values, int mode) {
            GltfBuilder gltf = one_triangle();
            const int indices = gltf.indices(values);
            primitive(gltf.document)["indices"] = indices;
            primitive(gltf.document)["mode"] = mode;
            return load_error(gltf);
        };
        const std::string where = "x.glb: mesh 'Tri' primitive 0: ";
        CHECK(indexed({0, 1, 3}, 4) == where + "index 3 is out of range; there are 3 vertices");
        CHECK(indexed({0, 1, 2, 0}, 4) == where + "4 corners do not make whole triangles");
        CHECK(indexed({0, 1, 2}, 7) == where + "mode 7 is not one of glTF's, 0 to 6");
        CHECK(error_of([](json& d) { primitive(d)["indices"] = 0; }) ==
              where + "indices: indices must be unsigned 8-, 16- or 32-bit integers");
        CHECK(error_of([](json& d) { primitive(d)["indices"] = 7; }) ==
              "x.glb: is not a valid glTF: primitive indices accessor out of bounds");
    }

    TEST_CASE("glTF errors: the graph of nodes") {
        CHECK(error_of([](json& d) { d["nodes"][0]["children"] = {0}; }) ==
              "x.glb: node 'tri' is its own ancestor");
        CHECK(error_of([](json& d) {
                  d["nodes"] = {{{"children", {1}}},
                                {{"name", "a"}, {"children", {2}}},
                                {{"name", "b"}, {"children", {1}}}};
              }) == "x.glb: node 'a' has two parents, 'node0' and 'b'");
        CHECK(error_of([](json& d) { d["nodes"][0]["children"] = {5}; }) ==
              "x.glb: node 'tri' has the child node 5, which does not exist");
        CHECK(error_of([](json& d) { d["nodes"][0]["mesh"] = 5; }) ==
              "x.glb: node 'tri' has mesh 5, which does not exist");
        CHECK(error_of([](json& d) {
                  d["scenes"] = {{{"nodes", {3}}}};
              }) == "x.glb: the scene has the root node 3, which does not exist");
        CHECK(error_of([](json& d) {
                  d["scenes"] = {{{"nodes", {0, 0}}}};
              }) == "x.glb: node 'tri' is listed twice in the scene");
        CHECK(error_of([](json& d) { d["scene"] = 0; }) ==
              "x.glb: the default scene is 0, which does not exist");
        CHECK(error_of([](json& d) {
                  d["nodes"].push_back({{"children", {0}}});
                  d["scenes"] = {{{"nodes", {0}}}};
              }) == "x.glb: node 'tri' is a root of the scene, but also a child of 'node1'");
        CHECK(load_error(chain(256)) == "");
        CHECK(load_error(chain(257)) ==
              "x.glb: node 'tri' lies deeper than 256 levels in the hierarchy");
    }

    TEST_CASE("glTF errors: transforms, skins and morphs") {
        const auto node_error = [](const char* key, const json& value) {
            return error_of([&](json& d) { d["nodes"][0][key] = value; });
        };
        CHECK(node_error("rotation", {0, 0, 0, 0}) ==
              "x.glb: node 'tri' has a rotation that is not a unit quaternion");
        CHECK(node_error("rotation", {0, 0, 0, 1.0001}) == "");
        CHECK(node_error("matrix", {1, 2}) ==
              "x.glb: node 'tri' has a matrix of 2 numbers; expected 16");
        CHECK(node_error("translation", {0, 0, 1e12}) ==
              "x.glb: mesh 'Tri' primitive 0: a vertex lies more than 1e8 m from the origin");
        CHECK(node_error("matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) ==
              "x.glb: node 'tri' has a matrix whose last row is not 0 0 0 1");
        CHECK(node_error("skin", 0) ==
              "x.glb: node 'tri' is skinned, which is not read; apply the armature before the "
              "export");
        CHECK(node_error("weights", {0, 0.5}) ==
              "x.glb: node 'tri' is morphed, which is not read; apply the shape keys before the "
              "export");
        CHECK(error_of([](json& d) { d["meshes"][0]["weights"] = {1}; }) != "");
    }

    TEST_CASE("glTF errors: extensions are refused by name") {
        const auto extension_error = [](const char* list, const char* name) {
            return error_of([&](json& d) { d[list] = {name}; });
        };
        CHECK(extension_error("extensionsRequired", "KHR_draco_mesh_compression") ==
              "x.glb: is compressed with KHR_draco_mesh_compression, which is not read; export it "
              "uncompressed");
        CHECK(extension_error("extensionsUsed", "EXT_mesh_gpu_instancing") ==
              "x.glb: places copies with EXT_mesh_gpu_instancing, which is not read; export one "
              "node a copy");
        CHECK(extension_error("extensionsRequired", "VENDOR_secret") ==
              "x.glb: requires the extension 'VENDOR_secret', which is not read");
    }

    TEST_CASE("glTF errors: values of a wrong type, of no type and out of range never crash") {
        const json odd = {nullptr,
                          true,
                          -1,
                          0.5,
                          1e300,
                          1ULL << 63,
                          4294967296,
                          "x",
                          {1, "two", {}},
                          {{"name", {{"name", "x"}}}}};
        for (const json& value : odd) {
            CAPTURE(value);
            for (const json::json_pointer& at :
                 {"/nodes"_json_pointer,
                  "/nodes/0"_json_pointer,
                  "/nodes/0/mesh"_json_pointer,
                  "/nodes/0/children"_json_pointer,
                  "/nodes/0/matrix"_json_pointer,
                  "/nodes/0/extras"_json_pointer,
                  "/meshes"_json_pointer,
                  "/meshes/0/primitives"_json_pointer,
                  "/meshes/0/primitives/0"_json_pointer,
                  "/meshes/0/primitives/0/mode"_json_pointer,
                  "/meshes/0/primitives/0/indices"_json_pointer,
                  "/meshes/0/primitives/0/material"_json_pointer,
                  "/meshes/0/primitives/0/attributes"_json_pointer,
                  "/meshes/0/primitives/0/attributes/POSITION"_json_pointer,
                  "/accessors"_json_pointer,
                  "/accessors/0/bufferView"_json_pointer,
                  "/accessors/0/byteOffset"_json_pointer,
                  "/accessors/0/count"_json_pointer,
                  "/accessors/0/componentType"_json_pointer,
                  "/accessors/0/sparse"_json_pointer,
                  "/bufferViews"_json_pointer,
                  "/bufferViews/0/buffer"_json_pointer,
                  "/bufferViews/0/byteOffset"_json_pointer,
                  "/bufferViews/0/byteLength"_json_pointer,
                  "/bufferViews/0/byteStride"_json_pointer,
                  "/buffers"_json_pointer,
                  "/materials"_json_pointer,
                  "/materials/0/name"_json_pointer,
                  "/scenes"_json_pointer,
                  "/scene"_json_pointer,
                  "/extensionsUsed"_json_pointer}) {
                const std::string error = error_of([&](json& d) { d[at] = value; });
                CAPTURE(error);
                CHECK((error.empty() || error.find("x.glb") != std::string::npos));
            }
        }
    }

    TEST_CASE("glTF errors: members that must be there") {
        CHECK(error_of([](json& d) {
                  d["accessors"][0].erase("count");
              }).starts_with("x.glb: is not a valid glTF: 'count' property is missing"));
        CHECK(error_of([](json& d) { d["bufferViews"][0].erase("buffer"); }) != "");
        CHECK(error_of([](json& d) { primitive(d).erase("attributes"); }) != "");
        CHECK(error_of([](json& d) { d.erase("asset"); }) ==
              "x.glb: asset.version is missing; expected glTF version 2.0");
        CHECK(error_of([](json& d) { d["asset"]["version"] = "1.0"; }) ==
              "x.glb: is glTF version 1.0; expected 2.0");
        // glTF 1.0 has objects where 2.0 has arrays.
        CHECK(error_of([](json& d) {
                  d["accessors"] = json::object();
                  d["asset"]["version"] = "1.0";
              }) == "x.glb: is glTF version 1.0; expected 2.0");
    }
}
