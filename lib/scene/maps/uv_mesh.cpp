#include "scene/maps/uv_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hash.h"

namespace sonarsim {

namespace {

constexpr double most_cells = 128.0;  // along an axis

/// Calls use(cell) for the cells of a box.
template <class Use>
void for_each_cell(const Eigen::Array3i& from, const Eigen::Array3i& to, const Use& use) {
    for (int z = from.z(); z <= to.z(); ++z) {
        for (int y = from.y(); y <= to.y(); ++y) {
            for (int x = from.x(); x <= to.x(); ++x)
                use(Eigen::Array3i(x, y, z));
        }
    }
}

}  // namespace

UvMesh::UvMesh(const std::vector<UvTriangle>& triangles) {
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(triangles.size());
    facets_.reserve(triangles.size());
    double area_m2 = 0.0;
    for (const UvTriangle& triangle : triangles) {
        const auto& [a, b, c] = triangle.corners;
        Eigen::Matrix<double, 3, 2> sides;
        sides << b - a, c - a;
        const Eigen::Vector3d normal = sides.col(0).cross(sides.col(1));
        if (!(normal.squaredNorm() > 0.0) || !normal.allFinite()) continue;
        const Eigen::Matrix2d squares = sides.transpose() * sides;
        Facet& facet = facets_.emplace_back();
        facet.corner = a;
        facet.normal = normal.normalized();
        facet.across = squares.inverse() * sides.transpose();
        Eigen::Matrix2d uv_sides;
        uv_sides << triangle.uv[1] - triangle.uv[0], triangle.uv[2] - triangle.uv[0];
        facet.uv = triangle.uv[0];
        facet.uv_per_m = uv_sides * facet.across;
        facet.length_m = std::sqrt(std::max(squares(0, 0), squares(1, 1)));
        facet.instance = triangle.instance;
        facet.image = triangle.image;
        area_m2 += 0.5 * normal.norm();
        Eigen::AlignedBox3d& box = boxes.emplace_back(a);
        box.extend(b);
        box.extend(c);
        box_.extend(box);
    }
    if (facets_.empty()) return;
    // A cell is about as wide as a triangle of mean size.
    const double cell_m = std::sqrt(area_m2 / static_cast<double>(facets_.size()));
    cells_ = (box_.sizes().array() / cell_m).ceil().max(1.0).min(most_cells).cast<int>();
    const auto cells = static_cast<std::size_t>(cells_.x()) * static_cast<std::size_t>(cells_.y()) *
                       static_cast<std::size_t>(cells_.z());
    begin_.assign(cells + 1, 0);
    for (const Eigen::AlignedBox3d& box : boxes) {
        for_each_cell(cell_of(box.min()), cell_of(box.max()),
                      [&](const Eigen::Array3i& cell) { ++begin_[index_of(cell) + 1]; });
    }
    for (std::size_t k = 1; k < begin_.size(); ++k)
        begin_[k] += begin_[k - 1];
    items_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        for_each_cell(cell_of(boxes[i].min()), cell_of(boxes[i].max()),
                      [&](const Eigen::Array3i& cell) { items_[next[index_of(cell)]++] = i; });
    }
}

Eigen::Array3i UvMesh::cell_of(const Eigen::Vector3d& point) const {
    const Eigen::Array3d size = box_.sizes().array().max(1e-9);
    const Eigen::Array3d cell =
        ((point - box_.min()).array() / size * cells_.cast<double>()).floor();
    return cell.max(0.0).min(cells_.cast<double>() - 1.0).cast<int>();
}

std::size_t UvMesh::index_of(const Eigen::Array3i& cell) const {
    const auto x = static_cast<std::size_t>(cell.x());
    const auto y = static_cast<std::size_t>(cell.y());
    const auto z = static_cast<std::size_t>(cell.z());
    return (z * static_cast<std::size_t>(cells_.y()) + y) * static_cast<std::size_t>(cells_.x()) +
           x;
}

std::optional<UvPoint> UvMesh::at(std::uint32_t instance, const Eigen::Vector3d& point) const {
    if (facets_.empty()) return std::nullopt;
    const Facet* nearest = nullptr;
    double least_m = std::numeric_limits<double>::infinity();
    const auto look_at = [&](const Eigen::Array3i& cell) {
        const std::size_t k = index_of(cell);
        for (std::uint32_t n = begin_[k]; n < begin_[k + 1]; ++n) {
            const Facet& facet = facets_[items_[n]];
            if (facet.instance != instance) continue;
            const Eigen::Vector3d d = point - facet.corner;
            const Eigen::Vector2d share = facet.across * d;
            const double outside =
                std::max({0.0, -share.x(), -share.y(), share.x() + share.y() - 1.0});
            const double away_m = std::fabs(facet.normal.dot(d)) + outside * facet.length_m;
            if (!(away_m < least_m)) continue;
            least_m = away_m;
            nearest = &facet;
        }
    };
    const Eigen::Array3i here = cell_of(point);
    look_at(here);
    // A point that lies on no triangle of its cell may lie just outside a triangle of a
    // neighbouring cell.
    const double cell_m = (box_.sizes().array() / cells_.cast<double>()).maxCoeff();
    if (!(least_m < 1e-6 * cell_m)) {
        for_each_cell((here - 1).max(0), (here + 1).min(cells_ - 1), look_at);
    }
    if (!nearest) return std::nullopt;
    const Eigen::Vector3d d = point - nearest->corner;
    const Eigen::Vector2d uv = nearest->uv + nearest->uv_per_m * d;
    if (!nearest->image.contains(uv)) return std::nullopt;
    return UvPoint{uv, nearest->uv_per_m};
}

std::string UvMesh::identity() const {
    std::vector<double> numbers;
    numbers.reserve(16 * facets_.size());
    for (const Facet& facet : facets_) {
        numbers.push_back(static_cast<double>(facet.instance));
        numbers.insert(numbers.end(), facet.corner.data(), facet.corner.data() + 3);
        numbers.insert(numbers.end(), facet.uv.data(), facet.uv.data() + 2);
        numbers.insert(numbers.end(), facet.uv_per_m.data(), facet.uv_per_m.data() + 6);
        for (const Eigen::Vector2d& corner : {facet.image.min(), facet.image.max()})
            numbers.insert(numbers.end(), corner.data(), corner.data() + 2);
    }
    return fnv1a_128(
        {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)});
}

}  // namespace sonarsim
