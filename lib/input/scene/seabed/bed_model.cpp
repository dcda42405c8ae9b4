#include "input/scene/seabed/bed_model.h"

#include <array>
#include <cmath>
#include <map>

#include "input/scene/model_data.h"

namespace sonarsim {

namespace {

/// Adds triangles to a ground, and cuts them where the sediments' values, which are linear between
/// cells, cross a limit. Near a limit whole triangles are of one mixture.
class Borders {
  public:
    Borders(const BedSediments& bed, BedGround& ground)
        : bed_(bed), ground_(ground), parts_(ground.corners.size()) {}

    void add(const std::array<std::uint32_t, 3>& triangle) {
        std::array<std::uint8_t, 3> at{};
        for (std::size_t k = 0; k < 3; ++k)
            at[k] = bed_.cells[triangle[k]];
        const auto [low, high] = std::minmax({at[0], at[1], at[2]});
        if (low == high) {
            append(low, triangle, triangle[0], triangle[1], triangle[2]);
            return;
        }
        // Around the triangle: a corner is in one part, a crossing in those on both sides.
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            parts_[at[k]].push_back(triangle[k]);
            for (std::size_t part = at[k]; part != at[next];) {
                const std::size_t other = at[next] > part ? part + 1 : part - 1;
                const std::uint32_t vertex =
                    crossing(triangle[k], triangle[next], std::min(part, other));
                parts_[part].push_back(vertex);
                parts_[other].push_back(vertex);
                part = other;
            }
        }
        for (std::size_t part = low; part <= high; ++part) {
            for (std::size_t k = 2; k < parts_[part].size(); ++k)
                append(part, triangle, parts_[part][0], parts_[part][k - 1], parts_[part][k]);
            parts_[part].clear();
        }
    }

  private:
    void append(std::size_t part, const std::array<std::uint32_t, 3>& triangle, std::uint32_t a,
                std::uint32_t b, std::uint32_t c) {
        std::vector<std::uint32_t>& corners = ground_.corners[index_of(part, triangle)];
        corners.insert(corners.end(), {a, b, c});
    }

    /// The index into `corners` for a triangle's part in a sediment, or a mixture near a limit.
    std::size_t index_of(std::size_t part, const std::array<std::uint32_t, 3>& triangle) const {
        constexpr auto steps = static_cast<float>(border_mixtures);
        if (bed_.limits.empty()) return part;
        float middle = 0.0F;
        for (const std::uint32_t corner : triangle)
            middle += bed_.values[corner] / 3.0F;
        std::size_t index = part;
        float nearest = 1.0F;
        for (std::size_t border = std::max<std::size_t>(part, 1) - 1;
             border <= part && border < bed_.limits.size(); ++border) {
            const float from_limit = std::abs(middle - bed_.limits[border]) / bed_.mixed;
            const bool beyond = part > border;
            const float inside = (middle > bed_.limits[border]) == beyond ? from_limit : 0.0F;
            if (inside >= nearest) continue;
            nearest = inside;
            const auto step = static_cast<std::size_t>(steps * inside);
            index = bed_.limits.size() + 1 + 2 * border_mixtures * border +
                    (beyond ? border_mixtures + step : border_mixtures - 1 - step);
        }
        return index;
    }

    /// The vertex where an edge crosses a limit, the same for the triangles on both sides.
    std::uint32_t crossing(std::uint32_t from, std::uint32_t to, std::size_t limit) {
        if (from > to) std::swap(from, to);
        std::vector<float>& vertices = ground_.vertices;
        const auto number = static_cast<std::uint32_t>(vertices.size() / 3);
        const auto [found, added] = known_.try_emplace({from, to, limit}, number);
        // The second triangle is the last to need it.
        if (!added) return known_.extract(found).mapped();
        // A margin at both ends keeps triangles from being slivers.
        constexpr float margin = 0.05F;
        const float low = bed_.values[from];
        const float share =
            margin + (1.0F - 2.0F * margin) * (bed_.limits[limit] - low) / (bed_.values[to] - low);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float start = vertices[std::size_t{3} * from + axis];
            vertices.push_back(start + share * (vertices[std::size_t{3} * to + axis] - start));
        }
        return number;
    }

    const BedSediments& bed_;
    BedGround& ground_;
    std::vector<std::vector<std::uint32_t>> parts_;  ///< the corners of a triangle's parts
    std::map<std::array<std::size_t, 3>, std::uint32_t> known_ = {};
};

void set_class(const std::string& name, tinygltf::Node& node) {
    using tinygltf::Value;
    if (name.empty()) return;
    node.extras = Value(Value::Object{{"sonar", Value(Value::Object{{"class", Value(name)}})}});
}

int add_rock_shape(const Surface& surface, int material, tinygltf::Model& model) {
    std::vector<float> positions;
    for (const Eigen::Vector3d& vertex : surface.vertices) {
        for (const double x : vertex)
            positions.push_back(static_cast<float>(x));
    }
    std::vector<std::uint32_t> corners;
    for (const auto& triangle : surface.triangles)
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    const int mesh = add_mesh(model, "rock");
    add_triangles(model, mesh, add_positions(model, positions), corners, material);
    return mesh;
}

}  // namespace

BedGround ground_of(const Seabed& bed) {
    const auto width = static_cast<std::uint32_t>(bed.grid.columns);
    const auto size = static_cast<std::uint32_t>(bed.heights.size());
    BedGround out{grid_positions(bed.heights, width), {}};
    out.corners.resize(bed.materials.size() + mixtures_of(bed).size());
    Borders borders(bed.sediments, out);
    for (std::uint32_t i = 0; i + width < size; ++i) {
        if ((i + 1) % width == 0) continue;
        borders.add({i, i + width, i + width + 1});
        borders.add({i, i + width + 1, i + 1});
    }
    return out;
}

tinygltf::Model bed_model(const Seabed& bed) {
    tinygltf::Model model;
    const int ground = add_mesh(model, "seabed");
    const auto [vertices, corners] = ground_of(bed);
    const int positions = add_positions(model, vertices);
    std::vector<std::string> materials = bed.materials;
    for (const BedMixture& mixture : mixtures_of(bed))
        materials.push_back(mixture.name);
    for (std::size_t m = 0; m < corners.size(); ++m) {
        if (corners[m].empty()) continue;
        add_triangles(model, ground, positions, corners[m], material_number(model, materials[m]));
    }
    tinygltf::Node& node = add_node(model, "seabed", ground);
    node.matrix = grid_matrix(bed.grid.cell_m, -bed.grid.cell_m, bed.grid.x_m(0), bed.grid.y_m(0));
    set_class(bed.class_name, node);
    const std::string& rocks_material =
        bed.rock_material.empty() ? bed.materials.front() : bed.rock_material;
    std::vector<int> mesh_of_shape(bed.rock_shapes.size(), -1);
    for (std::size_t i = 0; i < bed.rocks.size(); ++i) {
        const Rock& rock = bed.rocks[i];
        int& mesh = mesh_of_shape[rock.shape];
        if (mesh < 0) {
            mesh = add_rock_shape(bed.rock_shapes[rock.shape],
                                  material_number(model, rocks_material), model);
        }
        const Eigen::Matrix4d& matrix = rock.T_world_shape.matrix();
        tinygltf::Node& placed = add_node(model, rock_name(i), mesh);
        placed.matrix.assign(matrix.data(), matrix.data() + matrix.size());
        set_class(rock_class, placed);
    }
    return model;
}

}  // namespace sonarsim
