#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sonarsim {

/// Sums of an image's texels over boxes of any size, in constant time: a summed-area table (F. C.
/// Crow, SIGGRAPH 1984). Texel (row, column) fills [column, column + 1] x [row, row + 1]. With
/// S(x, y), the sum of the texels left of x and above y, a box has
/// S(x1, y1) - S(x0, y1) - S(x1, y0) + S(x0, y0). Within a texel S rises bilinearly, so that
/// interpolation between whole numbers gives the exact integral over boxes that cut texels.
template <class T>
class TexelSums {
  public:
    TexelSums() = default;
    /// `value(k)` is called for every texel, row by row.
    TexelSums(int width, int height, const auto& value)
        : width_(width), height_(height), sums_(row_length() * (index(height) + 1)) {
        std::size_t texel = 0;
        for (int row = 0; row < height; ++row) {
            T left = 0;
            const std::size_t above = index(row) * row_length();
            const std::size_t here = above + row_length();
            for (int column = 0; column < width; ++column) {
                left += static_cast<T>(value(texel++));
                sums_[here + index(column) + 1] = sums_[above + index(column) + 1] + left;
            }
        }
    }

    /// The integral over a box. Beyond the image all is 0.
    double over(const Eigen::AlignedBox2d& box) const {
        const Place west = place(box.min().x(), width_);
        const Place east = place(box.max().x(), width_);
        const Place north = place(box.min().y(), height_);
        const Place south = place(box.max().y(), height_);
        return (before(east, south) - before(west, south)) -
               (before(east, north) - before(west, north));
    }

  private:
    static std::size_t index(int k) { return static_cast<std::size_t>(k); }
    std::size_t row_length() const { return index(width_) + 1; }

    /// A coordinate as the index of its texel and the fraction of the texel before it.
    struct Place {
        std::size_t texel;
        double share;
    };
    static Place place(double at, int texels) {
        at = std::clamp(at, 0.0, 1.0 * texels);
        const int texel = std::min(static_cast<int>(at), texels - 1);
        return {index(texel), at - texel};
    }

    double before(const Place& column, const Place& row) const {
        const T* const above = &sums_[row.texel * row_length() + column.texel];
        const T* const below = above + row_length();
        const double a = column.share;
        const double up = above[0] + a * (static_cast<double>(above[1]) - above[0]);
        const double down = below[0] + a * (static_cast<double>(below[1]) - below[0]);
        return up + row.share * (down - up);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<T> sums_;  ///< one column and one row more than the image
};

/// The place of an image in the world: texel coordinates are (p - corner) * per_m.
struct TexelFrame {
    int width = 0;
    int height = 0;
    Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();  ///< outer corner of the first texel, world
    Eigen::Vector2d per_m = Eigen::Vector2d::Ones();  ///< texels per metre; y < 0: first row north

    Eigen::Vector2d texels(const Eigen::Vector2d& world) const {
        return (world - corner_m).cwiseProduct(per_m);
    }
};

/// The texels of a map of materials.
struct MaterialTexels {
    /// Texels that leave a surface its own material.
    static constexpr std::uint16_t own = 0xFFFF;

    TexelFrame frame;
    std::vector<std::uint16_t> choice;     ///< index into `materials`, or `own`; rows from the top
    std::vector<std::uint32_t> materials;  ///< indices into Scene::materials
};

/// The texels of a map of strengths.
struct StrengthTexels {
    TexelFrame frame;
    std::vector<float> factor;  ///< on the power that the material sends back; 1: no change
};

/// The material and strength of a point of a surface with maps.
struct MappedPoint {
    std::uint32_t material = 0;  ///< index into Scene::materials
    float strength = 1.0F;       ///< factor on the power that the material sends back
};

/// A parallelogram of surface seen from above: its centre and its half edges, world x and y, m.
struct GroundFootprint {
    Eigen::Vector2d centre, u, v;
};

/// The part of a footprint that one material has.
struct MaterialShare {
    std::uint32_t material = 0;
    double area = 0.0;   ///< share of the footprint
    double power = 0.0;  ///< share times the mean factor on the power
};

/// Maps of material and of strength that apply to the ground from above. Immutable.
class GroundMaps {
  public:
    /// The maps lie on the instances of the scene whose element of `ground` is not 0.
    GroundMaps(std::optional<MaterialTexels> materials, std::optional<StrengthTexels> strengths,
               std::vector<char> ground);

    bool lie_on(std::uint32_t instance) const {
        return instance < ground_.size() && ground_[instance] != 0;
    }

    /// The materials that texels may have, indices into Scene::materials.
    std::span<const std::uint32_t> materials() const {
        if (!materials_) return {};
        return materials_->materials;
    }

    /// The material and strength at world x and y of an instance whose own material is `own`.
    MappedPoint at(std::uint32_t instance, std::uint32_t own, const Eigen::Vector2d& world) const;

    /// The material and strength (1 without `with_strength`) of a footprint, if uniform.
    std::optional<MappedPoint> alike_over(std::uint32_t instance, std::uint32_t own,
                                          const GroundFootprint& footprint,
                                          bool with_strength = true) const;

    /// The materials of a footprint of an instance with area and power. The areas sum to 1.
    void shares_over(std::uint32_t instance, std::uint32_t own, const GroundFootprint& footprint,
                     std::vector<MaterialShare>& out) const;

    /// The mean strength of a box around a point of an instance that reaches `half_m` to all sides.
    float strength_over(std::uint32_t instance, const Eigen::Vector2d& world,
                        const Eigen::Vector2d& half_m) const {
        return has_strengths(instance) ? static_cast<float>(factor_over(world, half_m)) : 1.0F;
    }
    bool have_materials() const { return materials_.has_value(); }
    bool have_strengths() const { return strengths_.has_value(); }

    /// Bytes that are different for different maps.
    std::string identity() const;

  private:
    /// The material of a footprint, if a quick test finds that it has only one.
    std::optional<std::uint32_t> material_over(std::uint32_t instance, std::uint32_t own,
                                               const GroundFootprint& footprint) const;
    bool has_materials(std::uint32_t instance) const { return materials_ && lie_on(instance); }
    bool has_strengths(std::uint32_t instance) const { return strengths_ && lie_on(instance); }
    /// The mean of the factors over a box around a point.
    double factor_over(const Eigen::Vector2d& world, const Eigen::Vector2d& half_m) const;

    std::optional<MaterialTexels> materials_;
    std::vector<TexelSums<std::uint32_t>> counts_;  ///< texels of each of MaterialTexels::materials
    std::optional<StrengthTexels> strengths_;
    TexelSums<double> gains_;  ///< sums of the factors less 1
    std::vector<char> ground_;
};

}  // namespace sonarsim
