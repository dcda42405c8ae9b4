#include "scene/gltf/builder.h"

using nlohmann::json;

namespace {

/// Four corners of the unit square, in the order of a strip.
const std::vector<Point> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};

GltfBuilder square_mesh(int mode) {
    GltfBuilder gltf;
    gltf.points(square, "sand", {{"mode", mode}});
    return gltf;
}

template <class T>
GltfBuilder indexed_square(const std::vector<T>& values, int mode = 4) {
    GltfBuilder gltf = square_mesh(mode);
    const int indices = gltf.indices(values);
    gltf.document["meshes"][0]["primitives"][0]["indices"] = indices;
    return gltf;
}

void check_square(const Scene& scene) {
    REQUIRE(scene.triangles.size() == 2);
    CHECK(scene.vertices.size() == 4);
    double area = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const Eigen::Vector3d a = world_corner(scene, i, 0);
        area += 0.5 * (world_corner(scene, i, 1) - a).cross(world_corner(scene, i, 2) - a).norm();
    }
    CHECK(area == approx(1.0));
    check_point(scene.bounds_min, 0, 0, 0);
    check_point(scene.bounds_max, 1, 0, 1);
}

}  // namespace

TEST_CASE("glTF: lists, strips and fans, with every type of index and none") {
    check_square(load(square_mesh(5)));
    check_square(load(indexed_square<std::uint16_t>({2, 0, 3, 1}, 5)));
    check_square(load(indexed_square<std::uint32_t>({0, 1, 2, 1, 3, 2})));
    // The fan's triangles are 0 1 3 and 0 3 2.
    check_square(load(indexed_square<std::uint8_t>({0, 1, 3, 2}, 6)));
}

TEST_CASE("glTF: sparse positions, over data and over zeros") {
    for (const bool has_base : {true, false}) {
        CAPTURE(has_base);
        GltfBuilder gltf = one_triangle();
        const int at = gltf.view(std::vector<std::uint16_t>{1, 2});
        const int values = gltf.view(std::vector<Point>{{4, 0, 0}, {0, 5, 0}});
        json& accessor = gltf.document["accessors"][0];
        if (!has_base) accessor.erase("bufferView");
        accessor["sparse"] = {{"count", 2},
                              {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                              {"values", {{"bufferView", values}}}};
        const Scene scene = load(gltf);
        REQUIRE(scene.triangles.size() == 1);
        check_triangle(scene, 0, {{{0, 0, 0}, {4, 0, 0}, {0, 0, 5}}});
    }
}

TEST_CASE("glTF: quantized positions") {
    GltfBuilder gltf;
    const std::vector<std::array<std::int16_t, 4>> points{
        {0, 0, 0, 0}, {32767, 0, 0, 0}, {0, -32768, 0, 0}};
    const int accessor = gltf.accessor(gltf.view(points, 8), 5122, 3, "VEC3");
    gltf.mesh({{{"attributes", {{"POSITION", accessor}}}, {"material", gltf.material("sand")}}});
    gltf.node({{"mesh", 0}});
    gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    CHECK(load(gltf).bounds_max.x() == approx(32767.0));
    gltf.document["accessors"][0]["normalized"] = true;
    const Scene scene = load(gltf);
    check_point(world_corner(scene, 0, 1), 1, 0, 0);
    check_point(world_corner(scene, 0, 2), 0, 0, -1);  // -32768 / 32767 is clamped
}

TEST_CASE("glTF: triangles without area or not finite, points and lines are dropped and counted") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    GltfBuilder gltf;
    std::vector<Point> points = unit_triangle;
    points.insert(points.end(), {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});           // on a line
    points.insert(points.end(), {{5e8F, 0, 0}, {5e8F, 0, 0}, {0, 5e8F, 0}});  // a point twice
    points.insert(points.end(), {{0, 0, 0}, {nan, 0, 0}, {0, 1, 0}});
    points.insert(points.end(), {{0, 0, 0}, {1, 0, 0}, {0, infinity, 0}});
    gltf.points(points, "sand");
    json& primitives = gltf.document["meshes"][0]["primitives"];
    for (const int mode : {0, 1, 2, 3}) {
        primitives.push_back(primitives[0]);
        primitives.back()["mode"] = mode;
    }
    const Scene scene = load(gltf);
    CHECK(scene.triangles.size() == 1);
    CHECK(scene.vertices.size() == 3);  // the dropped triangles leave no vertices
    CHECK(scene.rejects.degenerate_triangles == 2);
    CHECK(scene.rejects.non_finite_triangles == 2);
    CHECK(scene.rejects.skipped_primitives == 4);
    check_point(scene.bounds_max, 1, 0, 1);
    check_point(scene.origin, 1, 0, 1);  // they did not move the origin either: centre 0.5
    GltfBuilder flattened = one_triangle();
    // 1e-12 m high at z = 0.3 m, where floats are 3e-8 m apart.
    flattened.node({{"mesh", 0}, {"translation", {100, 0.3, 0}}, {"scale", {1, 1e-12, 1}}});
    CHECK(load(flattened).triangles.size() == 1);
    CHECK(load(flattened).rejects.degenerate_triangles == 1);
}

TEST_CASE("glTF: a scene moved by multiples of g keeps its local coordinates bit by bit") {
    // The delicate case: a size of exactly 100 m and a centre at exactly half of that.
    GltfBuilder gltf;
    gltf.points({{0, 0, 0}, {100, 0.123456789F, 0}, {33.3F, 100, 77.7F}}, "sand");
    const Scene scene = load(gltf);
    for (const double shift : {-100.0, 500000.0, 4800000.0}) {
        CAPTURE(shift);
        gltf.document["nodes"][0]["translation"] = {shift, -shift, 2 * shift};
        const Scene moved = load(gltf);
        REQUIRE(moved.vertices.size() == scene.vertices.size());
        for (std::size_t i = 0; i < scene.vertices.size(); ++i)
            CHECK(moved.vertices[i] == scene.vertices[i]);
        check_point(moved.origin - scene.origin, shift, -2 * shift, -shift, 0.0);
    }
    // Extent 60 m: g = 100. The centre (500060, 4800070, 45) goes to (500100, 4800100, 0).
    GltfBuilder small = one_triangle();
    small.document["nodes"][0]["scale"] = {60, 8, 1};
    small.document["nodes"][0]["translation"] = {500030, 41, -4800070};
    check_point(load(small).origin, 500100, 4800100, 0, 0.0);
    check_point(world_corner(load(small), 0, 1), 500090, 4800070, 41);
}
