#pragma once

#include <span>

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// The error that is to be expected of bins that surface only just reaches, or only just does not,
/// as a share of the image's signal. A bin is as bright for a sliver of surface as for a wall, so
/// that the last digits decide about it, and neighbouring slices, which share them, agree.
double error_of_slivers(const View& view, std::span<const Material> materials,
                        const Samples& samples);

}  // namespace sonarsim
