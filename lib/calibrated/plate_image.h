#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "calibrated/array_beams.h"
#include "calibrated/sonar_equation.h"
#include "calibrated/transducer_beams.h"
#include "core/elementary.h"
#include "scene/scene.h"
#include "trace/coherent_surface.h"
#include "visibility/view.h"

namespace sonarsim {

/// The coherent surface of a ping, and the quantities that its echoes depend on.
struct PlateScene {
    const CoherentSurface& surface;
    std::span<const Material> materials;
    const View& view;  ///< with its guard beams; nothing outside of it is insonified
    double wavelength_m = 0.0;
};

/// Adds the complex amplitudes of the plates' coherent echoes to the grid. Returns the number of
/// their parts outside the view, the range or the beams.
template <class Beams>
std::uint64_t add_plate_amplitudes(const Beams& beams, const PlateScene& scene,
                                   const SonarEquation& equation, const PointLimits& limits,
                                   EchoGrid& grid);

extern template std::uint64_t add_plate_amplitudes(const TransducerBeams&, const PlateScene&,
                                                   const SonarEquation&, const PointLimits&,
                                                   EchoGrid&);
extern template std::uint64_t add_plate_amplitudes(const ArrayBeams&, const PlateScene&,
                                                   const SonarEquation&, const PointLimits&,
                                                   EchoGrid&);

/// The shares of the power that faces scatter incoherently.
///
/// The heights z of a rough face are normally distributed with the RMS height h. An echo at the
/// grazing angle g has the phase 2 k z sin g. The factor on the coherent amplitude is the mean of
/// exp(i 2 k z sin g), exp(-(2 k h sin g)^2 / 2) (Eckart 1953). The total reflected power does not
/// depend on h. So the incoherent echo, which the sonar equation gives for 2 k h >> 1, keeps
///
///     1 - exp(-(2 k h sin g)^2).
///
/// A material without `roughness_m` has h >> lambda: its echo is all incoherent.
class IncoherentShares {
  public:
    IncoherentShares(std::span<const FaceOfPing> faces, std::span<const Material> materials,
                     double wavelength_m);

    bool are_all_one() const { return faces_.empty(); }

    /// The result of phase2() for surface that is no part of a coherent face.
    static constexpr float incoherent = std::numeric_limits<float>::infinity();

    /// (2 k h)^2 of the surface at a point of an object.
    float phase2(std::uint32_t instance, std::uint32_t material, const Eigen::Vector3f& point,
                 const Eigen::Vector3f& normal) const;

    static float at(float phase2, float sine) {
        return 1.0F - static_cast<float>(exponential(-static_cast<double>(phase2) * sine * sine));
    }

  private:
    std::span<const FaceOfPing> faces_;
    std::vector<float> phase2_;  ///< one for each material
};

}  // namespace sonarsim
