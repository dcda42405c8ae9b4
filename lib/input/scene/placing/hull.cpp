#include "input/scene/placing/hull.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

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
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& p : corners) {
        for (std::size_t i = 0; i < edges.size(); ++i)
            least = std::min(least, distance_to_edge(p, edges[i], edges[(i + 1) % edges.size()]));
    }
    return least;
}

}  // namespace

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

double distance_between(const Hull& a, const Hull& b, double most) {
    constexpr double far = std::numeric_limits<double>::infinity();
    if (a.empty() || b.empty()) return far;
    // The margin exceeds the rounding of the distance.
    const Eigen::AlignedBox2d box = box_of(a);
    const double near = 1.001 * most + 1e-6 * (1.0 + box.max().cwiseAbs().maxCoeff() +
                                               box.min().cwiseAbs().maxCoeff());
    if (box.squaredExteriorDistance(box_of(b)) > near * near) return far;
    // Convex polygons are disjoint if and only if an edge of one of them separates them.
    if (!has_gap(a, b) && !has_gap(b, a)) return 0.0;
    return std::min(min_distance(a, b), min_distance(b, a));
}

}  // namespace sonarsim
