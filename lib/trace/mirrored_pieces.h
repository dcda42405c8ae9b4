#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sonarsim {

/// A piece of surface that a sonar also sees in a mirror: another surface that sends sound on to
/// it. Sound goes out to one of the two places and comes back from the other.
struct MirroredPiece {
    /// A place and how it moves along the piece's half edges, m in the sensor's frame.
    struct Place {
        Eigen::Vector3f at, u, v;
    };

    Place point;  ///< where the piece is
    /// Where it is seen in the mirror: where the sound leaves to, as far off as its way is long.
    Place image;
    float area_m2 = 0.0F;
    /// Sines of the angles that the surface makes with the way to the piece, with the way by the
    /// mirror, and with the direction midway between them.
    float sine_of_point = 0.0F, sine_of_image = 0.0F, sine_between = 0.0F;
    float reflection = 0.0F;     ///< of the mirrors on the way: the share of the power they send on
    std::uint32_t material = 0;  ///< index into Scene::materials
};

}  // namespace sonarsim
