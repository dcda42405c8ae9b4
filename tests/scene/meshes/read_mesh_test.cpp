#include "scene/gltf/builder.h"

namespace {

template <class T>
std::string raw(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

constexpr std::array<std::array<float, 3>, 4> corners{
    {{0, 0, 0}, {1.5F, 0, 0}, {0.25F, 2, 0}, {0, 0.5F, 3.25F}}};
constexpr std::array<std::array<int, 3>, 4> faces{{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

std::string text_of(const std::array<float, 3>& p) {
    return std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
}

std::string raw(const std::array<float, 3>& p) {
    return raw(p[0]) + raw(p[1]) + raw(p[2]);
}

/// A tetrahedron in each format.
std::string obj() {
    std::string out;
    for (const auto& corner : corners)
        out += "v " + text_of(corner);
    return out + "f 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
}

std::string text_stl() {
    std::string out = "solid  tetra  one \n";
    for (const auto& face : faces) {
        out += "facet normal 0 0 0\nouter loop\n";
        for (const int k : face)
            out += "vertex " + text_of(corners[static_cast<std::size_t>(k)]);
        out += "endloop\nendfacet\n";
    }
    return out + "endsolid tetra one\n";
}

std::string binary_stl() {
    std::string out(80, ' ');
    out += raw(static_cast<std::uint32_t>(faces.size()));
    for (const auto& face : faces) {
        out += std::string(12, '\0');
        for (const int k : face)
            out += raw(corners[static_cast<std::size_t>(k)]);
        out += std::string(2, '\0');
    }
    return out;
}

std::string ply_header(const std::string& form, const std::string& vertices = "4",
                       const std::string& triangles = "4") {
    return "ply\nformat " + form + " 1.0\ncomment a tetrahedron\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + triangles +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string text_ply() {
    std::string out = ply_header("ascii");
    for (const auto& corner : corners)
        out += text_of(corner);
    return out + "3 0 1 2\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
}

std::string binary_ply() {
    std::string out = ply_header("binary_little_endian");
    for (const auto& corner : corners)
        out += raw(corner);
    for (const auto& face : faces) {
        out += '\3';
        for (const int k : face)
            out += raw(k);
    }
    return out;
}

Scene scene_of(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    return load_scene_geometry(written(folder, name, bytes));
}

/// The message of a file that is refused.
std::string error_of_mesh(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    const std::string path = written(folder, name, bytes).string();
    const std::string message = fault_of([&] { load_scene_geometry(path); });
    if (message.empty()) return "";
    REQUIRE(message.starts_with(path + ":"));
    return message.substr(path.size() - name.size());
}

}  // namespace

TEST_CASE("OBJ, STL and PLY: the corners of every triangle, in the order of the file") {
    const std::vector<std::pair<std::string, std::string>> files{
        {"a.obj", obj()},
        {"a.STL", text_stl()},
        {"b.stl", binary_stl()},
        {"c.stl", "solid" + binary_stl().substr(5)},  // binary, whatever it begins with
        {"d.stl", binary_stl() + std::string(7, '\0')},
        {"a.ply", text_ply()},
        {"b.ply", binary_ply()}};
    for (const auto& file : files) {
        const std::string& name = file.first;
        CAPTURE(name);
        const Scene scene = scene_of(name, file.second);
        REQUIRE(scene.triangles.size() == faces.size());
        for (std::size_t t = 0; t < faces.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Eigen::Vector3d world =
                    scene.vertices[scene.triangles[t][k]].cast<double>() + scene.origin;
                const auto& p = corners[static_cast<std::size_t>(faces[t][k])];
                CHECK(world == Eigen::Vector3d(p[0], -p[2], p[1]));  // y up in the file
            }
        }
        CHECK(scene.materials.front().name == "(no material)");
        const bool is_named = name == "a.STL";
        CHECK(scene.instances ==
              std::vector<std::string>{is_named ? "tetra  one" : name.substr(0, 1)});
    }
}

TEST_CASE("OBJ: objects and groups are nodes, usemtl names materials, polygons are cut") {
    const Scene scene = scene_of("crane.obj",
                                 "mtllib /etc/passwd\n"
                                 "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 2.5 0\nv 0 2 0\n"
                                 "o jib 1 \nusemtl steel\nf 1 2 3 4 5\nusemtl rubber\nf 1 2 3\n"
                                 "o jib 2\nf 3 4 5\nl 1 2\ng cab 1\nf 1 2 4\n");
    CHECK(scene.instances == std::vector<std::string>{"jib 1", "jib 2", "cab 1"});
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].name == "steel");
    CHECK(scene.materials[1].name == "rubber");
    CHECK(scene.triangle_material == std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1});
    CHECK(scene.triangle_instance == std::vector<std::uint32_t>{0, 0, 0, 0, 1, 2});
    CHECK(scene.rejects.skipped_primitives == 1);
}

TEST_CASE("OBJ: no way to write a vertex lets faces have others") {
    const Scene plain =
        scene_of("a.obj", "v 0.5 0.1 0\nv 1 0 0.25\nv 0 0 -0.5\nv 9 9 9\nf 1 2 3\n");
    for (const char* const text :
         {"v .5 .1 0\nv 1 0 .25\nv 0 0 -.5\nv 9 9 9\nvt .5 .5\nvn .1 1 0\nf 1/1/1 2/1/1 3/1/1\n",
          "# C:\\hulls\\\n v 0.5 0.1 0 # 7\r\n\tv 1 0 0.25 1\rv 0 0 -.5 .1 .2 .3\nv 9 9 9\n f 1 2 "
          "3\n",
          "v +.5 .1e0 0.\nv 1 0 0.25\nv 0 0 -5.e-1\nv 9 9 9\nf -4 -3 -2\n"}) {
        CAPTURE(text);
        const Scene scene = scene_of("a.obj", text);
        REQUIRE(scene.triangles.size() == 1);
        CHECK(scene.origin == plain.origin);
        CHECK(scene.vertices == plain.vertices);
    }
}

TEST_CASE("OBJ: faces before the first usemtl have no material, and a group is one instance") {
    const Scene scene = scene_of("crane.obj",
                                 "\xEF\xBB\xBFv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"
                                 "g jib\nf 1 2 3\nusemtl steel\ng cab\nf 1 3 4\ng jib\nf 2 3 4\n");
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].name == "(no material)");
    CHECK(scene.materials[1].name == "steel");
    CHECK(scene.instances == std::vector<std::string>{"jib", "cab"});
    // Instance by instance.
    CHECK(scene.triangle_material == std::vector<std::uint32_t>{0, 1, 1});
    CHECK(scene.triangle_instance == std::vector<std::uint32_t>{0, 0, 1});
}

TEST_CASE("OBJ, STL and PLY: values that are no numbers are left out and counted") {
    CHECK(scene_of("a.obj", "v 0 0 0\nv nan 0 0\nv 1 1 0\nv 1 0 0\nf 1 2 3\nf 1 3 4\n")
              .rejects.non_finite_triangles == 1);
    std::string bytes = binary_ply();
    const float infinite = std::numeric_limits<float>::infinity();
    std::memcpy(bytes.data() + ply_header("binary_little_endian").size(), &infinite, 4);
    const Scene scene = scene_of("a.ply", bytes);
    CHECK(scene.rejects.non_finite_triangles == 3);
    CHECK(scene.triangles.size() == 1);
}

TEST_CASE("OBJ, STL and PLY: files that are faulty") {
    const std::string huge = "4000000000";
    const std::string cut = binary_ply().substr(0, binary_ply().size() - 1);
    std::string long_list = binary_ply();
    long_list[ply_header("binary_little_endian").size() + 48] = '\xff';
    std::string far_index = binary_ply();
    far_index[far_index.size() - 1] = '\x7f';
    const std::vector<std::array<std::string, 3>> faulty{{
        {"a.obj", "", "a.obj: is not a valid OBJ"},
        {"a.obj", "\x89PNG\r\n\x1a\n and so on, for a while", "a.obj: has no faces"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 9\n", "vertex index out of range"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 -9\n", "vertex index out of range"},
        {"a.obj", "v 0 0 0\r\nv 1 .x 0\r\n", "a.obj:2: '.x' of a vertex is not a number"},
        {"a.obj", "v 0 0 0\n\nv 1 0\n", "a.obj:3: a vertex has 2 numbers; expected x, y, z"},
        {"a.stl", "", "a.stl: is not an STL: it is too short for one"},
        {"a.stl", text_stl().substr(0, 200), "a.stl: the STL has no endsolid; it was cut off"},
        {"a.stl", binary_stl().substr(0, 200),
         "it claims 4 triangles, which take 284 bytes, and has 200"},
        {"a.stl", binary_stl() + std::string(50, '\0'), "284 bytes, and has 334"},
        {"a.ply", "", "a.ply:1: the header of the PLY has no end_header"},
        {"a.ply", "plain\n", "a.ply:1: is not a PLY: its first line is not 'ply'"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n",
         "a.ply:3: 'element vertex -1' is not a line of a PLY's header"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 9\nend_header\n", "has no property"},
        {"a.ply", text_ply().substr(0, text_ply().size() - 3),
         "element 'face' of the PLY ends or is faulty in number 4 of 4"},
        {"a.ply", cut, "element 'face' of the PLY ends or is faulty in number 4 of 4"},
        {"a.ply", long_list, "element 'face' of the PLY ends or is faulty in number 1 of 4"},
        {"a.ply", ply_header("binary_big_endian", huge), "in number 1 of 4000000000"},
        {"a.ply", ply_header("ascii", huge), "in number 1 of 4000000000"},
        {"a.ply", far_index, "is out of range; there are 4 vertices"},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
         "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n",
         "a.ply: has its surface as strips of triangles"},
    }};
    for (const auto& file : faulty)
        CHECK_MESSAGE(error_of_mesh(file[0], file[1]).find(file[2]) != std::string::npos, file[2]);
}
