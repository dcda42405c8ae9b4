#include "visibility/slices/setup.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "visibility/slices/edge_line.h"
#include "visibility/slices/slice_finder.h"

namespace sonarsim {

namespace {

// Surface nearer than this share of the range, along the forward axis of a frame, is not seen.
constexpr float nearest_share = 1e-5F;

// A plane whose distance from the sensor is less than this share of the triangle's own is seen
// edge-on to within rounding.
constexpr float edge_on_share = 1e-7F;

constexpr float unbounded = std::numeric_limits<float>::infinity();

class Setup {
  public:
    Setup(const ClusterMesh& mesh, std::span<const Eigen::Vector3f> vertices,
          const SliceFrame& frame, const LocalPose& pose, float range_max_m, SetupScratch& scratch,
          SliceScene& out)
        : mesh_(mesh),
          vertices_(vertices),
          frame_(frame),
          R_frame_local_(frame.R_frame_sensor * pose.rotation.transpose()),
          position_(pose.position),
          reach_m_(range_max_m),
          nearest_m_(nearest_share * range_max_m),
          u_low_(frame.slices.front().u),
          u_high_(frame.slices.back().u),
          scratch_(scratch),
          find_slice_(frame.slices, scratch.table),
          out_(out) {}

    void run() {
        for (const Cluster& cluster : mesh_.clusters) {
            if (in_view(cluster)) add(cluster);
        }
        sort_by_slice();
    }

  private:
    bool in_view(const Cluster& cluster) const {
        const Eigen::Vector3f c = R_frame_local_ * (cluster.centre - position_);
        const float radius = cluster.radius_m;
        const float reach = reach_m_ + radius;
        if (c.squaredNorm() > reach * reach || c.x() + radius < nearest_m_) return false;
        // Distance from a plane through the sensor: x + s X < 0 outside, with the normal (s, 1).
        const auto beyond = [&](float x, float s) {
            return x + s * c.x() < -radius * std::sqrt(1.0F + s * s);
        };
        return !(beyond(c.y(), -u_low_) || beyond(-c.y(), u_high_) ||
                 beyond(c.z(), -frame_.w_low) || beyond(-c.z(), frame_.w_high));
    }

    void add(const Cluster& cluster) {
        scratch_.points.resize(cluster.vertices);
        const Eigen::Vector3f* const vertices = mesh_.vertices.data() + cluster.first_vertex;
        for (std::uint32_t i = 0; i < cluster.vertices; ++i)
            scratch_.points[i] = R_frame_local_ * (vertices[i] - position_);
        for (std::uint32_t i = 0; i < cluster.triangles; ++i) {
            const auto& corners = mesh_.corners[cluster.first_triangle + i];
            add_triangle({&scratch_.points[corners[0]], &scratch_.points[corners[1]],
                          &scratch_.points[corners[2]]},
                         cluster.first_triangle + i);
        }
    }

    Corner corner(const Eigen::Vector3f& p, int number) const {
        const float inverse = p.x() > nearest_m_ ? 1.0F / p.x() : 0.0F;
        return {p.x(), p.y(), p.z(), p.y() * inverse, p.z() * inverse, number};
    }

    void add_triangle(const std::array<const Eigen::Vector3f*, 3>& points, std::uint32_t facet) {
        std::array<Corner, 3> c = {corner(*points[0], 0), corner(*points[1], 1),
                                   corner(*points[2], 2)};
        const int in_front = (c[0].X > nearest_m_) + (c[1].X > nearest_m_) + (c[2].X > nearest_m_);
        if (in_front == 0) return;
        if (c[0].X > reach_m_ && c[1].X > reach_m_ && c[2].X > reach_m_) return;
        if (in_front < 3) return add_clipped(c, *points[0], facet);
        // In order of u.
        if (c[1].u < c[0].u) std::swap(c[0], c[1]);
        if (c[2].u < c[1].u) std::swap(c[1], c[2]);
        if (c[1].u < c[0].u) std::swap(c[0], c[1]);
        if (!(c[0].u <= u_high_ && c[2].u > u_low_)) return;
        if (std::max({c[0].w, c[1].w, c[2].w}) <= frame_.w_low ||
            std::min({c[0].w, c[1].w, c[2].w}) >= frame_.w_high) {
            return;
        }
        const std::int32_t first = find_slice_(c[0].u);
        const std::int32_t end = find_slice_(c[2].u);
        if (first == end) {
            note_between(first, facet, c, *points[0]);
            return;
        }
        if (!see(facet, *points[0], c)) return;
        const EdgeLine whole = edge_line(c[0], c[2], nearest_m_);
        const std::int32_t bend = find_slice_(c[1].u);
        const Extent ends = ends_of(c, facet);
        const bool above = c[1].w > whole.w + whole.w_slope * (c[1].u - whole.anchor);
        const auto part = [&](const EdgeLine& other, std::int32_t from, std::int32_t to) {
            if (from < to) {
                add_trapezoid(above ? whole : other, above ? other : whole, from, to, ends);
            }
        };
        if (first < bend) part(edge_line(c[0], c[1], nearest_m_), first, bend);
        if (bend < end) part(edge_line(c[1], c[2], nearest_m_), bend, end);
    }

    /// Where the surface ends with its triangle, whose corners are in order of u: infinite where it
    /// goes on beyond both edges of the outermost corner.
    Extent ends_of(const std::array<Corner, 3>& c, std::uint32_t facet) const {
        const bool whole_goes_on = goes_on(c[0], c[2], c[1], facet);
        const bool low = whole_goes_on && goes_on(c[0], c[1], c[2], facet);
        const bool high = whole_goes_on && goes_on(c[1], c[2], c[0], facet);
        return {low ? -unbounded : c[0].u, high ? unbounded : c[2].u};
    }

    /// Whether, as the sonar sees it, the neighbour over the edge from a to b lies on the other
    /// side of it than the triangle's third corner.
    bool goes_on(const Corner& a, const Corner& b, const Corner& third, std::uint32_t facet) const {
        const int edge = (a.number + 1) % 3 == b.number ? a.number : b.number;
        const std::uint32_t vertex = mesh_.beyond[facet][edge];
        if (vertex == ClusterMesh::nothing) return false;
        const Eigen::Vector3f p = R_frame_local_ * (vertices_[vertex] - position_);
        const Eigen::Vector3f across =
            Eigen::Vector3f(a.X, a.U, a.W).cross(Eigen::Vector3f(b.X - a.X, b.U - a.U, b.W - a.W));
        const float own = across.dot(Eigen::Vector3f(third.X - a.X, third.U - a.U, third.W - a.W));
        const float other = across.dot(p - Eigen::Vector3f(a.X, a.U, a.W));
        return own * other < 0.0F;
    }

    /// A triangle of which only a part lies in front of the sensor.
    void add_clipped(const std::array<Corner, 3>& c, const Eigen::Vector3f& point,
                     std::uint32_t facet) {
        std::array<Corner, 4> polygon;
        std::array<EdgeLine, 4> lines;  // from each corner to the next
        std::array<bool, 4> on{};       // whether the surface goes on beyond it
        int n = 0;
        for (int i = 0; i < 3; ++i) {
            const Corner& a = c[i];
            const Corner& b = c[(i + 1) % 3];
            const bool a_in = a.X > nearest_m_;
            const bool b_in = b.X > nearest_m_;
            if (!a_in && !b_in) continue;
            const EdgeLine line = edge_line(a, b, nearest_m_);
            const bool line_on = goes_on(a, b, c[(i + 2) % 3], facet);
            if (a_in) {
                polygon[n] = a;
                on[n] = line_on;
                lines[n++] = line;
            }
            if (a_in == b_in) continue;
            polygon[n] = a_in ? crossing(a, b) : crossing(b, a);
            on[n] = line_on;
            lines[n++] = line;  // of the edge that comes in; the one that left is drawn below
        }
        for (int i = 0; i < n; ++i) {
            const Corner& a = polygon[i];
            const Corner& b = polygon[(i + 1) % n];
            if (a.X == nearest_m_ && b.X == nearest_m_) {
                lines[i] = clip_line(a, b);
                on[i] = true;
            }
            lines[i].extent = {std::min(a.u, b.u), std::max(a.u, b.u)};
        }
        Extent ends{-unbounded, unbounded};
        for (int i = 0; i < n; ++i) {
            if (on[i] && on[(i + n - 1) % n]) continue;
            ends.from = std::max(ends.from, outermost(polygon, n, i, -1.0F));
            ends.to = std::min(ends.to, outermost(polygon, n, i, 1.0F));
        }
        add_polygon(polygon, lines, n, point, c, ends, facet);
    }

    /// The u of corner i where no other lies farther in the direction of `sign`; else infinite.
    static float outermost(const std::array<Corner, 4>& polygon, int n, int i, float sign) {
        for (int k = 0; k < n; ++k) {
            if (sign * polygon[k].u > sign * polygon[i].u) return sign * unbounded;
        }
        return polygon[i].u;
    }

    /// Where the edge from a, in front, to b comes nearest.
    Corner crossing(const Corner& a, const Corner& b) const {
        const float share = (nearest_m_ - a.X) / (b.X - a.X);
        const float U = a.U + share * (b.U - a.U);
        const float W = a.W + share * (b.W - a.W);
        return {nearest_m_, U, W, U / nearest_m_, W / nearest_m_, 0};
    }

    EdgeLine clip_line(const Corner& a, const Corner& b) const {
        const float slope = b.u != a.u ? (b.w - a.w) / (b.u - a.u) : 0.0F;
        return {a.u, a.w, slope, 1.0F / nearest_m_, 0.0F, {}};
    }

    void add_polygon(const std::array<Corner, 4>& polygon, const std::array<EdgeLine, 4>& lines,
                     int n, const Eigen::Vector3f& point, const std::array<Corner, 3>& c,
                     const Extent& ends, std::uint32_t facet) {
        std::array<float, 4> u{};
        for (int i = 0; i < n; ++i)
            u[i] = polygon[i].u;
        std::sort(u.begin(), u.begin() + n);
        if (!(u[0] <= u_high_ && u[n - 1] > u_low_)) return;
        if (find_slice_(u[0]) == find_slice_(u[n - 1]) || !see(facet, point, c)) return;
        for (int k = 0; k + 1 < n; ++k) {
            const std::int32_t from = find_slice_(u[k]);
            const std::int32_t to = find_slice_(u[k + 1]);
            if (from >= to) continue;
            // Two edges cross the interval; which is the lower shows at a slice within it.
            const float at = frame_.slices[(from + to - 1) / 2].u;
            std::array<int, 4> edges{};
            int count = 0;
            for (int i = 0; i < n; ++i) {
                const auto [low, high] = std::minmax(polygon[i].u, polygon[(i + 1) % n].u);
                if (low <= u[k] && u[k + 1] <= high) edges[count++] = i;
            }
            if (count < 2) continue;
            const auto w = [&](int i) {
                return lines[i].w + lines[i].w_slope * (at - lines[i].anchor);
            };
            int low = edges[0];
            int high = edges[0];
            for (int i = 1; i < count; ++i) {
                if (w(edges[i]) < w(low)) low = edges[i];
                if (w(edges[i]) >= w(high)) high = edges[i];
            }
            add_trapezoid(lines[low], lines[high], from, to, ends);
        }
    }

    void note_between(std::int32_t slice, std::uint32_t facet, const std::array<Corner, 3>& c,
                      const Eigen::Vector3f& point) {
        if (slice == 0 || slice == static_cast<std::int32_t>(frame_.slices.size())) return;
        if (point.squaredNorm() > reach_m_ * reach_m_) return;
        const auto [w_low, w_high] = std::minmax({c[0].w, c[1].w, c[2].w});
        out_.between.push_back(
            {slice, mesh_.facets[facet].piece, {c[0].u, c[2].u}, {w_low, w_high}});
    }

    /// Enters a facet that some slice meets; false when it is seen edge-on.
    bool see(std::uint32_t facet, const Eigen::Vector3f& point, const std::array<Corner, 3>& c) {
        const Eigen::Vector3f normal = R_frame_local_ * mesh_.facets[facet].normal;
        const float height = -normal.dot(point);
        if (std::fabs(height) > reach_m_) return false;
        if (!(std::fabs(height) > edge_on_share * point.norm())) {
            ++out_.dropped;
            return false;
        }
        const float side = height < 0.0F ? -1.0F : 1.0F;
        out_.facets.push_back({side * normal, side * height, facet, range_of(c, side * height)});
        out_.met[mesh_.facets[facet].piece] = true;
        return true;
    }

    /// Between its corners a triangle lies nearer by the sag of its longest edge, L^2 / 8 r, and
    /// no nearer than its plane.
    static Extent range_of(const std::array<Corner, 3>& c, float height) {
        const auto point = [&](int i) { return Eigen::Vector3f(c[i].X, c[i].U, c[i].W); };
        const auto [nearest, farthest] =
            std::minmax({point(0).norm(), point(1).norm(), point(2).norm()});
        const float edge2 =
            std::max({(point(0) - point(1)).squaredNorm(), (point(1) - point(2)).squaredNorm(),
                      (point(2) - point(0)).squaredNorm()});
        return {std::max(nearest - edge2 / (4.0F * nearest), height), farthest};
    }

    void add_trapezoid(const EdgeLine& low, const EdgeLine& high, std::int32_t first,
                       std::int32_t end, Extent whole) {
        scratch_.first.push_back(first);
        out_.trapezoids.push_back({{low.w, high.w, low.q, high.q},
                                   {low.w_slope, high.w_slope, low.q_slope, high.q_slope},
                                   {low.anchor, high.anchor, low.anchor, high.anchor},
                                   low.extent,
                                   high.extent,
                                   whole,
                                   static_cast<std::uint32_t>(out_.facets.size() - 1),
                                   end});
    }

    void sort_by_slice() {
        const std::size_t slices = frame_.slices.size();
        out_.begin.assign(slices + 2, 0);
        for (const std::int32_t first : scratch_.first)
            ++out_.begin[first + 2];
        for (std::size_t s = 2; s < slices + 2; ++s)
            out_.begin[s] += out_.begin[s - 1];
        out_.order.resize(scratch_.first.size());
        for (std::uint32_t i = 0; i < scratch_.first.size(); ++i)
            out_.order[out_.begin[scratch_.first[i] + 1]++] = i;
        out_.begin.pop_back();
    }

    const ClusterMesh& mesh_;
    const std::span<const Eigen::Vector3f> vertices_;
    const SliceFrame& frame_;
    const Eigen::Matrix3f R_frame_local_;
    const Eigen::Vector3f position_;
    const float reach_m_;
    const float nearest_m_;
    const float u_low_;
    const float u_high_;
    SetupScratch& scratch_;
    const SliceFinder find_slice_;
    SliceScene& out_;
};

}  // namespace

void SliceScene::clear() {
    facets.clear();
    trapezoids.clear();
    order.clear();
    begin.clear();
    between.clear();
    dropped = 0;
}

void set_up_slices(const ClusterMesh& mesh, std::span<const Eigen::Vector3f> vertices,
                   const SliceFrame& frame, const LocalPose& pose, float range_max_m,
                   SetupScratch& scratch, SliceScene& out) {
    scratch.first.clear();
    out.clear();
    out.met.assign(mesh.pieces, false);
    Setup(mesh, vertices, frame, pose, range_max_m, scratch, out).run();
}

}  // namespace sonarsim
