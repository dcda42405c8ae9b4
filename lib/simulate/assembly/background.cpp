#include "simulate/assembly/background.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "simulate/assembly/ground_parts.h"

namespace sonarsim {

namespace {

double area_of(const std::vector<Eigen::Vector3f>& vertices,
               const std::array<std::uint32_t, 3>& triangle) {
    const Eigen::Vector3f& corner = vertices[triangle[0]];
    return 0.5 * (vertices[triangle[1]] - corner)
                     .cast<double>()
                     .cross((vertices[triangle[2]] - corner).cast<double>())
                     .norm();
}

/// The surface of each object, m2, without the parts that move.
std::vector<double> surfaces_of(const Scene& scene, const SceneObjects& objects) {
    std::vector<double> areas(objects.objects.size(), 0.0);
    for (std::size_t k = 0; k < scene.triangles.size(); ++k)
        areas[objects.object_of(scene.triangle_instance[k])] +=
            area_of(scene.vertices, scene.triangles[k]);
    std::vector<double> mesh_areas;
    for (const SharedMesh& mesh : scene.shared_meshes) {
        double area = 0.0;
        for (const auto& triangle : mesh.triangles)
            area += area_of(mesh.vertices, triangle);
        mesh_areas.push_back(area);
    }
    for (const MeshCopy& copy : scene.copies) {
        const double scale = copy.T_world_mesh.linear().col(0).norm();
        areas[objects.object_of(copy.instance)] += scale * scale * mesh_areas[copy.mesh];
    }
    return areas;
}

void add_bottom(const Mission& mission, const Scene& scene, const SceneObjects& objects,
                std::vector<std::uint8_t>& background) {
    const std::vector<std::string> bottom = bottom_patterns(mission.scene);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        for (const std::string& pattern : bottom) {
            if (fits_pattern(pattern, scene.instances[i]))
                background[objects.class_of(objects.object_of(i))] = 1;
        }
    }
}

/// The class of the largest surface; nothing for a single class.
std::optional<std::uint32_t> largest_class(const Scene& scene, const SceneObjects& objects) {
    if (objects.classes.size() < 2) return std::nullopt;
    const std::vector<double> areas = surfaces_of(scene, objects);
    const auto largest = std::ranges::max_element(areas);
    if (!(*largest > 0.0)) return std::nullopt;
    return objects.class_of(static_cast<std::uint32_t>(largest - areas.begin()));
}

/// The index of the class that an entry of labels.`key` names. InputError if there is none.
std::size_t class_named(const Mission& mission, const SceneObjects& objects, const char* key,
                        const std::string& name) {
    const auto found = std::ranges::find(objects.classes, name);
    if (found != objects.classes.end())
        return static_cast<std::size_t>(found - objects.classes.begin());
    std::string all;
    for (const std::string& one : objects.classes)
        all += (all.empty() ? "" : ", ") + printable(one);
    throw InputError(mission.labels.place,
                     std::string("labels.") + key + ": there is no class '" + printable(name) +
                         "'" + did_you_mean(name, objects.classes) + "; there are: " + all);
}

}  // namespace

std::vector<std::uint8_t> background_classes(const Mission& mission, const Scene& scene,
                                             const SceneObjects& objects) {
    std::vector<std::uint8_t> background(objects.classes.size(), 0);
    for (const std::string& name : mission.labels.background) {
        const bool is_class = std::ranges::find(objects.classes, name) != objects.classes.end();
        if (name == "auto" && !is_class) {
            add_bottom(mission, scene, objects, background);
            if (const auto largest = largest_class(scene, objects)) background[*largest] = 1;
        } else if (name != "none" || is_class) {
            background[class_named(mission, objects, "background", name)] = 1;
        }
    }
    for (const ScatterConfig& rule : mission.scene.scatter) {
        for (std::size_t i = 0; rule.unlabelled && i < rule.files.size(); ++i) {
            const auto found = std::ranges::find(objects.classes, rule.class_of(i));
            if (found != objects.classes.end())
                background[static_cast<std::size_t>(found - objects.classes.begin())] = 1;
        }
    }
    return background;
}

std::vector<std::uint8_t> shadow_classes(const Mission& mission, const SceneObjects& objects) {
    std::vector<std::uint8_t> shadow(objects.classes.size(), 0);
    for (const std::string& name : mission.labels.shadow)
        shadow[class_named(mission, objects, "shadow", name)] = 1;
    return shadow;
}

std::optional<std::string> background_by_size(const Mission& mission, const Scene& scene,
                                              const SceneObjects& objects) {
    const std::vector<std::string>& names = mission.labels.background;
    if (std::ranges::find(names, "auto") == names.end()) return std::nullopt;
    const std::optional<std::uint32_t> largest = largest_class(scene, objects);
    std::vector<std::uint8_t> bottom(objects.classes.size(), 0);
    add_bottom(mission, scene, objects, bottom);
    if (!largest || bottom[*largest] != 0 ||
        std::ranges::count(names, objects.classes[*largest]) > 0)
        return std::nullopt;
    return objects.classes[*largest];
}

}  // namespace sonarsim
