#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "trace/arrivals.h"
#include "visibility/cut_triangle.h"

namespace sonarsim {

/// A triangle of a target's surface that the sonar sees, in the sensor frame. The curved surface
/// that it represents has the normal n / |n| at the barycentric coordinates w, with n = sum w_i
/// normals[i].
struct TargetFacet {
    std::array<Eigen::Vector3f, 3> corners;  ///< m
    std::array<Eigen::Vector3f, 3> normals;  ///< facing the sonar like `normal`, at most unit
    Eigen::Vector3f normal;                  ///< unit, of the triangle, facing the sonar
    float curvature_m;                       ///< as in TargetTriangle, negative if hollow
    std::uint32_t material;                  ///< index into Scene::materials
    std::uint32_t instance;                  ///< index into Scene::instances
    std::uint32_t region;                    ///< as in TargetTriangle
    float strength = 1.0F;                   ///< factor on its power, from a map
};

/// Calls use(facet) for the one or two triangles of a part of a facet.
template <class Use>
void for_each_triangle(const TargetFacet& facet, const TrianglePart& part, Use use) {
    TargetFacet piece = facet;
    const auto set_corner = [&](int to, const TrianglePlace& place) {
        const auto mean = [&](const std::array<Eigen::Vector3f, 3>& of) -> Eigen::Vector3f {
            return of[0] + place.u * (of[1] - of[0]) + place.v * (of[2] - of[0]);
        };
        piece.corners[to] = mean(facet.corners);
        piece.normals[to] = mean(facet.normals);
    };
    const auto& [a, b, c, d] = part.corners;
    set_corner(0, a);
    set_corner(1, b);
    set_corner(2, c);
    use(piece);
    if (a.u == d.u && a.v == d.v) return;
    set_corner(1, c);
    set_corner(2, d);
    use(piece);
}

/// The differences between the normals of a facet and the directions to the sonar, as vectors. A
/// highlight lies where they are shorter than a few slopes of the material.
struct FacetTurn {
    Eigen::Vector3f along_u, along_v;  ///< change from the first corner to the second and the third
    float least;                       ///< lower bound of the length on the facet

    explicit FacetTurn(const TargetFacet& facet) {
        const auto& p = facet.corners;
        const float per_range = 3.0F / arrival_range(p[0] + p[1] + p[2]);
        std::array<Eigen::Vector3f, 3> off;
        for (int k = 0; k < 3; ++k) {
            // Nearly of unit length: normals are at least 0.9 long.
            const float to_unit = 1.5F - 0.5F * facet.normals[k].squaredNorm();
            off[k] = to_unit * facet.normals[k] + per_range * p[k];
        }
        const Eigen::Vector3f middle = (off[0] + off[1] + off[2]) / 3.0F;
        float spread2 = 0.0F;
        for (const Eigen::Vector3f& corner : off)
            spread2 = std::max(spread2, (corner - middle).squaredNorm());
        along_u = off[1] - off[0];
        along_v = off[2] - off[0];
        least = middle.norm() - std::sqrt(spread2);
    }
};

}  // namespace sonarsim
