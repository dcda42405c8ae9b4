#include "input/scene/summary.h"

#include <spdlog/fmt/fmt.h>

#include "core/text.h"
#include "input/mission/limits.h"
#include "input/scene/mesh_topology.h"

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

std::string point(const Eigen::Vector3d& p) {
    return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x(), p.y(), p.z());
}

/// Counts bytes; fmt counts the columns of a terminal.
std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

/// A table with a row for each name; `cells(k)` is the rest of its line.
std::string rows_of(const std::string& title, const std::vector<std::string>& names,
                    const std::string& heads, const auto& cells) {
    std::size_t width = title.size();
    for (const std::string& name : names)
        width = std::max(width, printable(name).size());
    std::string out = padded("\n" + title, width + 1) + heads + "\n";
    for (std::size_t k = 0; k < names.size(); ++k)
        out += padded(printable(names[k]), width) + cells(k) + "\n";
    return out;
}

std::string table_of_shares(const std::string& title, const std::vector<std::string>& names,
                            const std::vector<Share>& shares) {
    return rows_of(title, names, "   triangles     area m^2", [&](std::size_t k) {
        return fmt::format("{:>12}{:>13.3f}", shares[k].triangles, shares[k].area_m2);
    });
}

}  // namespace

std::string describe_scene(const Scene& scene) {
    Share whole;
    std::vector<Share> material_shares(scene.materials.size());
    std::vector<Share> instance_shares(scene.instances.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const double area = 0.5 * cross_of(scene.vertices, scene.triangles[i]).norm();
        whole.add(area);
        material_shares[scene.triangle_material[i]].add(area);
        instance_shares[scene.triangle_instance[i]].add(area);
    }
    std::string out = fmt::format(
        "bounds     {} to {} m\nsize       {} m\norigin     {} m\n"
        "triangles  {} with {} vertices, {:.3f} m^2\n",
        point(scene.bounds_min), point(scene.bounds_max),
        point(scene.bounds_max - scene.bounds_min), point(scene.origin), whole.triangles,
        scene.vertices.size(), whole.area_m2);
    const SceneRejects& rejects = scene.rejects;
    if (rejects.degenerate_triangles + rejects.non_finite_triangles + rejects.skipped_primitives) {
        out += fmt::format(
            "dropped    {} triangles without area, {} that are not finite, {} primitives of points "
            "or lines\n",
            rejects.degenerate_triangles, rejects.non_finite_triangles, rejects.skipped_primitives);
    }
    if (has_coarse_vertices(scene)) {
        out += fmt::format(
            "rounding   {:.3f} m, since vertices lie far from the origin of their file or node\n",
            scene.vertex_rounding_m);
    }
    return out + table_of_shares("material", names_of(scene.materials), material_shares) +
           table_of_shares("instance", scene.instances, instance_shares);
}

std::string describe_materials(const Scene& scene, const MaterialTable& table, const Water& water) {
    const std::vector<std::string> names = names_of(scene.materials);
    return rows_of("material", names, "  kg/m^3    m/s     reflection", [&](std::size_t k) {
        const Material* const row = find_material(table.materials, names[k]);
        if (!row) return "  not in " + printable(table.file);
        return fmt::format("{:>8}{:>8}{:>13.3f}", number_text(row->density_kg_m3),
                           number_text(row->sound_speed_m_s),
                           power_reflection(row->density_kg_m3, row->sound_speed_m_s, water));
    });
}

}  // namespace sonarsim
