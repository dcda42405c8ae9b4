#include "simulate/visibility/slices/setup.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonarsim {

namespace {

// Surface nearer than this share of the range, along the forward axis of a frame, is ignored.
constexpr float nearest_share = 1e-5F;

// A plane whose distance from the sensor is less than this share of the triangle's distance is
// edge-on to within rounding.
constexpr float edge_on_share = 1e-7F;

std::vector<float> u_of_slices(const SliceFrame& frame) {
    std::vector<float> u;
    for (const Slice& slice : frame.slices)
        u.push_back(slice.u);
    return u;
}

/// The line in the near plane between two corners on it.
EdgeLine near_line(const Corner& a, const Corner& b) {
    const float slope = b.u != a.u ? (b.w - a.w) / (b.u - a.u) : 0.0F;
    return {a.u, a.w, slope, a.q, 0.0F, {}};
}

}  // namespace

void SliceScene::clear(std::uint32_t components) {
    facets.clear();
    trapezoids.clear();
    in_gaps.clear();
    component_u.assign(components, {unbounded, -unbounded});
    dropped = 0;
}

SliceSetup::SliceSetup(const ClusterMesh& mesh, const SliceFrame& frame, const LocalPose& pose,
                       float range_max_m, SliceScene& out)
    : mesh_(mesh),
      frame_(frame),
      R_frame_local_(frame.R_frame_sensor * pose.rotation.transpose()),
      position_(pose.position),
      reach_m_(range_max_m),
      nearest_m_(nearest_share * range_max_m),
      u_low_(frame.slices.front().u),
      u_high_(frame.slices.back().u),
      find_slice_(u_of_slices(frame)),
      out_(out) {}

void SliceSetup::run() {
    out_.clear(mesh_.components);
    for (const TriangleCluster& cluster : mesh_.clusters) {
        if (in_view(cluster)) add_cluster(cluster);
    }
    out_.by_slice = sort_into_groups(first_slice_, frame_.slices.size());
    lazy_ = true;
}

void SliceSetup::add_between(std::span<const std::uint32_t> facets) {
    for (const std::uint32_t facet : facets)
        add_triangle(corners_of(facet), facet);
}

Corners SliceSetup::corners_of(std::uint32_t facet) const {
    const TriangleCluster& cluster = mesh_.clusters[facet / ClusterMesh::max_triangles];
    Corners corners;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = cluster.first_vertex + mesh_.corners[facet][k];
        corners[k] = corner_at(in_frame(mesh_.vertices[vertex]), nearest_m_);
    }
    return corners;
}

bool SliceSetup::in_view(const TriangleCluster& cluster) const {
    const Eigen::Vector3f c = in_frame(cluster.centre);
    const float radius = cluster.radius_m;
    const float reach = reach_m_ + radius;
    if (c.squaredNorm() > reach * reach || c.x() + radius < nearest_m_) return false;
    // Distance from a plane through the sensor: x + s X < 0 outside, with the normal (s, 1).
    const auto beyond = [&](float x, float s) {
        return x + s * c.x() < -radius * std::sqrt(1.0F + s * s);
    };
    return !(beyond(c.y(), -u_low_) || beyond(-c.y(), u_high_) || beyond(c.z(), -frame_.w_low) ||
             beyond(-c.z(), frame_.w_high));
}

void SliceSetup::add_cluster(const TriangleCluster& cluster) {
    cluster_corners_.resize(cluster.vertices);
    for (std::uint32_t i = 0; i < cluster.vertices; ++i) {
        cluster_corners_[i] =
            corner_at(in_frame(mesh_.vertices[cluster.first_vertex + i]), nearest_m_);
    }
    for (std::uint32_t i = 0; i < cluster.triangles; ++i) {
        const std::uint32_t facet = cluster.first_triangle + i;
        const auto& corners = mesh_.corners[facet];
        add_triangle({cluster_corners_[corners[0]], cluster_corners_[corners[1]],
                      cluster_corners_[corners[2]]},
                     facet);
    }
}

void SliceSetup::add_triangle(const Corners& corners, std::uint32_t facet) {
    const auto& [a, b, c] = corners;
    const int in_front = (a.X > nearest_m_) + (b.X > nearest_m_) + (c.X > nearest_m_);
    if (in_front == 0 || std::min({a.X, b.X, c.X}) > reach_m_) return;
    if (in_front < 3) return add_part_in_front(corners, facet);
    std::array<const Corner*, 3> by_u = {&a, &b, &c};
    if (by_u[1]->u < by_u[0]->u) std::swap(by_u[0], by_u[1]);
    if (by_u[2]->u < by_u[1]->u) std::swap(by_u[1], by_u[2]);
    if (by_u[1]->u < by_u[0]->u) std::swap(by_u[0], by_u[1]);
    const auto& [first, middle, last] = by_u;
    if (!(first->u <= u_high_ && last->u > u_low_)) return;
    if (std::max({a.w, b.w, c.w}) <= frame_.w_low || std::min({a.w, b.w, c.w}) >= frame_.w_high)
        return;
    widen_component(facet, {first->u, last->u});
    const std::uint32_t begin = find_slice_(first->u);
    const std::uint32_t end = find_slice_(last->u);
    if (begin == end && !lazy_) {
        if (begin > 0 && begin < frame_.slices.size())
            out_.in_gaps.push_back({facet, begin - 1, true});
        return;
    }
    if (!lazy_) note_clipped(corners, facet, {first->u, last->u});
    if (!add_facet(facet, a)) return;
    const EdgeLine whole = edge_line(*first, *last, nearest_m_);
    const bool above = middle->w > whole.w_at(middle->u);
    const std::uint32_t between = find_slice_(middle->u);
    const auto part = [&](const Corner& from, const Corner& to, const SlicesOfPart& slices) {
        if (!wants_part({from.u, to.u}, slices)) return;
        const EdgeLine other = edge_line(from, to, nearest_m_);
        add_trapezoid(above ? whole : other, above ? other : whole, {from.u, to.u});
    };
    part(*first, *middle, {begin, between});
    part(*middle, *last, {between, end});
}

/// Notes a triangle that slices meet only outside the view, while a corner of the triangle is in
/// view between two slices.
void SliceSetup::note_clipped(const Corners& corners, std::uint32_t facet, Interval u) {
    const auto& [a, b, c] = corners;
    const auto [lowest, highest] = std::minmax({a.w, b.w, c.w});
    // The view's borders are nowhere nearer to w = 0 than at u = 0.
    if (frame_.tan_low <= 0.0F && frame_.tan_high >= 0.0F && frame_.tan_low <= lowest &&
        highest <= frame_.tan_high)
        return;
    // The view's borders depend on u, so the part between them is found in two steps.
    for (int step = 0; step < 2; ++step) {
        const Interval w = w_over(frame_, {std::max(u.from, u_low_), std::min(u.to, u_high_)});
        if (w.from <= lowest && highest <= w.to) return;
        u = u_between(corners, w);
        if (!(u.from < u.to && u.from <= u_high_ && u.to > u_low_)) return;
    }
    const std::uint32_t begin = find_slice_(u.from);
    if (begin == find_slice_(u.to) && begin > 0 && begin < frame_.slices.size())
        out_.in_gaps.push_back({facet, begin - 1, true});
}

/// Between neighbouring u of its corners a polygon has two sides, one above the other.
void SliceSetup::add_part_in_front(const Corners& corners, std::uint32_t facet) {
    const FrontPart part = part_in_front(corners, nearest_m_);
    std::array<EdgeLine, 4> lines;
    std::array<float, 4> u;
    u.fill(unbounded);
    for (int i = 0; i < part.count; ++i) {
        const Corner& a = part.corners[i];
        const Corner& b = part.corners[(i + 1) % part.count];
        const int side = part.sides[i];
        lines[i] = side == FrontPart::cut
                       ? near_line(a, b)
                       : edge_line(corners[side], corners[(side + 1) % 3], nearest_m_);
        lines[i].extent = {std::min(a.u, b.u), std::max(a.u, b.u)};
        u[i] = a.u;
    }
    std::ranges::sort(u);
    widen_component(facet, {-unbounded, unbounded});
    if (!(u[0] <= u_high_ && u[part.count - 1] > u_low_) || !add_facet(facet, corners[0])) return;
    for (int k = 0; k + 1 < part.count; ++k) {
        const float middle = 0.5F * (u[k] + u[k + 1]);
        const EdgeLine* low = nullptr;
        const EdgeLine* high = nullptr;
        for (int i = 0; i < part.count; ++i) {
            const EdgeLine& line = lines[i];
            if (line.extent.from > u[k] || line.extent.to < u[k + 1]) continue;
            if (low == nullptr || line.w_at(middle) < low->w_at(middle)) low = &line;
            if (high == nullptr || line.w_at(middle) >= high->w_at(middle)) high = &line;
        }
        if (low != high && wants_part({u[k], u[k + 1]}, {find_slice_(u[k]), find_slice_(u[k + 1])}))
            add_trapezoid(*low, *high, {u[k], u[k + 1]});
    }
}

void SliceSetup::widen_component(std::uint32_t facet, const Interval& by) {
    Interval& component = out_.component_u[mesh_.facets[facet].component];
    component = {std::min(component.from, by.from), std::max(component.to, by.to)};
}

/// Appends a facet that some slice meets; returns false if it is edge-on.
bool SliceSetup::add_facet(std::uint32_t facet, const Corner& corner) {
    const Eigen::Vector3f point(corner.X, corner.U, corner.W);
    const Eigen::Vector3f normal = R_frame_local_ * mesh_.facets[facet].normal;
    const float height = -normal.dot(point);
    if (std::fabs(height) > reach_m_) return false;
    if (!(std::fabs(height) > edge_on_share * point.norm())) {
        ++out_.dropped;
        return false;
    }
    const float side = height < 0.0F ? -1.0F : 1.0F;
    out_.facets.push_back({side * normal, side * height, facet});
    return true;
}

/// True if the part of the last facet over an extent in u is to be added. A part between two slices
/// is noted, or added on request.
bool SliceSetup::wants_part(const Interval& u, const SlicesOfPart& slices) {
    if (!(u.from < u.to)) return false;
    const bool met = slices.first < slices.next;
    if (met == lazy_) {
        if (!met && slices.first > 0 && slices.first < frame_.slices.size())
            out_.in_gaps.push_back({out_.facets.back().facet, slices.first - 1, false});
        return false;
    }
    if (met) first_slice_.push_back(slices.first);
    return true;
}

/// Adds a part of the last facet, for which wants_part() is true.
void SliceSetup::add_trapezoid(const EdgeLine& low, const EdgeLine& high, const Interval& u) {
    const auto facet_index = static_cast<std::uint32_t>(out_.facets.size() - 1);
    out_.trapezoids.push_back({low, high, u.from, u.to, facet_index});
}

}  // namespace sonarsim
