#include "input/scene/gltf/extras.h"

#include <algorithm>
#include <array>

#include "core/text.h"

namespace sonarsim {

namespace {

std::string sonar_extra(const tinygltf::Value& extras, const char* key) {
    if (!extras.IsObject() || !extras.Has("sonar")) return "";
    const tinygltf::Value& sonar = extras.Get("sonar");
    return sonar.IsObject() && sonar.Has(key) ? sonar.Get(key).Get<std::string>() : "";
}

template <class Parts>
void check_parts(const Parts& parts, const std::string& list, const Location& where) {
    // Children inherit it, so that a long text would be stored many times.
    constexpr std::size_t max_bytes = 1000;
    const std::array<std::string, 2> known{"material", "class"};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const tinygltf::Value& extras = parts[i].extras;
        if (!extras.IsObject() || !extras.Has("sonar")) continue;
        const std::string path = list + "[" + std::to_string(i) + "].extras.sonar";
        const tinygltf::Value& sonar = extras.Get("sonar");
        if (!sonar.IsObject()) throw InputError(where, path + " is not an object");
        for (const std::string& key : sonar.Keys()) {
            if (std::ranges::find(known, key) == known.end()) {
                throw InputError(where, path + ": unknown key '" + printable(key) + "'" +
                                            did_you_mean(key, known) +
                                            "; only 'material' and 'class' are read");
            }
            const tinygltf::Value& value = sonar.Get(key);
            if (value.IsString() && value.Get<std::string>().size() <= max_bytes) continue;
            throw InputError(where, path + "." + key + " is not a text of at most 1000 bytes");
        }
    }
}

}  // namespace

std::string sonar_material(const tinygltf::Value& extras) {
    return sonar_extra(extras, "material");
}

std::string sonar_class(const tinygltf::Value& extras) {
    return sonar_extra(extras, "class");
}

void check_extras(const tinygltf::Model& model, const Location& where) {
    check_parts(model.nodes, "nodes", where);
    check_parts(model.materials, "materials", where);
}

}  // namespace sonarsim
