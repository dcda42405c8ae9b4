#include "scene/summary.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "core/text.h"

namespace sonarsim {

namespace {

struct Share {
    std::uint64_t triangles = 0;
    double area_m2 = 0.0;

    void add(double area) {
        ++triangles;
        area_m2 += area;
    }
};

double area_of(const Scene& scene, const std::array<std::uint32_t, 3>& triangle) {
    const Eigen::Vector3d a = scene.vertices[triangle[0]].cast<double>();
    const Eigen::Vector3d b = scene.vertices[triangle[1]].cast<double>();
    const Eigen::Vector3d c = scene.vertices[triangle[2]].cast<double>();
    return 0.5 * (b - a).cross(c - a).norm();
}

std::string fixed(double value) {
    char buffer[64];
    std::snprintf(buffer, sizeof(buffer), "%.3f", value);
    return buffer;
}

std::string point(const Eigen::Vector3d& p) {
    return "(" + fixed(p.x()) + ", " + fixed(p.y()) + ", " + fixed(p.z()) + ")";
}

std::string left(std::string text, std::size_t width) {
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text;
}

std::string right(const std::string& text, std::size_t width) {
    return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

std::string table(const std::string& title, const std::vector<std::string>& names,
                  const std::vector<Share>& shares) {
    std::vector<std::string> shown;
    shown.reserve(names.size());
    for (const std::string& name : names)
        shown.push_back(printable(name));
    std::size_t width = title.size();
    for (const std::string& name : shown)
        width = std::max(width, name.size());
    std::string out = "\n" + left(title, width) + "   triangles     area m^2\n";
    for (std::size_t i = 0; i < shown.size(); ++i) {
        out += left(shown[i], width) + right(std::to_string(shares[i].triangles), 12) +
               right(fixed(shares[i].area_m2), 13) + "\n";
    }
    return out;
}

}  // namespace

std::string describe_scene(const Scene& scene) {
    Share whole;
    std::vector<Share> of_material(scene.materials.size());
    std::vector<Share> of_instance(scene.instances.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const double area = area_of(scene, scene.triangles[i]);
        whole.add(area);
        of_material[scene.triangle_material[i]].add(area);
        of_instance[scene.triangle_instance[i]].add(area);
    }
    std::vector<std::string> materials;
    for (const Material& material : scene.materials)
        materials.push_back(material.name);

    std::string out =
        "bounds     " + point(scene.bounds_min) + " to " + point(scene.bounds_max) +
        " m\nsize       " + point(scene.bounds_max - scene.bounds_min) + " m\norigin     " +
        point(scene.origin) + " m\ntriangles  " + std::to_string(whole.triangles) + " with " +
        std::to_string(scene.vertices.size()) + " vertices, " + fixed(whole.area_m2) + " m^2\n";
    const SceneRejects& rejects = scene.rejects;
    if (rejects.degenerate_triangles + rejects.non_finite_triangles + rejects.skipped_primitives) {
        out += "dropped    " + std::to_string(rejects.degenerate_triangles) +
               " triangles without area, " + std::to_string(rejects.non_finite_triangles) +
               " that are not finite, " + std::to_string(rejects.skipped_primitives) +
               " primitives of points or lines\n";
    }
    if (has_coarse_vertices(scene)) {
        out += "rounding   " + fixed(scene.vertex_rounding_m) +
               " m, since vertices lie far from the origin of their file or node\n";
    }
    return out + table("material", materials, of_material) +
           table("instance", scene.instances, of_instance);
}

std::string describe_materials(const Scene& scene, const MaterialTable& table, const Water& water) {
    const std::string title = "material";
    std::size_t width = title.size();
    for (const Material& material : scene.materials)
        width = std::max(width, printable(material.name).size());
    std::string out = "\n" + left(title, width) + "  kg/m^3    m/s     reflection\n";
    for (const Material& material : scene.materials) {
        out += left(printable(material.name), width);
        const auto row = std::ranges::find(table.materials, material.name, &Material::name);
        if (row == table.materials.end()) {
            out += "  not in " + printable(table.file) + "\n";
            continue;
        }
        out += right(number_text(row->density_kg_m3), 8) +
               right(number_text(row->sound_speed_m_s), 8) +
               right(fixed(power_reflection(row->density_kg_m3, row->sound_speed_m_s, water)), 13) +
               "\n";
    }
    return out;
}

}  // namespace sonarsim
