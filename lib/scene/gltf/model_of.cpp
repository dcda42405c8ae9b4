#include "scene/gltf/model_of.h"

#include "core/named_at.h"

namespace sonarsim {

const tinygltf::Model& model_of(const PlacedFile& file, SceneFiles& models) {
    try {
        return models.model(file.file);
    } catch (const InputError& error) {
        if (file.place.file.empty()) throw;
        throw named_at(error, file.place);
    }
}

}  // namespace sonarsim
