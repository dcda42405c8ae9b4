#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sonarsim {

inline constexpr std::uint32_t no_material = 0xFFFFFFFFU;
inline constexpr std::uint32_t no_instance = 0xFFFFFFFFU;

/// A point of the second surface h of a multipath path.
struct SecondPoint {
    Eigen::Vector3f point = Eigen::Vector3f::Zero();   ///< p_h, where the ray met it, sensor frame
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< n_h
    std::uint32_t material = no_material;  ///< index into Scene::materials; none: the water's
    std::uint32_t instance = no_instance;  ///< no_instance: the water's surface
    float strength = 1.0F;                 ///< as in Sample
    float water_reflection = 1.0F;  ///< R of the water's surface if it reflects the sound, else 1
};

/// A multipath path: from the sonar to a sample, which reflects the sound to a second surface, and
/// back from there. If the water's surface reflects the sound on its way (`by_water_surface`),
/// `point` and `normal` are those of the second surface's image in the water's surface.
struct BouncePath : SecondPoint {
    std::uint32_t sample = 0;  ///< index into Samples::items
    std::uint32_t ray = 0;     ///< the traced ray that found the second surface
    /// The arrival from the second point p: one-way equivalent range and beam, and their changes
    /// along the half edges of the sample's footprint; 0 for scattered sound.
    float range_m = 0.0F, range_u = 0.0F, range_v = 0.0F;
    float beam = 0.0F, beam_u = 0.0F, beam_v = 0.0F;  ///< in beams; its integer part is the beam
    float intensity = 0.0F;  ///< R_i R_h (q . v_p), Eq. 1-3; 0 for scattered sound
    bool by_water_surface = false;
    /// The second surface reflects the sound away from the sonar; the paper has no such echo.
    bool scattered = false;
};

}  // namespace sonarsim
