#include "input/scene/placing/rest.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sonarsim {

namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

/// Height of the second edge above the first where they cross from above; else minus infinity.
double rise_at_crossing(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
    constexpr double none = -std::numeric_limits<double>::infinity();
    const Eigen::Vector2d u = (b - a).head<2>();
    const Eigen::Vector2d v = (d - c).head<2>();
    const Eigen::Vector2d w = (c - a).head<2>();
    const double det = u.x() * v.y() - u.y() * v.x();
    if (det == 0.0) return none;  // parallel edges meet at a vertex of one of them
    const double s = (w.x() * v.y() - w.y() * v.x()) / det;
    const double t = (w.x() * u.y() - w.y() * u.x()) / det;
    if (!(s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)) return none;
    return (c.z() + t * (d.z() - c.z())) - (a.z() + s * (b.z() - a.z()));
}

/// The greatest height of the bottom's triangle above the object's.
double rise_of(const Corners& object, const Corners& ground) {
    double rise = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (const auto z = height_above(object, ground[i].head<2>()))
            rise = std::max(rise, ground[i].z() - *z);
        for (int k = 0; k < 3; ++k) {
            rise = std::max(rise, rise_at_crossing(object[i], object[(i + 1) % 3], ground[k],
                                                   ground[(k + 1) % 3]));
        }
    }
    return rise;
}

/// Height of the highest corner of the bottom's triangles near an object, seen from above.
double top_near(const Bottom& bottom, const Surface& object) {
    double highest = -std::numeric_limits<double>::infinity();
    if (object.vertices.empty()) return highest;
    bottom.for_each_near(box_from_above(object.vertices), [&](std::uint32_t near) {
        for (const Eigen::Vector3d& corner : corners_of(bottom.surface(), near))
            highest = std::max(highest, corner.z());
    });
    return highest;
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double distance_to_edge(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
    const Eigen::Vector2d along = b - a;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
    return (p - a - t * along).norm();
}

/// True if a line along an edge of `a` separates `a` from `b`.
bool has_gap(const Hull& a, const Hull& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Eigen::Vector2d& from = a[i];
        const Eigen::Vector2d& to = a[(i + 1) % a.size()];
        if (from == to) continue;
        if (std::ranges::all_of(b,
                                [&](const Eigen::Vector2d& p) { return turn(from, to, p) < 0.0; }))
            return true;
    }
    return false;
}

double min_distance(const Hull& corners, const Hull& edges) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& p : corners) {
        for (std::size_t i = 0; i < edges.size(); ++i)
            nearest =
                std::min(nearest, distance_to_edge(p, edges[i], edges[(i + 1) % edges.size()]));
    }
    return nearest;
}

}  // namespace

std::optional<double> lift_to_rest(const Bottom& bottom, const Surface& object) {
    double lift = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& vertex : object.vertices) {
        const auto highest = bottom.highest(vertex.head<2>());
        if (!highest) return std::nullopt;
        lift = std::max(lift, *highest - vertex.z());
    }
    const double ground_top = top_near(bottom, object);
    for (std::size_t t = 0; t < object.triangles.size(); ++t) {
        const Corners own = corners_of(object, t);
        const double lowest = std::min({own[0].z(), own[1].z(), own[2].z()});
        if (ground_top - lowest <= lift) continue;
        const Eigen::AlignedBox2d box = box_from_above(own);
        bottom.for_each_near(box, [&](std::uint32_t near) {
            const Corners ground = corners_of(bottom.surface(), near);
            // Quick test first: most of an object is too high to touch.
            const double highest = std::max({ground[0].z(), ground[1].z(), ground[2].z()});
            if (highest - lowest <= lift) return;
            if (!box.intersects(box_from_above(ground))) return;
            lift = std::max(lift, rise_of(own, ground));
        });
    }
    return object.vertices.empty() ? std::nullopt : std::optional(lift);
}

bool lies_below(const Bottom& bottom, const Surface& object) {
    return !object.vertices.empty() &&
           std::ranges::all_of(object.vertices, [&](const Eigen::Vector3d& vertex) {
               return bottom.highest(vertex.head<2>()) && !bottom.highest_below(vertex, 0.0);
           });
}

Eigen::Quaterniond slope_of(const Bottom& bottom, const Eigen::AlignedBox2d& box) {
    constexpr int steps = 4;
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i <= steps; ++i) {
        for (int k = 0; k <= steps; ++k) {
            const Eigen::Vector2d share(static_cast<double>(i) / steps,
                                        static_cast<double>(k) / steps);
            const Eigen::Vector2d offset = share.cwiseProduct(box.sizes()) - 0.5 * box.sizes();
            if (const auto highest = bottom.highest(box.center() + offset))
                points.emplace_back(offset.x(), offset.y(), *highest);
        }
    }
    if (points.size() < 3) return Eigen::Quaterniond::Identity();
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points)
        mean += p / static_cast<double>(points.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    Eigen::Vector2d height_covariance = Eigen::Vector2d::Zero();
    for (const Eigen::Vector3d& p : points) {
        const Eigen::Vector2d off = (p - mean).head<2>();
        spread += off * off.transpose();
        height_covariance += off * (p.z() - mean.z());
    }
    if (!(spread.determinant() > 0.0)) return Eigen::Quaterniond::Identity();
    const Eigen::Vector2d slope = spread.inverse() * height_covariance;
    const Eigen::Vector3d normal = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
    return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
}

Hull hull_of(std::span<const Eigen::Vector3d> points) {
    Hull sorted;
    for (const Eigen::Vector3d& point : points)
        sorted.emplace_back(point.head<2>());
    const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    };
    std::sort(sorted.begin(), sorted.end(), before);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 3) return sorted;
    // Andrew's monotone chain: the lower side, then the upper one backwards.
    Hull hull;
    const auto add_chain = [&](auto first, auto last) {
        const std::size_t start = hull.size();
        for (auto p = first; p != last; ++p) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0.0)
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();
    };
    add_chain(sorted.begin(), sorted.end());
    add_chain(sorted.rbegin(), sorted.rend());
    return hull;
}

Eigen::AlignedBox2d box_of(const Hull& hull) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : hull)
        box.extend(corner);
    return box;
}

double area_of(const Hull& hull) {
    double twice = 0.0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Eigen::Vector2d& a = hull[i];
        const Eigen::Vector2d& b = hull[(i + 1) % hull.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * std::abs(twice);
}

double distance_between(const Hull& a, const Hull& b, double max_m) {
    constexpr double far = std::numeric_limits<double>::infinity();
    if (a.empty() || b.empty()) return far;
    // The margin exceeds the rounding of the distance.
    const Eigen::AlignedBox2d box = box_of(a);
    const double near = 1.001 * max_m + 1e-6 * (1.0 + box.max().cwiseAbs().maxCoeff() +
                                                box.min().cwiseAbs().maxCoeff());
    if (box.squaredExteriorDistance(box_of(b)) > near * near) return far;
    // Convex polygons are disjoint if and only if an edge of one of them separates them.
    if (!has_gap(a, b) && !has_gap(b, a)) return 0.0;
    return std::min(min_distance(a, b), min_distance(b, a));
}

}  // namespace sonarsim
