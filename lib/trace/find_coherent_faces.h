#pragma once

#include <memory>

#include "scene/scene.h"
#include "trace/coherent_faces.h"

namespace sonarsim {

/// Null if no material reflects coherently.
std::shared_ptr<const CoherentFaces> find_coherent_faces(const Scene& scene);

}  // namespace sonarsim
