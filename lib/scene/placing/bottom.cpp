#include "scene/placing/bottom.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sonarsim {

namespace {

constexpr int most_cells = 1024;  // along x, and along y

// More than one, since most triangles are often those of small things that cover few of the cells.
constexpr double cells_per_triangle = 8.0;

std::array<Eigen::Vector3d, 3> corners_of(const Surface& surface, std::uint32_t triangle) {
    const auto& c = surface.triangles[triangle];
    return {surface.vertices[c[0]], surface.vertices[c[1]], surface.vertices[c[2]]};
}

/// Whether a point lies within the box around a triangle, seen from above: told from the corners at
/// less cost than a height.
bool is_near(const Surface& surface, std::uint32_t triangle, const Eigen::Vector2d& point) {
    const auto& c = surface.triangles[triangle];
    const Eigen::Vector2d a = surface.vertices[c[0]].head<2>();
    const Eigen::Vector2d b = surface.vertices[c[1]].head<2>();
    const Eigen::Vector2d d = surface.vertices[c[2]].head<2>();
    return (a.cwiseMin(b).cwiseMin(d).array() <= point.array()).all() &&
           (a.cwiseMax(b).cwiseMax(d).array() >= point.array()).all();
}

Eigen::AlignedBox2d area_of(const Surface& surface, std::uint32_t triangle) {
    Eigen::AlignedBox2d box;
    for (const std::uint32_t vertex : surface.triangles[triangle])
        box.extend(surface.vertices[vertex].head<2>());
    return box;
}

}  // namespace

Bottom::Bottom(Surface surface) : surface_(std::move(surface)) {
    for (const Eigen::Vector3d& vertex : surface_.vertices)
        area_.extend(vertex.head<2>());
    const auto count = static_cast<std::uint32_t>(surface_.triangles.size());
    side_ = std::clamp(static_cast<int>(std::sqrt(cells_per_triangle * count)), 1, most_cells);
    // Counted first, then filled in.
    std::vector<std::uint32_t> size(static_cast<std::size_t>(side_) * side_ + 1, 0);
    const auto for_each_cell = [&](std::uint32_t triangle, const auto& visit) {
        const Eigen::AlignedBox2d box = area_of(surface_, triangle);
        const Eigen::Array2i from = cell_of(box.min());
        const Eigen::Array2i to = cell_of(box.max());
        for (int y = from.y(); y <= to.y(); ++y) {
            for (int x = from.x(); x <= to.x(); ++x)
                visit(static_cast<std::size_t>(y) * side_ + x);
        }
    };
    for (std::uint32_t t = 0; t < count; ++t)
        for_each_cell(t, [&](std::size_t cell) { ++size[cell + 1]; });
    for (std::size_t cell = 1; cell < size.size(); ++cell)
        size[cell] += size[cell - 1];
    begin_ = size;
    triangles_.resize(size.back());
    for (std::uint32_t t = 0; t < count; ++t)
        for_each_cell(t, [&](std::size_t cell) { triangles_[size[cell]++] = t; });
}

Eigen::Array2i Bottom::cell_of(const Eigen::Vector2d& point) const {
    if (area_.isEmpty()) return {0, 0};
    const Eigen::Array2d size = area_.sizes().array().max(1e-9);
    const Eigen::Array2d cell = ((point - area_.min()).array() / size * side_).floor();
    return cell.max(0.0).min(side_ - 1.0).cast<int>();
}

std::optional<Bottom::Heights> Bottom::heights(const Eigen::Vector2d& point) const {
    std::optional<Heights> found;
    for_each_near({point, point}, [&](std::uint32_t triangle) {
        const auto z = height_above(corners_of(surface_, triangle), point);
        if (!z) return;
        if (!found) found = {*z, *z};
        found->lowest = std::min(found->lowest, *z);
        found->highest = std::max(found->highest, *z);
    });
    return found;
}

std::optional<double> Bottom::highest_below(const Eigen::Vector3d& point, double tolerance) const {
    const Eigen::Vector2d at = point.head<2>();
    std::optional<double> found;
    for_each_near({at, at}, [&](std::uint32_t triangle) {
        if (!is_near(surface_, triangle, at)) return;
        const auto z = height_above(corners_of(surface_, triangle), at);
        if (z && *z <= point.z() + tolerance && (!found || *z > *found)) found = z;
    });
    return found;
}

std::optional<double> height_above(const std::array<Eigen::Vector3d, 3>& corners,
                                   const Eigen::Vector2d& point) {
    // Relative to the point, so that large coordinates lose nothing.
    const auto at = [&](int k) -> Eigen::Vector2d { return corners[k].head<2>() - point; };
    const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
        return a.x() * b.y() - a.y() * b.x();
    };
    const Eigen::Vector2d a = at(0);
    const Eigen::Vector2d b = at(1);
    const Eigen::Vector2d c = at(2);
    const double of_a = cross(b, c);
    const double of_b = cross(c, a);
    const double of_c = cross(a, b);
    const bool inside =
        (of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0) || (of_a <= 0.0 && of_b <= 0.0 && of_c <= 0.0);
    const double sum = of_a + of_b + of_c;
    if (!inside || sum == 0.0) return std::nullopt;
    return (of_a * corners[0].z() + of_b * corners[1].z() + of_c * corners[2].z()) / sum;
}

}  // namespace sonarsim
