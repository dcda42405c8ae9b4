#pragma once

#include <Eigen/Core>

#include "input/scene/scene.h"
#include "simulate/calibrated/equation/sonar_equation.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

/// A piece of a second surface, which a sonar sees in two places: directly, or over the water's
/// surface, and as an image over its first reflector. Sound goes to one and returns from the other.
struct SpecularPath {
    /// A place and its changes along the piece's half edges, m in the sensor's frame.
    struct Place {
        Eigen::Vector3f at, u, v;
    };

    Place point;  ///< the piece, or its image over the water's surface
    /// The image source: in the direction of departure, at the length of the reflected path.
    Place image_source;
    float area_m2 = 0.0F;
    /// Sines of the grazing angles on the piece: of the way to `point`, of the way to
    /// `image_source`, and of the direction midway between them.
    float sine_of_point = 0.0F, sine_of_image = 0.0F, sine_between = 0.0F;
    float reflection = 0.0F;     ///< reflected share of the power, times the piece's strength
    std::uint32_t material = 0;  ///< index into Scene::materials
    std::uint32_t sample = 0;    ///< the first reflector: index into Samples::items
    std::uint32_t instance = 0;  ///< that the piece belongs to
};

/// The pieces of second surfaces that receive specular reflections of a ping's samples. With t the
/// length of the path to p in units of |p_i|, the image of a piece lies at t p_i, and its area is
/// A_i (v_i . n_i) t^2 / |r_i . n_h|: it receives all sound that meets the sample. The water's
/// surface scatters nothing back. `materials`: of the scene. `shape`: that of the view.
std::vector<SpecularPath> specular_paths(const TracedPing& traced, const Scene& scene,
                                         std::span<const Backscatter> materials, ViewShape shape);

/// Echoes that return from another place than they were sent to; powers and bins as in PointEchoes.
struct SpecularBlock {
    PathEndpoint out;    ///< the ranges of its echoes are those of the places
    PatchBlock& places;  ///< the echoes come back from these
    PointEchoes& echoes;
    std::span<const std::uint32_t> path;  ///< index into the paths
};

/// Finds the echoes of specular paths, and calls `use` for blocks of them. With the piece at the
/// range r and its image at the range s,
///
///     EL = SL + S + 10 log R + 10 log A + D - 20 log r - 20 log s - alpha (r + s)    dB,
///
/// in the range bin of (r + s) / 2: the reflector is assumed to be flat, so sound spreads as from
/// the image. R is the part of the reflection that roughness leaves a mirror. S is bistatic, for
/// the two directions (Backscatter::between). Sound takes the path in both senses with the same
/// power: out to the image and back from the piece, and the reverse. D is the transmitting pattern
/// towards the one end times the receiving pattern towards the other.
///
/// Returns the number of these echoes outside the range.
std::uint64_t find_specular_echoes(std::span<const SpecularPath> paths,
                                   std::span<const Backscatter> materials,
                                   const SonarEquation& equation, const PointLimits& limits,
                                   const std::function<void(const SpecularBlock&)>& use);

}  // namespace sonarsim
