#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "input/scene/scene.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

/// A piece of a second surface, which a sonar sees in two places: directly, or over the water's
/// surface, and as an image over its first reflector. Sound goes out to one of the two places and
/// comes back from the other.
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
/// surface scatters nothing back. `shape`: that of the view.
std::vector<SpecularPath> specular_paths(const TracedPing& traced, const Scene& scene,
                                         ViewShape shape);

}  // namespace sonarsim
