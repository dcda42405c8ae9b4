#include "scene/gltf/builder.h"

using nlohmann::json;

namespace {

/// A change to the document of the triangle, and the message without the name of the file.
struct Bend {
    const char* at;  ///< JSON pointer
    json value;      ///< null: the member is left out
    std::string message;
};

/// The error message for the triangle after the change.
std::string error_of(const char* at, const json& value) {
    GltfBuilder gltf = one_triangle();
    const json::json_pointer pointer(at);
    if (value.is_null()) {
        gltf.document.at(pointer.parent_pointer()).erase(pointer.back());
    } else {
        gltf.document[pointer] = value;
    }
    return load_error(gltf);
}

void check_errors(const std::vector<Bend>& bends, const std::string& where = "x.glb: ") {
    for (const Bend& bend : bends) {
        CAPTURE(bend.at);
        CHECK(error_of(bend.at, bend.value) == (bend.message.empty() ? "" : where + bend.message));
    }
}

#define PRIMITIVE "/meshes/0/primitives/0"

}  // namespace

TEST_CASE("glTF errors: materials") {
    GltfBuilder gltf = one_triangle();
    json more = gltf.document["meshes"][0]["primitives"][0];
    for (const char* name : {"steal", "Material.001", "sand"}) {
        more["material"] = gltf.material(name);
        gltf.document["meshes"][0]["primitives"].push_back(more);
    }
    CHECK(load_error(gltf) ==
          "materials.csv: lacks the material 'steal' of 'tri' in x.glb (did you mean "
          "'steel'?); add it to the CSV or give scene.material_default\n"
          "materials.csv: lacks the material 'Material.001' of 'tri' in x.glb; add it to the "
          "CSV or give scene.material_default");
    const std::string name_one =
        "; name one in the glTF material or as extras.sonar.material of the node, or give "
        "scene.material_default";
    check_errors({{PRIMITIVE "/material",
                   {},
                   "mesh 'Tri' primitive 0 of node 'tri': has no material" + name_one},
                  {"/materials/0/name",
                   {},
                   "mesh 'Tri' primitive 0 of node 'tri': its material has no name" + name_one},
                  {PRIMITIVE "/material", 1, "mesh 'Tri' primitive 0: material 1 does not exist"},
                  {"/nodes/0/extras/sonar", "steel", "nodes[0].extras.sonar is not an object"},
                  {"/nodes/0/extras/sonar/materail", "steel",
                   "nodes[0].extras.sonar: unknown key 'materail' (did you mean 'material'?); only "
                   "'material' and 'class' are read"},
                  {"/materials/0/extras/sonar/material", 3,
                   "materials[0].extras.sonar.material is not a text of at most 1000 bytes"}});
}

TEST_CASE("glTF errors: accessors that claim too much") {
    check_errors(
        {{"/accessors/0/count", 6,
          "claims 6 elements; bufferView 0 is too short for them (36 bytes)"},
         {"/accessors/0/count", 1ULL << 52,
          "count 4503599627370496 is not between 1 and 268435456"},
         {"/accessors/0/count", 0, "count 0 is not between 1 and 268435456"},
         {"/accessors/0/byteOffset", 1ULL << 53,
          "claims 3 elements; bufferView 0 is too short for them (36 bytes)"},
         {"/bufferViews/0/byteOffset", 1ULL << 53,
          "bufferView 0 reaches beyond the end of its buffer (36 bytes)"},
         {"/bufferViews/0/byteStride", 8, "byteStride 8 is less than the size of an element, 12"},
         {"/bufferViews/0/buffer", 1, "bufferView 0 lies in buffer 1, which does not exist"},
         {"/accessors/0/bufferView", 9, "bufferView 9 does not exist"},
         {"/accessors/0/bufferView", {}, "has neither a bufferView nor sparse elements"},
         {PRIMITIVE "/attributes/POSITION", 9, "accessor 9 does not exist"},
         {"/accessors/0/type", "VEC2", "expected an accessor of type VEC3"},
         {"/accessors/0/componentType", 5125, "positions must be float, or 8- or 16-bit integers"}},
        "x.glb: mesh 'Tri' primitive 0: POSITION: ");
    CHECK(error_of("/bufferViews/0/byteStride", 1ULL << 63) != "");
    CHECK(error_of(PRIMITIVE "/attributes/POSITION", {}) ==
          "x.glb: mesh 'Tri' primitive 0: has no POSITION");
}

TEST_CASE("glTF errors: sparse accessors") {
    const auto sparse_error = [](const std::vector<std::uint8_t>& at, int count, int type = 5121) {
        GltfBuilder gltf = one_triangle();
        const int indices = gltf.view(at);
        const int values = gltf.view(std::vector<Point>{{4, 0, 0}, {0, 5, 0}});
        gltf.document["accessors"][0]["sparse"] = {
            {"count", count},
            {"indices", {{"bufferView", indices}, {"componentType", type}}},
            {"values", {{"bufferView", values}}}};
        return load_error(gltf);
    };
    const std::string where = "x.glb: mesh 'Tri' primitive 0: POSITION: sparse ";
    CHECK(sparse_error({0, 2}, 2) == "");
    CHECK(sparse_error({0, 3}, 2) == where + "indices must ascend and stay below 3");
    CHECK(sparse_error({0, 1}, 4) == where + "count 4 is not between 1 and the accessor's 3");
    CHECK(sparse_error({0, 1}, 3) ==
          where + "indices: claims 3 elements; bufferView 1 is too short for them (2 bytes)");
    CHECK(sparse_error({0, 1, 2}, 3) ==
          where + "values: claims 3 elements; bufferView 2 is too short for them (24 bytes)");
    CHECK(sparse_error({0, 1}, 2, 5126) == where + "indices must be unsigned integers");
}

TEST_CASE("glTF errors: primitives") {
    const auto indexed = [](const std::vector<std::uint16_t>& values, int mode) {
        GltfBuilder gltf = one_triangle();
        const int indices = gltf.indices(values);
        json& primitive = gltf.document["meshes"][0]["primitives"][0];
        primitive["indices"] = indices;
        primitive["mode"] = mode;
        return load_error(gltf);
    };
    const std::string where = "x.glb: mesh 'Tri' primitive 0: ";
    CHECK(indexed({0, 1, 3}, 4) == where + "index 3 is out of range; there are 3 vertices");
    CHECK(indexed({0, 1, 2, 0}, 4) == where + "4 corners do not make whole triangles");
    CHECK(indexed({0, 1, 2}, 7) == where + "mode 7 is not one of glTF's, 0 to 6");
    CHECK(error_of(PRIMITIVE "/indices", 0) ==
          where + "indices: indices must be unsigned 8-, 16- or 32-bit integers");
    CHECK(error_of(PRIMITIVE "/indices", 7) ==
          "x.glb: is not a valid glTF: primitive indices accessor out of bounds");
}

TEST_CASE("glTF errors: nodes") {
    const auto node = [](const char* name, int child) {
        return json{{"name", name}, {"children", {child}}};
    };
    check_errors(
        {{"/nodes/0/children", {0}, "node 'tri' is its own ancestor"},
         {"/nodes",
          {{{"children", {1}}}, node("a", 2), node("b", 1)},
          "node 'a' has two parents, 'node0' and 'b'"},
         {"/nodes/0/children", {5}, "node 'tri' has the child node 5, which does not exist"},
         {"/nodes/0/mesh", 5, "node 'tri' has mesh 5, which does not exist"},
         {"/scenes", {{{"nodes", {3}}}}, "the scene has the root node 3, which does not exist"},
         {"/scenes", {{{"nodes", {0, 0}}}}, "node 'tri' is listed twice in the scene"},
         {"/scene", 0, "the default scene is 0, which does not exist"},
         {"/nodes/0/rotation",
          {0, 0, 0, 0},
          "node 'tri' has a rotation that is not a unit quaternion"},
         {"/nodes/0/rotation", {0, 0, 0, 1.0001}, ""},
         {"/nodes/0/matrix", {1, 2}, "node 'tri' has a matrix of 2 numbers; expected 16"},
         {"/nodes/0/matrix",
          {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
          "node 'tri' has a matrix whose last row is not 0 0 0 1"},
         {"/nodes/0/translation",
          {0, 0, 1e12},
          "mesh 'Tri' primitive 0: a vertex lies more than 1e8 m from the origin"},
         {"/nodes/0/skin", 0,
          "node 'tri' is skinned, which is not read; apply the armature before the export"},
         {"/nodes/0/weights",
          {0, 0.5},
          "node 'tri' is morphed, which is not read; apply the shape keys before the export"}});
    CHECK(error_of("/meshes/0/weights", {1}) != "");
    GltfBuilder gltf = one_triangle();
    gltf.node({{"children", {0}}});
    gltf.document["scenes"] = {{{"nodes", {0}}}};
    CHECK(load_error(gltf) ==
          "x.glb: node 'tri' is a root of the scene, but also a child of 'node1'");
    GltfBuilder chain = one_triangle();
    for (int i = 1; i < 256; ++i)
        chain.node({{"children", {i - 1}}});
    CHECK(load_error(chain) == "");
    chain.node({{"children", {255}}});
    CHECK(load_error(chain) == "x.glb: node 'tri' lies deeper than 256 levels in the hierarchy");
}

TEST_CASE("glTF errors: versions, extensions and members that must be there") {
    check_errors(
        {{"/extensionsRequired",
          {"KHR_draco_mesh_compression"},
          "is compressed with KHR_draco_mesh_compression, which is not read; export it "
          "uncompressed"},
         {"/extensionsUsed",
          {"EXT_mesh_gpu_instancing"},
          "places copies with EXT_mesh_gpu_instancing, which is not read; export one node a "
          "copy"},
         {"/extensionsRequired",
          {"VENDOR_secret"},
          "requires the extension 'VENDOR_secret', which is not read"},
         {"/asset", {}, "asset.version is missing; expected glTF version 2.0"},
         {"/asset/version", "1.0", "is glTF version 1.0; expected 2.0"}});
    CHECK(error_of("/accessors/0/count", {})
              .starts_with("x.glb: is not a valid glTF: 'count' property is missing"));
    CHECK(error_of("/bufferViews/0/buffer", {}) != "");
    CHECK(error_of(PRIMITIVE "/attributes", {}) != "");
    // glTF 1.0 has objects where 2.0 has arrays.
    GltfBuilder old = one_triangle();
    old.document["accessors"] = json::object();
    old.document["asset"]["version"] = "1.0";
    CHECK(load_error(old) == "x.glb: is glTF version 1.0; expected 2.0");
}

TEST_CASE("glTF errors: values of a wrong type, of no type and out of range never crash") {
    const json odd = json::parse(R"([null, true, -1, 0.5, 1e300, 9223372036854775808,
        4294967296, "x", [1, "two", null], {"name": {"name": "x"}}])");
    std::set<std::string> places{"/nodes/0/children", "/nodes/0/matrix", "/nodes/0/extras"};
    places.insert({PRIMITIVE "/mode", PRIMITIVE "/indices", "/accessors/0/byteOffset"});
    places.insert({"/accessors/0/sparse", "/bufferViews/0/byteStride", "/buffers"});
    places.insert({"/scenes", "/scene", "/extensionsUsed"});
    // Every member that the document has, and what it is in.
    const json members = one_triangle().document.flatten();
    for (const auto& member : members.items()) {
        for (json::json_pointer at(member.key()); !at.empty(); at = at.parent_pointer())
            places.insert(at.to_string());
    }
    for (const json& value : odd) {
        for (const std::string& at : places) {
            CAPTURE_ALL(value, at);
            GltfBuilder gltf = one_triangle();
            gltf.document[json::json_pointer(at)] = value;
            const std::string error = load_error(gltf);
            CAPTURE(error);
            CHECK((error.empty() || error.find("x.glb") != std::string::npos));
        }
    }
}
