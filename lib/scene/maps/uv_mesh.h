#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sonarsim {

/// A triangle with texture coordinates, world.
struct UvTriangle {
    std::array<Eigen::Vector3d, 3> corners;
    std::array<Eigen::Vector2d, 3> uv;  ///< (0, 0) is the image's north-west corner, v runs down
    std::uint32_t instance = 0;         ///< index into Scene::instances
    /// The part of the image that lies on the triangle. Points with coordinates outside it have no
    /// image.
    Eigen::AlignedBox2d image = everywhere();

    static Eigen::AlignedBox2d everywhere() {
        constexpr double far = std::numeric_limits<double>::infinity();
        return {Eigen::Vector2d(-far, -far), Eigen::Vector2d(far, far)};
    }
};

/// The texture coordinates near a point of a surface: uv + per_m (p - point).
struct UvPoint {
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    Eigen::Matrix<double, 2, 3> per_m = Eigen::Matrix<double, 2, 3>::Zero();
};

/// Finds the texture coordinates of points on triangles, with a grid over their box. Immutable.
class UvMesh {
  public:
    explicit UvMesh(const std::vector<UvTriangle>& triangles);

    /// The coordinates at the nearest point of an instance's triangles to `point`, world; nothing
    /// if the cells of the grid around the point hold no triangle of the instance, or if no image
    /// lies there.
    std::optional<UvPoint> at(std::uint32_t instance, const Eigen::Vector3d& point) const;

    /// Bytes that are different for different meshes.
    std::string identity() const;

  private:
    /// A triangle and the linear functions of points on it. A vector d from its first corner has
    /// the barycentric coordinates (1 - x - y, x, y), with (x, y) = across d.
    struct Facet {
        Eigen::Vector3d corner;
        Eigen::Vector3d normal;  ///< unit
        Eigen::Matrix<double, 2, 3> across;
        Eigen::Vector2d uv;
        Eigen::Matrix<double, 2, 3> uv_per_m;
        double length_m;  ///< longest of two sides
        std::uint32_t instance;
        Eigen::AlignedBox2d image;
    };

    Eigen::Array3i cell_of(const Eigen::Vector3d& point) const;
    std::size_t index_of(const Eigen::Array3i& cell) const;

    std::vector<Facet> facets_;
    Eigen::AlignedBox3d box_;
    Eigen::Array3i cells_ = Eigen::Array3i::Ones();
    std::vector<std::uint32_t> begin_;  ///< offsets into items_, by cell
    std::vector<std::uint32_t> items_;  ///< indices into facets_
};

}  // namespace sonarsim
