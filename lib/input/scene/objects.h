#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "input/scene/scene.h"

namespace sonarsim {

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

/// True if the whole of `text` matches a pattern with `*` and `?`.
bool fits_pattern(std::string_view pattern, std::string_view text);

/// True if `text` matches one of the patterns.
bool fits_any(std::span<const std::string> patterns, std::string_view text);

/// True if the name of an instance, also as its file has it, matches one of the patterns.
bool fits_instance(std::span<const std::string> patterns, const Scene& scene, std::size_t i);

/// Groups the instances of a scene into objects. The first rule that matches a node applies to it.
/// A node without rule is an object of its own; its class is that of its file, else its name
/// without the number of a copy. InputError for a rule that fits no node and no possible instance,
/// for two rules that put nodes of different classes into one object, for an object with the name
/// of a node outside of it, and for more objects or classes than 16 bits can number.
SceneObjects group_objects(const Scene& scene, std::span<const ClassConfig> rules,
                           const PossibleObjects& possible = {});

}  // namespace sonarsim
