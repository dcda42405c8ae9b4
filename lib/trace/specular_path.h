#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sonarsim {

/// A piece of surface that a sonar sees in two places. At least one of them is an image over
/// specular surfaces. Sound goes out to one of the two places and comes back from the other.
struct SpecularPath {
    /// A place and its changes along the piece's half edges, m in the sensor's frame.
    struct Place {
        Eigen::Vector3f at, u, v;
    };

    Place point;  ///< the piece, or its image over the way with fewer reflections
    /// The image source: in the direction of departure, at the length of the reflected path.
    Place image_source;
    float area_m2 = 0.0F;
    /// Sines of the grazing angles on the piece: of the way to `point`, of the way to
    /// `image_source`, and of the direction midway between them.
    float sine_of_point = 0.0F, sine_of_image = 0.0F, sine_between = 0.0F;
    float reflection = 0.0F;     ///< reflected share of the power, times the piece's strength
    std::uint32_t material = 0;  ///< index into Scene::materials
    std::uint32_t sample = 0;    ///< the first reflector: index into Samples::items
};

}  // namespace sonarsim
