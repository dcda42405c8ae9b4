#include "scene/seabed/bed_model.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "scene/model_data.h"

namespace sonarsim {

namespace {

constexpr const char* bed_node = "seabed";

/// Column, row and height of each vertex.
std::vector<float> vertices_of(const Seabed& bed) {
    std::vector<float> out;
    out.reserve(3 * bed.heights.size());
    std::size_t i = 0;
    for (int row = 0; row < bed.grid.rows; ++row) {
        for (int column = 0; column < bed.grid.columns; ++column, ++i) {
            out.push_back(static_cast<float>(column));
            out.push_back(static_cast<float>(row));
            out.push_back(bed.heights[i]);
        }
    }
    return out;
}

/// The triangles of each material. A square between four heights has the material of its
/// north-western one.
std::vector<std::vector<std::uint32_t>> corners_by_material(const Seabed& bed) {
    const auto width = static_cast<std::uint32_t>(bed.grid.columns);
    const auto height = static_cast<std::uint32_t>(bed.grid.rows);
    std::vector<std::vector<std::uint32_t>> out(bed.materials.size());
    for (std::uint32_t row = 0; row + 1 < height; ++row) {
        for (std::uint32_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t north_west = row * width + column;
            const std::uint32_t south_west = north_west + width;
            std::vector<std::uint32_t>& corners = out[bed.sediments[north_west]];
            for (const std::uint32_t corner : {north_west, south_west, south_west + 1, north_west,
                                               south_west + 1, north_west + 1})
                corners.push_back(corner);
        }
    }
    return out;
}

/// Makes a model of a bed.
class BedModel {
  public:
    explicit BedModel(const Seabed& bed) : bed_(bed) {}

    tinygltf::Model model() && {
        add_bed();
        add_rocks();
        return std::move(model_);
    }

  private:
    /// The index of a material; -1 for one without a name.
    int material(const std::string& name) {
        if (name.empty()) return -1;
        const auto [entry, is_new] = materials_.emplace(name, static_cast<int>(materials_.size()));
        if (is_new) model_.materials.emplace_back().name = name;
        return entry->second;
    }
    int material_or_bed(const std::string& name) {
        return material(name.empty() ? bed_.materials.front() : name);
    }

    int add_corners(const std::vector<std::uint32_t>& corners) {
        return add_accessor(model_, corners, corners.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                            TINYGLTF_TYPE_SCALAR);
    }
    int add_positions(const std::vector<float>& positions) {
        return add_accessor(model_, positions, positions.size() / 3, TINYGLTF_COMPONENT_TYPE_FLOAT,
                            TINYGLTF_TYPE_VEC3);
    }
    static tinygltf::Primitive primitive(int positions, int corners, int material) {
        tinygltf::Primitive out;
        out.mode = TINYGLTF_MODE_TRIANGLES;
        out.attributes["POSITION"] = positions;
        out.indices = corners;
        out.material = material;
        return out;
    }

    int add_mesh(const char* name, const Surface& surface, int material) {
        std::vector<float> positions;
        positions.reserve(3 * surface.vertices.size());
        for (const Eigen::Vector3d& vertex : surface.vertices) {
            for (const double x : vertex)
                positions.push_back(static_cast<float>(x));
        }
        std::vector<std::uint32_t> corners;
        corners.reserve(3 * surface.triangles.size());
        for (const auto& triangle : surface.triangles)
            corners.insert(corners.end(), triangle.begin(), triangle.end());
        tinygltf::Mesh mesh;
        mesh.name = name;
        mesh.primitives.push_back(
            primitive(add_positions(positions), add_corners(corners), material));
        model_.meshes.push_back(std::move(mesh));
        return static_cast<int>(model_.meshes.size()) - 1;
    }

    tinygltf::Node& add_node(const std::string& name, int mesh, const std::string& class_name) {
        tinygltf::Node node;
        node.name = name;
        node.mesh = mesh;
        if (!class_name.empty()) {
            const tinygltf::Value::Object sonar{{"class", tinygltf::Value(class_name)}};
            node.extras =
                tinygltf::Value(tinygltf::Value::Object{{"sonar", tinygltf::Value(sonar)}});
        }
        model_.nodes.push_back(std::move(node));
        return model_.nodes.back();
    }

    void add_bed() {
        const BedGrid& grid = bed_.grid;
        tinygltf::Mesh mesh;
        mesh.name = bed_node;
        const int positions = add_positions(vertices_of(bed_));
        const auto corners = corners_by_material(bed_);
        for (std::size_t m = 0; m < corners.size(); ++m) {
            if (corners[m].empty()) continue;
            mesh.primitives.push_back(
                primitive(positions, add_corners(corners[m]), material(bed_.materials[m])));
        }
        model_.meshes.push_back(std::move(mesh));
        add_node(bed_node, 0, bed_.class_name).matrix = {grid.cell_m,
                                                         0.0,
                                                         0.0,
                                                         0.0,
                                                         0.0,
                                                         -grid.cell_m,
                                                         0.0,
                                                         0.0,
                                                         0.0,
                                                         0.0,
                                                         1.0,
                                                         0.0,
                                                         grid.x_m(0) - bed_.origin_m[0],
                                                         grid.y_m(0) - bed_.origin_m[1],
                                                         0.0,
                                                         1.0};
    }

    void add_rocks() {
        std::vector<int> mesh_of_shape(bed_.rock_shapes.size(), -1);
        for (std::size_t i = 0; i < bed_.rocks.size(); ++i) {
            const Rock& rock = bed_.rocks[i];
            int& mesh = mesh_of_shape[rock.shape];
            if (mesh < 0) {
                mesh = add_mesh("rock", bed_.rock_shapes[rock.shape],
                                material_or_bed(bed_.rock_material));
            }
            const Eigen::Matrix4d& matrix = rock.T_world_shape.matrix();
            add_node(rock_name(i), mesh, bed_.rock_class)
                .matrix.assign(matrix.data(), matrix.data() + matrix.size());
        }
    }

    const Seabed& bed_;
    tinygltf::Model model_;
    std::map<std::string, int> materials_;
};

}  // namespace

tinygltf::Model bed_model(const Seabed& bed) {
    return BedModel(bed).model();
}

}  // namespace sonarsim
