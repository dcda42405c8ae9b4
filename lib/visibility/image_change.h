#pragma once

#include "scene/scene.h"
#include "visibility/engine.h"

namespace sonarsim {

/// By how much the image of `coarse` differs from that of `fine`: sum |A - B| / sum B over the bins
/// of a view, B of `fine`. Images as in Eq. 9 of the model, each sample a box in range.
double image_change(const Scene& scene, const View& view, const Samples& coarse,
                    const Samples& fine);

}  // namespace sonarsim
