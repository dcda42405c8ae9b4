#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/scene.h"

namespace sonarsim {

/// Gives a class to the nodes whose names fit a pattern and, if `instance` is not empty, makes one
/// object of them all.
struct ClassRule {
    std::string nodes;  ///< `*` stands for any text, `?` for any one byte
    std::string name;   ///< of the class
    std::string instance;
    Location place;  ///< for messages
};

/// What labels tell apart. An id counts from 1, since 0 in a label means none.
struct SceneObjects {
    struct Object {
        std::string name;
        std::uint32_t class_index = 0;  ///< into `classes`
    };
    std::vector<Object> objects;
    std::vector<std::string> classes;
    std::vector<std::uint32_t> object_of_instance;  ///< index into `objects`, by Scene::instances

    std::uint32_t object_of(std::uint32_t instance) const { return object_of_instance[instance]; }
    std::uint32_t class_of(std::uint32_t object) const { return objects[object].class_index; }
};

/// Whether all of `text` fits a pattern with `*` and `?`.
bool fits_pattern(std::string_view pattern, std::string_view text);

/// Groups the instances of a scene. Of the rules the first that fits a node counts; a node that
/// none fits is an object of its own, of the class that the scene's file gives it or else of a
/// class with its name. InputError for a rule that no node is left for, for two rules that put
/// nodes of different classes into one object, for an object that has the name of a node outside of
/// it, and for more objects or classes than 16 bits can name.
SceneObjects group_objects(const Scene& scene, std::span<const ClassRule> rules);

}  // namespace sonarsim
