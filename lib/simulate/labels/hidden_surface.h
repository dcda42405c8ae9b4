#pragma once

#include <cstdint>
#include <vector>

#include "input/scene/objects.h"
#include "simulate/labels/object_directions.h"
#include "simulate/ping/sonar.h"
#include "simulate/trace/range_boxes.h"
#include "simulate/trace/surface_echoes.h"

namespace sonarsim {

/// A piece of surface behind another one.
struct HiddenPiece {
    std::uint32_t beam, object;  ///< the object that hides it
    float range_m, half_m, solid_angle;
};

/// The hidden surface of a ping. Sight lines continue behind the first surface that they meet; the
/// surface that they meet there is hidden. A body hides its own far side.
struct HiddenSurface {
    /// The objects that hide surface: all, or those that are no background.
    enum class By { all, objects };

    std::vector<HiddenPiece> pieces;  ///< layer by layer
    /// The share of each object's solid angle within the range that nothing hides; NaN for an
    /// object that no sight line meets. An object does not hide itself.
    std::vector<float> visible_shares;
};

/// Traces the hidden surface, but not in directions without any by `directions`. By::objects keeps
/// only surface that objects, not background, hide, and hidden surface of these objects, which lie
/// in `directions`; small objects cost little. `echoes` are those of the trace.
HiddenSurface find_hidden_surface(const TracedPing& traced, const SurfaceEchoes& echoes,
                                  const View& view, const SceneObjects& objects,
                                  const VisibilityEngine& engine,
                                  const ObjectDirections& directions, HiddenSurface::By by);

/// 1 for the bins [beams, range bins] that hold hidden surface, else 0.
std::vector<std::uint8_t> hidden_bins(const std::vector<HiddenPiece>& pieces, const RangeBins& bins,
                                      int beams);

}  // namespace sonarsim
