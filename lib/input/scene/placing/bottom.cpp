#include "input/scene/placing/bottom.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace sonarsim {

namespace {

constexpr int max_cells = 1024;  // limit along x and along y

// More than one cell, since most triangles often belong to small objects that cover few cells.
constexpr double cells_per_triangle = 8.0;

// Large triangles lie in many cells. So many numbers of triangles take 1 GB.
constexpr std::uint64_t max_places = std::uint64_t{1} << 28;

Eigen::AlignedBox2d area_of(const Surface& surface, std::uint32_t triangle) {
    return box_from_above(corners_of(surface, triangle));
}

/// height_above() without std::optional, which compilers pass through memory. False: none.
[[gnu::always_inline]] inline bool find_height(const Eigen::Vector3d& corner_a,
                                               const Eigen::Vector3d& corner_b,
                                               const Eigen::Vector3d& corner_c,
                                               const Eigen::Vector2d& point, double& z) {
    // Coordinates are relative to the point, so that large ones lose nothing.
    const double a_x = corner_a.x() - point.x(), a_y = corner_a.y() - point.y();
    const double b_x = corner_b.x() - point.x(), b_y = corner_b.y() - point.y();
    const double c_x = corner_c.x() - point.x(), c_y = corner_c.y() - point.y();
    const double weight_a = b_x * c_y - b_y * c_x;
    const double weight_b = c_x * a_y - c_y * a_x;
    const double weight_c = a_x * b_y - a_y * b_x;
    const bool inside = (weight_a >= 0.0 && weight_b >= 0.0 && weight_c >= 0.0) ||
                        (weight_a <= 0.0 && weight_b <= 0.0 && weight_c <= 0.0);
    const double sum = weight_a + weight_b + weight_c;
    if (!inside || sum == 0.0) return false;
    z = (weight_a * corner_a.z() + weight_b * corner_b.z() + weight_c * corner_c.z()) / sum;
    return true;
}

}  // namespace

Bottom::Bottom(Surface surface) : surface_(std::move(surface)) {
    const Eigen::AlignedBox3d all = box_of(surface_);
    area_ = box_from_above(surface_.vertices);
    const auto count = static_cast<std::uint32_t>(surface_.triangles.size());
    side_ = std::clamp(static_cast<int>(std::sqrt(cells_per_triangle * count)), 1, max_cells);
    while (side_ > 1 && places_of_triangles() > max_places)
        side_ /= 2;
    // Count first, then fill.
    std::vector<std::uint32_t> size(static_cast<std::size_t>(side_) * side_ + 1, 0);
    for (std::uint32_t t = 0; t < count; ++t)
        for_each_cell(area_of(surface_, t), [&](std::size_t cell) { ++size[cell + 1]; });
    std::partial_sum(size.begin(), size.end(), size.begin());
    begin_ = size;
    triangles_.resize(size.back());
    if (count == 0) return;
    corner_ = all.min();
    const auto rounding = static_cast<float>(0x1p-20 * all.sizes().maxCoeff());
    for (const auto& triangle : surface_.triangles) {
        Eigen::AlignedBox3f& box = boxes_.emplace_back();
        for (const std::uint32_t vertex : triangle)
            box.extend((surface_.vertices[vertex] - corner_).cast<float>());
        box = {(box.min().array() - rounding).matrix(), (box.max().array() + rounding).matrix()};
    }
    std::vector<std::uint32_t> downwards(count);
    std::iota(downwards.begin(), downwards.end(), 0U);
    std::ranges::stable_sort(downwards, std::greater{},
                             [&](std::uint32_t t) { return boxes_[t].max().z(); });
    for (const std::uint32_t t : downwards)
        for_each_cell(area_of(surface_, t),
                      [&](std::size_t cell) { triangles_[size[cell]++] = t; });
}

std::uint64_t Bottom::places_of_triangles() const {
    std::uint64_t places = 0;
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
        const Eigen::AlignedBox2d box = area_of(surface_, t);
        const Eigen::Array2i cells = cell_of(box.max()) - cell_of(box.min()) + 1;
        places += static_cast<std::uint64_t>(cells.x()) * static_cast<std::uint64_t>(cells.y());
    }
    return places;
}

Eigen::Array2i Bottom::cell_of(const Eigen::Vector2d& point) const {
    if (area_.isEmpty()) return {0, 0};
    const Eigen::Array2d size = area_.sizes().array().max(1e-9);
    const Eigen::Array2d cell = ((point - area_.min()).array() / size * side_).floor();
    return cell.max(0.0).min(side_ - 1.0).cast<int>();
}

std::optional<double> Bottom::highest_below(const Eigen::Vector3d& point, double tolerance) const {
    const Eigen::Vector2d at = point.head<2>();
    const double top = point.z() + tolerance;
    constexpr double none = -std::numeric_limits<double>::infinity();
    double found = none;
    const Eigen::Array3f from = (Eigen::Vector3d(at.x(), at.y(), top) - corner_).cast<float>();
    const Eigen::Array2i place = cell_of(at);
    const auto cell = static_cast<std::size_t>(place.y()) * side_ + place.x();
    float found_z = -std::numeric_limits<float>::infinity();
    for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k) {
        const Eigen::AlignedBox3f& box = boxes_[triangles_[k]];
        if (box.max().z() < found_z) break;
        if (box.min().z() > from.z() || box.min().x() > from.x() || box.max().x() < from.x() ||
            box.min().y() > from.y() || box.max().y() < from.y())
            continue;
        const auto& [a, b, c] = surface_.triangles[triangles_[k]];
        double z = none;
        find_height(surface_.vertices[a], surface_.vertices[b], surface_.vertices[c], at, z);
        if (z > top || !(z > found)) continue;
        found = z;
        found_z = static_cast<float>(z - corner_.z());
    }
    return found > none ? std::optional(found) : std::nullopt;
}

std::optional<double> height_above(const std::array<Eigen::Vector3d, 3>& corners,
                                   const Eigen::Vector2d& point) {
    double z = 0.0;
    if (!find_height(corners[0], corners[1], corners[2], point, z)) return std::nullopt;
    return z;
}

}  // namespace sonarsim
