#include "visibility/slices/reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sonarsim {

namespace {

// Beside a triangle that its neighbours go on from, as a share of the range: its plane is followed
// no farther than this.
constexpr float neighbour_share = 0.002F;

constexpr float without_end = std::numeric_limits<float>::infinity();
constexpr Reach unknown{{0.0F, 0.0F}, {-1.0F, -1.0F}};

Eigen::Vector3f place(const Corner& c) {
    return {c.X, c.U, c.W};
}

/// Between its corners a triangle lies nearer by the sag of its longest edge, L^2 / 8 r, and no
/// nearer than its plane, `height_m` away.
Extent range_of(const Corners& corners, float height_m) {
    const Eigen::Vector3f a = place(corners[0]);
    const Eigen::Vector3f b = place(corners[1]);
    const Eigen::Vector3f c = place(corners[2]);
    const auto [nearest, farthest] = std::minmax({a.norm(), b.norm(), c.norm()});
    const float edge2 =
        std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
    return {std::max(nearest - edge2 / (4.0F * nearest), height_m), farthest};
}

/// The u of corner k where no other lies farther in the direction of `sign`; else infinite.
float outermost(const FrontPart& part, int k, float sign) {
    for (int i = 0; i < part.count; ++i) {
        if (sign * part.corners[i].u > sign * part.corners[k].u) return sign * without_end;
    }
    return part.corners[k].u;
}

}  // namespace

Reaches::Reaches(const ClusterMesh& mesh, std::span<const Eigen::Vector3f> vertices,
                 const SliceSetup& setup, const SliceScene& scene)
    : mesh_(mesh), vertices_(vertices), setup_(setup), scene_(scene) {}

const Reach& Reaches::of(std::uint32_t seen) {
    if (seen >= known_.size()) known_.resize(scene_.facets.size(), unknown);
    Reach& reach = known_[seen];
    if (reach.range_m.to < 0.0F) {
        const SeenFacet& facet = scene_.facets[seen];
        const Corners corners = setup_.corners_of(facet.facet);
        reach = {u_of(corners, facet.facet), range_of(corners, facet.height_m)};
        if (std::isinf(reach.u.from) || std::isinf(reach.u.to)) {
            reach.range_m.from /= 1.0F + neighbour_share;
            reach.range_m.to *= 1.0F + neighbour_share;
        }
        const Extent& piece = scene_.piece_u[mesh_.facets[facet.facet].piece];
        reach.u = {std::max(reach.u.from, piece.from), std::min(reach.u.to, piece.to)};
    }
    return reach;
}

/// The surface ends at an outermost corner unless it goes on beyond both sides that meet there.
Extent Reaches::u_of(const Corners& corners, std::uint32_t facet) const {
    const FrontPart part = part_in_front(corners, setup_.nearest_m());
    std::array<bool, 4> on{};
    for (int k = 0; k < part.count; ++k)
        on[k] = part.sides[k] == FrontPart::cut || goes_on(corners, part.sides[k], facet);
    Extent ends{-without_end, without_end};
    for (int k = 0; k < part.count; ++k) {
        if (on[k] && on[(k + part.count - 1) % part.count]) continue;
        ends.from = std::max(ends.from, outermost(part, k, -1.0F));
        ends.to = std::min(ends.to, outermost(part, k, 1.0F));
    }
    return ends;
}

/// Whether, as the sonar sees it, the neighbour over a side lies on the other side of it than the
/// triangle's third corner.
bool Reaches::goes_on(const Corners& corners, int side, std::uint32_t facet) const {
    const std::uint32_t vertex = mesh_.beyond[facet][side];
    if (vertex == ClusterMesh::nothing) return false;
    const Eigen::Vector3f a = place(corners[side]);
    const Eigen::Vector3f across = a.cross(place(corners[(side + 1) % 3]) - a);
    const float own = across.dot(place(corners[(side + 2) % 3]) - a);
    const float other = across.dot(setup_.in_frame(vertices_[vertex]) - a);
    return own * other < 0.0F;
}

}  // namespace sonarsim
