#pragma once

#include "input/scene/objects.h"
#include "simulate/labels/object_directions.h"
#include "simulate/ping/sonar.h"
#include "simulate/trace/range_boxes.h"
#include "simulate/trace/surface_echoes.h"
#include "simulate/trace/trace_context.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

/// A piece of surface behind another one.
struct HiddenPiece {
    std::uint32_t beam, object;  ///< the object that hides it
    float range_m, half_m, solid_angle;
    bool behind_background = false;  ///< background would hide it without the object
    bool far_side = false;           ///< surface of the object, which is no background
};

/// The hidden surface of a ping. Sight lines continue behind the first surface that they meet; the
/// surface that they meet there is hidden. A body hides its own far side.
struct HiddenSurface {
    /// The objects that hide surface: all, or those that are no background.
    enum class By { all, objects };

    std::vector<HiddenPiece> pieces;
    /// The share of each object's solid angle within the range that nothing hides; NaN for an
    /// object that no sight line meets. An object does not hide itself.
    std::vector<float> visible_shares;
};

/// Traces the hidden surface, but not in directions without any by `directions`. By::objects keeps
/// only surface that objects hide, as far as the first background behind them, and hidden surface
/// of these objects, which lie in `directions`; small objects cost little. `echoes`: of the trace.
HiddenSurface find_hidden_surface(const TracedPing& traced, const SurfaceEchoes& echoes,
                                  const TraceContext& context, const SceneObjects& objects,
                                  const ObjectDirections& directions, HiddenSurface::By by);

/// Drops the far sides of bodies, but not those among other hidden surface of their beam.
void drop_far_sides(std::vector<HiddenPiece>& pieces, int beams);

/// 1 for the bins [beams, range bins] that hold hidden surface, else 0.
std::vector<std::uint8_t> hidden_bins(const std::vector<HiddenPiece>& pieces, const RangeBins& bins,
                                      int beams);

// The steps of finding it.

/// A sight line behind the visible surface. It stands for a part of its sample's footprint, whose
/// half edges are these shares of the sample's.
struct SightLine {
    Eigen::Vector3f direction;
    float before_m;  ///< range of its sample
    float range_m;   ///< length so far
    float solid_angle;
    const Sample* sample;
    float share_u, share_v;
    std::uint32_t beam, last_beam;   ///< its part of the footprint covers them
    bool behind_background = false;  ///< background behind its sample was met
};

/// Tells which sight lines are kept: most have nothing to find.
using KeepLine = std::function<bool(const SightLine&)>;

/// The sight lines of a ping, one to a sample.
std::vector<SightLine> sight_lines(const TracedPing& traced, const SurfaceEchoes& echoes, int beams,
                                   const KeepLine& keep);

/// The width of sight lines: of a line array, so many of its beams, which it does not resolve; else
/// that at which the surface that they meet is a few bins deep.
struct LineWidth {
    const ConeBeams& cones;
    int beams;
    const View& view;
};

/// The parts of the edges of a line's sample, which may span many beams and much elevation.
struct LineParts {
    int u = 1, v = 1;
    bool are_scattered = false;
};

/// The parts for a line that meets this surface; null: none.
LineParts parts_of(const SightLine& line, const Intersection* met, const LineWidth& width);

/// The parts for a line that may have some of an object behind it, for the object's share. Their
/// lines are scattered: those of a grid may all miss a thin object. `size`: as least_size().
LineParts parts_of_share(const SightLine& line, const View& view, float size);

/// Appends the parts of a line that has not left its sample.
void divide(const SightLine& line, const LineParts& parts, const LineWidth& width,
            const KeepLine& keep, std::vector<SightLine>& out);

/// Half the extent in range of the surface that a sight line meets, a piece of the plane with this
/// normal. At most four bins if the width divides lines by bins.
float half_extent(const SightLine& line, float range_m, const Eigen::Vector3f& normal,
                  const LineWidth& width);

}  // namespace sonarsim
