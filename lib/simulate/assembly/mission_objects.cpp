#include "simulate/assembly/mission_objects.h"

#include <set>

#include "core/error.h"
#include "core/text.h"
#include "input/scene/gltf/load.h"
#include "input/scene/mesh_topology.h"
#include "input/scene/seabed/seabed.h"
#include "simulate/assembly/placed_files.h"
#include "simulate/sonar/kinds.h"

namespace sonarsim {

namespace {

double area_of(std::span<const Eigen::Vector3f> vertices, const TriangleCorners& triangle) {
    return 0.5 * cross_of(vertices, triangle).norm();
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
        if (fits_instance(bottom, scene, i)) background[objects.class_of(objects.object_of(i))] = 1;
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

std::optional<std::size_t> class_index(const SceneObjects& objects, const std::string& name) {
    const auto found = std::ranges::find(objects.classes, name);
    if (found == objects.classes.end()) return std::nullopt;
    return static_cast<std::size_t>(found - objects.classes.begin());
}

/// The index of the class that an entry of labels.`key` names. InputError if there is none.
std::size_t class_named(const Mission& mission, const SceneObjects& objects, const char* key,
                        const std::string& name) {
    if (const auto index = class_index(objects, name)) return *index;
    refuse(mission.labels.place, "labels.{}: there is no class '{}'{}; there are: {}", key,
           printable(name), did_you_mean(name, objects.classes),
           printable(listed(objects.classes)));
}

/// The instances whose number is drawn, and their classes.
std::vector<std::pair<std::string, std::string>> drawn_instances(const SceneConfig& scene) {
    std::vector<std::pair<std::string, std::string>> drawn;
    const auto add_from = [&](std::size_t first, double max_count, const std::string& name,
                              const std::string& own) {
        for (std::size_t k = first; static_cast<double>(k) <= max_count; ++k)
            drawn.push_back({name + "_" + std::to_string(k), own});
    };
    for (const ScatterConfig& scatter : scene.scatter) {
        for (std::size_t file = 0; file < scatter.files.size(); ++file) {
            if (file == 0 || scatter.class_of(file) != scatter.class_of(file - 1))
                drawn.push_back({scatter.name + "_1", scatter.class_of(file)});
        }
        add_from(2, scatter.count[1], scatter.name, scatter.class_of(0));
    }
    for (const ParticlesConfig& particles : scene.particles) {
        const std::string& own = particles.class_or_name();
        if (particles.count[0] < max_single_particles) {
            const double max_count = std::min(particles.count[1], max_single_particles - 1);
            add_from(1, max_count, particles.name, own);
        }
        if (particles.count[1] >= max_single_particles) drawn.push_back({particles.name, own});
    }
    return drawn;
}

/// The instances of the files of a mission, and their classes. Nothing is placed.
Scene named_instances(const Mission& mission, SceneFiles& models) {
    Scene named;
    const auto add = [&](const std::string& name, const std::string& class_name) {
        named.instances.push_back(name);
        named.instance_classes.push_back(class_name);
    };
    const auto read = [&](PlacedFile file) {
        file.parts = parts_of(mission, file);
        const Scene own = load_scene_geometry(file, models);
        for (std::size_t i = 0; i < own.instances.size(); ++i)
            add(own.instances[i], own.instance_classes[i]);
    };
    const SceneConfig& scene = mission.scene;
    if (!scene.file.empty()) read(file_of(scene.file, scene.mesh, scene.place));
    if (scene.heightmap) add(heightmap_instance, scene.heightmap->class_name);
    if (scene.seabed) add(seabed_instance, scene.seabed->class_name);
    for (const ObjectConfig& object : scene.objects) {
        if (object.name.empty() || object.class_name.empty())
            read(file_of(object));
        else
            add(object.name, object.class_name);
    }
    return named;
}

/// Appends the values that are not in `all`.
template <class T>
void add_new(const std::vector<T>& values, std::vector<T>& all) {
    std::set<T> known(all.begin(), all.end());
    for (const T& value : values) {
        if (known.insert(value).second) all.push_back(value);
    }
}

/// The classes that the rules, of which any may apply to nothing, give to the possible instances.
std::vector<std::string> classes_of(const PossibleObjects& possible,
                                    const std::vector<ClassConfig>& rules) {
    std::vector<std::string> classes;
    for (const auto& [name, own] : possible.instances) {
        const auto rule = std::ranges::find_if(rules, [&, &text = name](const ClassConfig& one) {
            return fits_pattern(one.pattern(), text);
        });
        classes.push_back(rule != rules.end() ? rule->name
                          : own.empty()       ? without_copy_number(name)
                                              : own);
    }
    return classes;
}

}  // namespace

std::vector<std::uint8_t> background_classes(const Mission& mission, const Scene& scene,
                                             const SceneObjects& objects) {
    std::vector<std::uint8_t> background(objects.classes.size(), 0);
    for (const std::string& name : mission.labels.background) {
        const bool is_class = class_index(objects, name).has_value();
        if (name == "auto" && !is_class) {
            add_bottom(mission, scene, objects, background);
            if (const auto largest = largest_class(scene, objects)) background[*largest] = 1;
        } else if (name != "none" || is_class) {
            background[class_named(mission, objects, "background", name)] = 1;
        }
    }
    const auto clutter = class_index(objects, clutter_class);
    const auto& rules = mission.scene.scatter;
    if (clutter && std::ranges::count(rules, clutter_class, &ScatterConfig::class_name) > 0)
        background[*clutter] = 1;
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

PossibleObjects possible_objects(const Mission& mission, const Scene& scene) {
    PossibleObjects possible = mission.variant.objects;
    const auto drawn = drawn_instances(mission.scene);
    std::set<std::string> drawn_names;
    for (const auto& one : drawn)
        drawn_names.insert(one.first);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::string& name = scene.instances[i];
        if (drawn_names.contains(name)) continue;
        possible.instances.push_back({name, scene.instance_classes[i]});
        if (name != seabed_instance || !mission.scene.seabed) continue;
        const SeabedConfig& seabed = *mission.scene.seabed;
        if (seabed.rocks) possible.instances.push_back({rock_name(0), rock_class});
    }
    possible.instances.insert(possible.instances.end(), drawn.begin(), drawn.end());
    return possible;
}

Variants variants_of(const Mission& mission, const MissionSource& source) {
    Variants variants(mission, source, sonar_keys());
    SceneFiles models;
    PossibleObjects all;
    for (const Mission& extreme : variants.extremes()) {
        const PossibleObjects possible =
            possible_objects(extreme, named_instances(extreme, models));
        add_new(possible.instances, all.instances);
        add_new(classes_of(possible, extreme.classes), all.classes);
    }
    variants.note(std::move(all));
    return variants;
}

}  // namespace sonarsim
