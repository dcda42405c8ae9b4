#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "calibrated/patches.h"
#include "trace/target_surface.h"
#include "visibility/cut_triangle.h"

// The highlight of a smooth curved surface. With incidence angles t off the normal and facets of
// RMS slope s, a sphere of radius a sends back
//
//     integral of R / (8 pi s^2 cos^4 t) exp(-tan^2 t / (2 s^2)) dA,   dA = 2 pi a^2 sin t dt.
//
// With u = tan t it is R a^2 / (4 s^2) times the integral of u sqrt(1 + u^2) exp(-u^2 / (2 s^2))
// du, that is R a^2 / 4 (1 + s^2 + ...): the target strength 20 log(a / 2) + 10 log R for any small
// slope. The highlight has the size a s. A surface with two radii of curvature gives R a b / 4: the
// echo depends on the area over which the normal turns by an angle.
//
// A mesh of flat triangles with interpolated normals n = sum w_i n_i has this area if the areas of
// its pieces are corrected. On a sphere the corners' normals point along the corners, so n / |n|
// points along the piece's place p in the triangle, |p| = a |n|. Seen from the centre, the piece dA
// of the triangle, whose normal is N, covers the solid angle (N . n / |n|) dA / |p|^2, which on the
// sphere has the area
//
//     dA (N . n / |n|) / |n|^2,   at the place p + a (1 - |n|) n / |n|.
//
// On a cylinder of k sides this is too much by up to 1 / cos(pi / k), 0.15 dB at 12 sides.

namespace sonarsim {

/// Facets further off the direction to the sonar than this many slopes have no echo; it would be 54
/// dB below that of the highlight's middle.
inline constexpr float highlight_slopes = 5.0F;

/// Pieces of targets, and the facets that they are parts of.
struct TargetPieces {
    using Floats = PatchBlock::Array<float>;

    PatchBlock points;
    PatchBlock::Array<std::uint32_t> facet{};  ///< index into TargetSurface::facets
    // Until move_to_curve() a piece has its interpolated normal, its triangle's normal and the
    // radius of curvature.
    std::array<Floats, 3> normal{}, flat_normal{};
    Floats curvature_m{};
    // The half edges of a piece as a parallelogram, if they are needed.
    bool with_edges = false;
    PatchBlock::Array<Eigen::Vector3f> edge_u, edge_v;
};

/// Moves pieces from their triangles, where `points` has their places and areas, to the curved
/// surface.
void move_to_curve(TargetPieces& pieces);

/// The size of an edge of a piece. If it is 1 or less, the piece is a point to the beams and bins,
/// and, where the facet may send back a highlight, its normal turns by at most 0.7 slopes.
class PieceSize {
  public:
    PieceSize(const TargetFacet& facet, const PointLimits& limits, float slope) {
        constexpr float turn_by_slope = 0.7F;
        const FacetTurn turn(facet);
        glints_ = slope > 0.0F && turn.least <= highlight_slopes * slope;
        if (glints_) {
            turn_u_ = turn.along_u / (turn_by_slope * slope);
            turn_v_ = turn.along_v / (turn_by_slope * slope);
        }
        const Arrival arrival = arrival_of(facet.corners[0]);
        const auto by_limits = [&](const Eigen::Vector3f& edge) -> Eigen::Vector3f {
            const auto [depth, y, z] = extents_of(edge, arrival.direction);
            const auto per = [&](float limit, float scale) {
                return limit > 0.0F ? scale / limit : 0.0F;
            };
            const float per_range = 1.0F / arrival.range_m;
            return {depth * per(limits.depth_m, 1.0F), y * per(limits.sine, per_range),
                    z * per(limits.elevation_sine, per_range)};
        };
        limits_u_ = by_limits(facet.corners[1] - facet.corners[0]);
        limits_v_ = by_limits(facet.corners[2] - facet.corners[0]);
    }

    float operator()(float u, float v) const {
        const Eigen::Vector3f by_limits = u * limits_u_ + v * limits_v_;
        const float size = by_limits.cwiseAbs().maxCoeff();
        return glints_ ? std::max(size, (u * turn_u_ + v * turn_v_).norm()) : size;
    }

  private:
    Eigen::Vector3f limits_u_, limits_v_;  ///< edges by the limits: in range, across, in elevation
    bool glints_ = false;                  ///< the facet may send back a highlight
    Eigen::Vector3f turn_u_, turn_v_;  ///< if it does: edges by the turn of the normal in slopes
};

/// Cuts facets into pieces and hands these to `use`, a block at a time. `slopes`: RMS slopes of the
/// materials' facets.
template <class Use>
void cut_targets(std::span<const TargetFacet> facets, const PointLimits& limits,
                 std::span<const float> slopes, TargetPieces& pieces, Use use) {
    PatchBlock& points = pieces.points;
    points.count = 0;
    const auto hand_on = [&] {
        move_to_curve(pieces);
        use(pieces);
        points.count = 0;
    };
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
        const TargetFacet& facet = facets[f];
        const Eigen::Vector3f u = facet.corners[1] - facet.corners[0];
        const Eigen::Vector3f v = facet.corners[2] - facet.corners[0];
        const Eigen::Vector3f n_u = facet.normals[1] - facet.normals[0];
        const Eigen::Vector3f n_v = facet.normals[2] - facet.normals[0];
        const float area = 0.5F * facet.strength * u.cross(v).norm();
        const PieceSize size(facet, limits, slopes[facet.material]);
        cut_triangle(size, [&](const TrianglePart& part) {
            const auto [s, t] = part.centroid;
            if (points.count == PatchBlock::most) hand_on();
            const int at = points.count++;
            const Eigen::Vector3f n = facet.normals[0] + s * n_u + t * n_v;
            const Eigen::Vector3f place = facet.corners[0] + s * u + t * v;
            points.x[at] = place.x();
            points.y[at] = place.y();
            points.z[at] = place.z();
            points.area_m2[at] = part.share * area;
            points.material[at] = facet.material;
            pieces.facet[at] = f;
            pieces.curvature_m[at] = facet.curvature_m;
            if (pieces.with_edges) {
                // The vectors from the middle of a side to that of the opposite one, for both pairs
                // of sides.
                const auto& [a, b, c, d] = part.corners;
                pieces.edge_u[at] =
                    0.25F * ((b.u + c.u - a.u - d.u) * u + (b.v + c.v - a.v - d.v) * v);
                pieces.edge_v[at] =
                    0.25F * ((c.u + d.u - a.u - b.u) * u + (c.v + d.v - a.v - b.v) * v);
            }
            for (int axis = 0; axis < 3; ++axis) {
                pieces.normal[axis][at] = n[axis];
                pieces.flat_normal[axis][at] = facet.normal[axis];
            }
        });
    }
    if (points.count > 0) hand_on();
}

}  // namespace sonarsim
