#pragma once

#include "input/scene/gltf/load.h"
#include "support/test.h"

namespace sonarsim {

using test::TemporaryFolder;

/// Writes a file into a folder; returns its path.
inline std::filesystem::path written(const TemporaryFolder& folder, const std::string& name,
                                     std::string_view bytes) {
    write_file(folder.path / name, bytes);
    return folder.path / name;
}

using Point = std::array<float, 3>;

/// The .glb container of a JSON text and a BIN chunk ("": none), with glTF's padding.
inline std::string glb_of(std::string text, std::string binary) {
    const auto number = [](std::size_t value) {
        const auto v = static_cast<std::uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&v), sizeof(v));
    };
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    std::string chunks = number(text.size()) + "JSON" + text;
    if (!binary.empty()) chunks += number(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
}

/// A small glTF under construction. Tests may change `document` before it is written.
struct GltfBuilder {
    nlohmann::json document = {{"asset", {{"version", "2.0"}}}};
    std::string binary;

    /// A buffer view of these values; returns its index.
    template <class T>
    int view(const std::vector<T>& values, std::size_t stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        nlohmann::json entry = {{"buffer", 0},
                                {"byteOffset", binary.size()},
                                {"byteLength", values.size() * sizeof(T)}};
        if (stride > 0) entry["byteStride"] = stride;
        binary.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return append("bufferViews", entry);
    }

    int accessor(int buffer_view, int component_type, std::size_t count, const std::string& type) {
        return append("accessors", {{"bufferView", buffer_view},
                                    {"componentType", component_type},
                                    {"count", count},
                                    {"type", type}});
    }

    int positions(const std::vector<Point>& points) {
        return accessor(view(points), 5126, points.size(), "VEC3");
    }

    template <class T>
    int indices(const std::vector<T>& values) {
        const int type = sizeof(T) == 1 ? 5121 : sizeof(T) == 2 ? 5123 : 5125;
        return accessor(view(values), type, values.size(), "SCALAR");
    }

    int material(const std::string& name) { return append("materials", {{"name", name}}); }

    int mesh(const nlohmann::json& primitives) {
        return append("meshes", {{"name", "Tri"}, {"primitives", primitives}});
    }

    /// A node with a mesh of one primitive: these points, of a material.
    void points(const std::vector<Point>& points, const std::string& of,
                const nlohmann::json& extra = nlohmann::json::object()) {
        nlohmann::json primitive = {{"attributes", {{"POSITION", positions(points)}}},
                                    {"material", material(of)}};
        primitive.update(extra);
        node({{"mesh", mesh(nlohmann::json::array({primitive}))}});
    }

    int node(const nlohmann::json& entry) { return append("nodes", entry); }

    int append(const std::string& section, const nlohmann::json& entry) {
        document[section].push_back(entry);
        return static_cast<int>(document[section].size()) - 1;
    }

    std::string text() const {
        nlohmann::json out = document;
        if (!binary.empty() && !out.contains("buffers")) {
            out["buffers"] = {{{"byteLength", binary.size()}}};
        }
        return out.dump();
    }

    std::string glb() const { return glb_of(text(), binary); }
};

inline const std::vector<Point> unit_triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

/// One node "tri" with mesh "Tri": a triangle (0 0 0, 1 0 0, 0 1 0) in the glTF frame, of steel.
inline GltfBuilder one_triangle() {
    GltfBuilder gltf;
    gltf.mesh({{{"attributes", {{"POSITION", gltf.positions(unit_triangle)}}},
                {"material", gltf.material("steel")}}});
    gltf.node({{"name", "tri"}, {"mesh", 0}});
    return gltf;
}

inline const std::string test_materials =
    "material,density_kg_m3,sound_speed_m_s\nsteel,7850,5900\nsand,1900,1650\nrubber,1100,1500\n";

/// Loads one file with the materials of a CSV.
inline Scene load_scene(const std::filesystem::path& gltf, const std::filesystem::path& csv) {
    SceneFiles models;
    const PlacedFile file{.file = gltf};
    return load_scene({&file, 1}, models, read_materials(csv), "", Water{});
}

/// Writes the file into a folder and loads it, with the materials above.
inline Scene load_in(const TemporaryFolder& folder, const std::string& bytes) {
    const auto materials = written(folder, "materials.csv", test_materials);
    return load_scene(written(folder, "x.glb", bytes), materials);
}

inline Scene load(const GltfBuilder& gltf) {
    return load_in(TemporaryFolder(), gltf.glb());
}

/// The error message of loading, without the folder; "" if there is none.
inline std::string load_error(const std::string& bytes) {
    const TemporaryFolder folder;
    std::string message = test::fault_of([&] { load_in(folder, bytes); });
    const std::string prefix = folder.path.string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
        message.erase(at, prefix.size());
    return message;
}

inline std::string load_error(const GltfBuilder& gltf) {
    return load_error(gltf.glb());
}

/// Corner `k` of triangle `i` in the world frame.
inline Eigen::Vector3d world_corner(const Scene& scene, std::size_t i, std::size_t k) {
    return scene.origin + scene.vertices[scene.triangles[i][k]].cast<double>();
}

inline void check_point(const Eigen::Vector3d& p, double x, double y, double z,
                        double tolerance = 1e-6) {
    CAPTURE(p.transpose());
    CHECK((p - Eigen::Vector3d(x, y, z)).cwiseAbs().maxCoeff() <= tolerance);
}

/// The corners of triangle `i`.
inline void check_triangle(const Scene& scene, std::size_t i,
                           const std::array<Eigen::Vector3d, 3>& corners) {
    for (std::size_t k = 0; k < 3; ++k)
        check_point(world_corner(scene, i, k), corners[k].x(), corners[k].y(), corners[k].z());
}

}  // namespace sonarsim
