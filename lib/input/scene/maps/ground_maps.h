#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "input/scene/maps/texel_sums.h"

namespace sonarsim {

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

    /// The material and strength of a footprint, if a quick test finds them uniform. Without
    /// `with_strength` the strength is 1.
    std::optional<MappedPoint> alike_over(std::uint32_t instance, std::uint32_t own,
                                          const GroundFootprint& footprint,
                                          bool with_strength = true) const;

    /// The materials of a footprint of an instance, each with its area and its power. The areas sum
    /// to 1.
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
