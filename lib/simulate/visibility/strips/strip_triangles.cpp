#include "simulate/visibility/strips/strip_triangles.h"

#include <array>
#include <utility>

namespace sonarsim {

namespace {

using Eigen::Vector3f;

// Surface nearer than this share of the range, along the forward axis of a frame, is ignored.
constexpr float nearest_share = 1e-5F;

// Triangles that come nearer than this share of the range, or extend farther aside than this many
// times their distance, are clipped to the view: far outside it, u and w lose their digits.
constexpr float clipped_share = 1e-3F;
constexpr float clipped_aside = 8.0F;
constexpr float clip_margin = 0.02F;  // in u and w

// A plane nearer to the sensor than this share of the triangle's distance is edge-on by rounding.
constexpr float edge_on_share = 1e-7F;

// A thin triangle is at least this many columns long.
constexpr float thin_columns = 3.0F;

// Corners as near as this in u have the same u.
constexpr float same_u = 1e-8F;

/// The columns of a frame by u.
class ColumnFinder {
  public:
    explicit ColumnFinder(const std::vector<float>& borders) : borders_(borders) {
        const auto steps = 4 * borders.size();
        per_u_ = static_cast<float>(steps) / (borders.back() - borders.front());
        int column = 0;
        for (std::size_t k = 0; k <= steps; ++k) {
            const float u = borders.front() + static_cast<float>(k) / per_u_;
            while (column < last() && borders[column + 1] <= u)
                ++column;
            table_.push_back(column);
        }
    }

    /// The column whose half-open interval holds u, or the nearest one.
    int operator()(float u) const {
        const float last_entry = static_cast<float>(table_.size() - 1);
        int column =
            table_[static_cast<int>(std::clamp((u - borders_.front()) * per_u_, 0.0F, last_entry))];
        while (column > 0 && borders_[column] > u)
            --column;
        while (column < last() && borders_[column + 1] <= u)
            ++column;
        return column;
    }

    int last() const { return static_cast<int>(borders_.size()) - 2; }

  private:
    const std::vector<float>& borders_;
    std::vector<int> table_;
    float per_u_;
};

class TriangleProjection {
  public:
    TriangleProjection(const ClustersInView& clusters, const ColumnFrame& frame, float range_max_m,
                       StripTriangles& out)
        : clusters_(clusters),
          frame_(frame),
          R_frame_local_(frame.R_frame_sensor * clusters.pose.rotation.transpose()),
          position_(clusters.pose.position),
          reach_m_(range_max_m),
          u_low_(frame.u_low),
          u_high_(frame.u_high),
          reach_w_(frame.reach_w(u_low_, u_high_)),
          column_width_(frame.column_width()),
          out_(out) {}

    void run() {
        struct Distance {
            float m;
            std::uint32_t cluster;  ///< the numbers of bodies and copies follow
            // NOLINTNEXTLINE(modernize-use-nullptr): no pointer
            auto operator<=>(const Distance&) const = default;
        };
        const auto own = static_cast<std::uint32_t>(clusters_.own.clusters.size());
        std::vector<Distance> in_view;
        const auto find = [&](const TriangleCluster& cluster, std::uint32_t number) {
            const Vector3f centre = in_frame(cluster.centre);
            if (sees(centre, cluster.radius_m))
                in_view.push_back({centre.norm() - cluster.radius_m, number});
        };
        for (const std::uint32_t k : clusters_.own_clusters)
            find(clusters_.own.clusters[k], k);
        for (std::uint32_t k = 0; k < clusters_.placed.clusters.size(); ++k)
            find(clusters_.placed.clusters[k], own + k);
        std::ranges::sort(in_view);
        const auto own_facets = static_cast<std::uint32_t>(clusters_.own.facets.size());
        for (const auto& [m, number] : in_view) {
            if (number < own)
                add_cluster(clusters_.own, clusters_.own.clusters[number], 0);
            else
                add_cluster(clusters_.placed, clusters_.placed.clusters[number - own], own_facets);
        }
        if (picture_ > 0.0F) out_.thinness = thin_ / picture_;
    }

  private:
    Vector3f in_frame(const Vector3f& point) const { return R_frame_local_ * (point - position_); }

    bool sees(const Vector3f& c, float radius) const {
        const float reach = reach_m_ + radius;
        if (c.squaredNorm() > reach * reach || c.x() + radius < nearest_share * reach_m_)
            return false;
        // Distance from a plane through the sensor: x + s X < 0 outside, with the normal (s, 1).
        const auto beyond = [&](float x, float s) {
            return x + s * c.x() < -radius * std::sqrt(1.0F + s * s);
        };
        return !(beyond(c.y(), -u_low_) || beyond(-c.y(), u_high_) || beyond(c.z(), reach_w_) ||
                 beyond(-c.z(), reach_w_));
    }

    void add_cluster(const ClusterMesh& mesh, const TriangleCluster& cluster,
                     std::uint32_t first_facet) {
        std::array<Vector3f, std::size_t{3} * ClusterMesh::max_triangles> points;
        for (std::uint32_t i = 0; i < cluster.vertices; ++i)
            points[i] = in_frame(mesh.vertices[cluster.first_vertex + i]);
        for (std::uint32_t i = 0; i < cluster.triangles; ++i) {
            const std::uint32_t triangle = cluster.first_triangle + i;
            const auto& [a, b, c] = mesh.corners[triangle];
            add_facet({points[a], points[b], points[c]}, first_facet + triangle);
        }
    }

    void add_facet(const std::array<Vector3f, 3>& p, std::uint32_t facet) {
        const float nearest = std::min({p[0].x(), p[1].x(), p[2].x()});
        const float farthest = std::max({p[0].x(), p[1].x(), p[2].x()});
        if (farthest <= 0.0F || nearest > reach_m_) return;
        float aside = 0.0F;
        for (const Vector3f& corner : p)
            aside = std::max({aside, std::fabs(corner.y()), std::fabs(corner.z())});
        if (nearest <= clipped_share * reach_m_ || aside > clipped_aside * nearest)
            add_clipped(p, facet);
        else
            add(p, facet, false);
    }

    /// Adds the part of a triangle in front of the near plane and in the view with a margin.
    void add_clipped(const std::array<Vector3f, 3>& triangle, std::uint32_t facet) {
        std::array<Vector3f, 8> corners{triangle[0], triangle[1], triangle[2]};
        int count = 3;
        const auto clip = [&](const Vector3f& normal, float offset) {
            std::array<Vector3f, 8> kept;
            int left = 0;
            for (int i = 0; i < count; ++i) {
                const Vector3f& a = corners[i];
                const Vector3f& b = corners[(i + 1) % count];
                const float at_a = normal.dot(a) - offset;
                const float at_b = normal.dot(b) - offset;
                if (at_a >= 0.0F) kept[left++] = a;
                if ((at_a >= 0.0F) != (at_b >= 0.0F))
                    kept[left++] = a + at_a / (at_a - at_b) * (b - a);
            }
            count = left;
            corners = kept;
        };
        const float w = reach_w_ * (1.0F + clip_margin) + clip_margin;
        clip({1.0F, 0.0F, 0.0F}, nearest_share * reach_m_);
        clip({clip_margin - u_low_, 1.0F, 0.0F}, 0.0F);
        clip({u_high_ + clip_margin, -1.0F, 0.0F}, 0.0F);
        clip({w, 0.0F, 1.0F}, 0.0F);
        clip({w, 0.0F, -1.0F}, 0.0F);
        for (int i = 2; i < count; ++i)
            add({corners[0], corners[i - 1], corners[i]}, facet, true);
    }

    void add(const std::array<Vector3f, 3>& p, std::uint32_t facet, bool clipped) {
        const ClusterFacet& data = clusters_.facet(facet);
        const Vector3f normal = R_frame_local_ * data.normal;
        const float d = normal.dot(p[0]);
        const float outward = clusters_.outward(facet);
        if (outward * d > 0.0F) return;
        std::array<float, 3> u, w, q;
        for (int k = 0; k < 3; ++k) {
            q[k] = 1.0F / p[k].x();
            u[k] = p[k].y() * q[k];
            w[k] = p[k].z() * q[k];
        }
        int first = 0;
        int middle = 1;
        int last = 2;
        if (u[middle] < u[first]) std::swap(first, middle);
        if (u[last] < u[middle]) std::swap(middle, last);
        if (u[middle] < u[first]) std::swap(first, middle);
        StripTriangle t;
        t.u0 = u[first];
        t.u1 = u[middle];
        t.u2 = u[last];
        if (!(t.u0 < u_high_ && t.u2 > u_low_ && t.u2 - t.u0 > same_u)) return;
        t.w_min = std::min({w[0], w[1], w[2]});
        t.w_max = std::max({w[0], w[1], w[2]});
        const float reach = frame_.reach_w(std::max(t.u0, u_low_), std::min(t.u2, u_high_));
        if (t.w_min >= reach || t.w_max <= -reach) return;
        t.height_m = std::fabs(d);
        if (t.height_m > reach_m_) return;
        if (!(t.height_m > edge_on_share * p[0].norm())) {
            ++out_.dropped;
            return;
        }
        t.side = d < 0.0F ? 1.0F : -1.0F;
        t.q_u = normal.y() / d;
        t.q_w = normal.z() / d;
        t.q0 = q[first];
        t.q_min = std::min({q[0], q[1], q[2]});
        t.q_max = std::max({q[0], q[1], q[2]});
        t.w0 = w[first];
        t.w1 = w[middle];
        t.long_slope = (w[last] - w[first]) / (t.u2 - t.u0);
        t.no_first = !(t.u1 - t.u0 > same_u);
        t.no_second = !(t.u2 - t.u1 > same_u);
        t.first_slope = t.no_first ? 0.0F : (w[middle] - w[first]) / (t.u1 - t.u0);
        t.second_slope = t.no_second ? 0.0F : (w[last] - w[middle]) / (t.u2 - t.u1);
        const float rise = t.w1 - t.w0 - t.long_slope * (t.u1 - t.u0);
        t.middle_above = rise > 0.0F;
        const float picture = 0.5F * (t.u2 - t.u0) * std::fabs(rise);
        t.facet = facet;
        t.number = data.number;
        out_.items.push_back(t);
        if (clipped) return;
        const float upright = t.w_max - t.w_min;
        const float length = std::max(upright, t.u2 - t.u0);
        // Ground far above or below the boresight counts little: a picture stretches there.
        const float mean_w = 0.5F * (t.w_min + t.w_max);
        const float secant2 = 1.0F + mean_w * mean_w;
        // The far side of a solid counts, too.
        const float weight = (outward == 0.0F ? 1.0F : 2.0F) / (secant2 * secant2);
        picture_ += weight * picture;
        if (2.0F * picture < column_width_ * length && length > thin_columns * column_width_)
            thin_ += weight * column_width_ * upright;
    }

    const ClustersInView& clusters_;
    const ColumnFrame& frame_;
    const Eigen::Matrix3f R_frame_local_;
    const Vector3f position_;
    const float reach_m_, u_low_, u_high_, reach_w_, column_width_;
    StripTriangles& out_;
    float thin_ = 0.0F;
    float picture_ = 0.0F;
};

}  // namespace

StripTriangles strip_triangles(const ClustersInView& clusters, const ColumnFrame& frame,
                               float range_max_m) {
    StripTriangles out;
    TriangleProjection(clusters, frame, range_max_m, out).run();
    return out;
}

Groups triangles_by_column(const std::vector<StripTriangle>& triangles,
                           const std::vector<float>& borders) {
    struct Columns {
        int first, last;
    };
    const ColumnFinder column_at(borders);
    std::vector<Columns> columns;
    columns.reserve(triangles.size());
    Groups out;
    out.begin.assign(borders.size(), 0);
    for (const StripTriangle& t : triangles) {
        const int first = column_at(t.u0);
        int last = column_at(t.u2);
        if (last > first && borders[last] >= t.u2) --last;
        columns.push_back({first, last});
        for (int c = first; c <= last; ++c)
            ++out.begin[c + 1];
    }
    for (std::size_t c = 1; c < out.begin.size(); ++c)
        out.begin[c] += out.begin[c - 1];
    out.items.resize(out.begin.back());
    std::vector<std::uint32_t> next(out.begin.begin(), out.begin.end() - 1);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (int c = columns[i].first; c <= columns[i].last; ++c)
            out.items[next[c]++] = i;
    }
    return out;
}

}  // namespace sonarsim
