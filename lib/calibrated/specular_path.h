#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "trace/traced_ping.h"

namespace sonarsim {

/// A piece of surface that a sonar also sees in a mirror: another surface that sends sound on to
/// it. Sound goes out to one of the two places and comes back from the other.
struct SpecularPath {
    /// A place and how it moves along the piece's half edges, m in the sensor's frame.
    struct Place {
        Eigen::Vector3f at, u, v;
    };

    Place point;  ///< the piece
    /// The image source: in the direction of departure, at the length of the reflected path.
    Place image_source;
    float area_m2 = 0.0F;
    /// Sines of the angles that the surface makes with the way to the piece, with the way by the
    /// mirror, and with the direction midway between them.
    float sine_of_point = 0.0F, sine_of_image = 0.0F, sine_between = 0.0F;
    float reflection = 0.0F;     ///< share of the power that the mirrors on the path reflect
    std::uint32_t material = 0;  ///< index into Scene::materials
    std::uint32_t sample = 0;    ///< the piece of the mirror: index into Samples::items
};

/// The pieces of second surfaces that a ping's samples mirror sound to. With t the length of the
/// way to p in units of |p_i| a piece is seen in the mirror at t p_i, and it has the area
/// A_i (v_i . n_i) t^2 / |r_i . n_h|: all the sound that meets the sample goes on to it, whatever
/// lies between. The water's surface scatters nothing back.
std::vector<SpecularPath> specular_paths(const TracedPing& traced, const Scene& scene);

}  // namespace sonarsim
