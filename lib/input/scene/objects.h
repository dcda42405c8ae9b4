#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "input/scene/scene.h"

namespace sonarsim {

/// Gives a class to the nodes whose names match a pattern. If `instance` is not empty, they become
/// one object.
struct ClassRule {
    std::string nodes;  ///< `*` stands for any text, `?` for any one byte
    std::string name;   ///< name of the class
    std::string instance;
    Location place;              ///< for messages
    std::string materials = {};  ///< the materials that the mission names in place of nodes
};

/// The objects and classes that labels distinguish. Ids count from 1; a label of 0 means none.
struct SceneObjects {
    struct Object {
        std::string name;
        std::uint32_t class_index = 0;  ///< into `classes`
    };
    std::vector<Object> objects;
    std::vector<std::string> classes;
    /// Indexed by class: 1 if it is never annotated. Empty: no class is.
    std::vector<std::uint8_t> background;
    std::vector<std::uint8_t> shadow;  ///< indexed by class: 1 if masks include the shadow
    std::vector<std::uint32_t> object_of_instance;  ///< index into `objects`, by Scene::instances

    std::uint32_t object_of(std::uint32_t instance) const { return object_of_instance[instance]; }
    std::uint32_t class_of(std::uint32_t object) const { return objects[object].class_index; }
    bool is_background(std::uint32_t object) const {
        return !background.empty() && background[class_of(object)] != 0;
    }
    bool has_shadow(std::uint32_t object) const {
        return !shadow.empty() && shadow[class_of(object)] != 0;
    }
};

/// An object that a scene may have, by its name and by the class that the scene's file gives it.
struct NamedInstance {
    std::string name;
    std::string class_name;  ///< "": none
};

/// The objects that variants of a mission may have. Numbers of classes follow it, not the scene, so
/// that they are the same in all variants.
struct PossibleObjects {
    std::vector<std::string> classes;      ///< they are numbered first
    std::vector<NamedInstance> instances;  ///< their classes follow, by the rules
};

/// True if the whole of `text` matches a pattern with `*` and `?`.
bool fits_pattern(std::string_view pattern, std::string_view text);

/// Groups the instances of a scene into objects. The first rule that matches a node applies to it.
/// A node without rule is an object of its own; its class is that of its file, else its name
/// without the number of a copy. InputError for a rule that fits no node and no possible instance,
/// for two rules that put nodes of different classes into one object, for an object with the name
/// of a node outside of it, and for more objects or classes than 16 bits can number.
SceneObjects group_objects(const Scene& scene, std::span<const ClassRule> rules,
                           const PossibleObjects& possible = {});

}  // namespace sonarsim
