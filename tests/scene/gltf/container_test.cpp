#include "input/scene/gltf/primitives.h"
#include "scene/gltf/builder.h"

using nlohmann::json;

namespace {

std::string uri_error(const std::string& uri) {
    GltfBuilder gltf = one_triangle();
    gltf.document["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
    return load_error(gltf.text());
}

std::string outside(const std::string& name) {
    return "x.glb: the buffer '" + name +
           "' is not in the folder of the glTF file or below, where buffers must lie";
}

}  // namespace

TEST_CASE("glTF errors: buffers outside of the folder, or that are not what they claim") {
    for (const char* uri : {"/etc/passwd", "../x.bin", "a/../../x.bin", "file:///etc/passwd",
                            "http://localhost/x.bin", "C:/x.bin", "data:text/html;base64,AAAA"}) {
        CHECK(uri_error(uri) == outside(uri));
    }
    CHECK(uri_error("%2e%2e/x.bin") == outside("../x.bin"));
    CHECK(uri_error("%2Fetc/passwd") == outside("/etc/passwd"));
    CHECK(uri_error("a%00.bin") != "");
    CHECK(uri_error("missing.bin") == "missing.bin: cannot open: No such file or directory");
    CHECK(uri_error(".") == ".: is a folder; a file is expected here");
    CHECK(uri_error("x.glb") != "");  // itself, with another size
    const std::string data = "data:application/octet-stream;base64,";
    CHECK(
        uri_error(data + "AAAA").starts_with("x.glb: is not a valid glTF: Failed to decode 'uri'"));
    CHECK(uri_error(data + std::string(5000, 'A')).size() < 400);  // the message shortens it
    GltfBuilder gltf = one_triangle();
    for (const int length : {0, 40}) {
        gltf.document["buffers"] = {{{"byteLength", length}}};
        CHECK(load_error(gltf).starts_with("x.glb: is not a valid glTF: "));
    }
}

TEST_CASE("glTF errors: .glb containers that lie") {
    const std::string whole = one_triangle().glb();
    // A file that is cut anywhere is refused, and never read beyond its end.
    for (std::size_t length = 0; length < whole.size(); length += 3) {
        CAPTURE(length);
        CHECK(load_error(whole.substr(0, length)) != "");
    }
    const auto patched = [&](std::size_t at, const std::string& bytes) {
        std::string glb = whole;
        return load_error(glb.replace(at, bytes.size(), bytes));
    };
    const std::string huge("\xF0\xFF\xFF\xFF", 4);
    CHECK(patched(4, std::string("\1\0\0\0", 4)) == "x.glb: is a .glb of version 1; expected 2");
    CHECK(patched(8, huge) ==
          "x.glb: the .glb claims 4294967280 bytes; the file has " + std::to_string(whole.size()));
    CHECK(patched(12, huge) == "x.glb: a chunk of the .glb claims 4294967280 bytes; the file has " +
                                   std::to_string(whole.size() - 20) + " left");
    CHECK(patched(16, "BIN ") ==
          "x.glb: the .glb has an unexpected chunk; expected JSON, then BIN");
    const std::size_t binary_length_at = whole.find(std::string("BIN\0", 4)) - 4;
    CHECK(patched(binary_length_at, std::string("\x28\0\0\0", 4)) ==
          "x.glb: a chunk of the .glb claims 40 bytes; the file has 36 left");
}

TEST_CASE("glTF errors: JSON that is malformed, deep or not an object") {
    CHECK(load_error("[]") == "x.glb: asset.version is missing; expected glTF version 2.0");
    CHECK(load_error("{\"asset\": {\"version\": \"2.0\"},\n \"nodes\": [}") ==
          "x.glb: parse error at line 2, column 12: syntax error while parsing value - "
          "unexpected '}'; expected '[', '{', or a literal");
    CHECK(load_error("{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [1e999]}")
              .starts_with("x.glb: number overflow"));
    CHECK(load_error(std::string(1'000'000, '[')) == "x.glb: the JSON is nested more than 64 deep");
}

TEST_CASE("glTF errors: a small file that would take the machine's memory") {
    GltfBuilder gltf = one_triangle();
    // Zeros under a sparse accessor take no bytes in the file.
    json& accessor = gltf.document["accessors"][0];
    accessor.erase("bufferView");
    accessor["count"] = 1 << 28;
    const int at = gltf.view(std::vector<std::uint8_t>{1});
    const int values = gltf.view(std::vector<Point>{{1, 0, 0}});
    accessor["sparse"] = {{"count", 1},
                          {"indices", {{"bufferView", at}, {"componentType", 5121}}},
                          {"values", {{"bufferView", values}}}};
    gltf.document["meshes"][0]["primitives"][0]["mode"] = 5;
    CHECK(load_error(gltf) ==
          "x.glb: mesh 'Tri' primitive 0: POSITION: count 268435456 needs a bufferView; without "
          "one it is at most 1048576");
    // A mesh may be placed many times.
    ReadingLimit limit;
    constexpr std::size_t triangles = std::size_t{1} << 27;
    limit.add(triangles, {"x.glb"});
    CHECK_THROWS_WITH_AS(limit.add(triangles, {"x.glb"}),
                         "x.glb: places more than 2^28 triangles (a primitive counts as 64 more)",
                         InputError);
}
