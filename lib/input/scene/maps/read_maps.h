#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "input/mission/seabed_keys.h"
#include "input/scene/images/image_place.h"
#include "input/scene/maps/ground_maps.h"

namespace sonarsim {

/// A map, and where it applies.
struct AppliedMapRule {
    const AppliedMapConfig& map;
    std::string section;           ///< section of the mission, for messages
    Eigen::AlignedBox2d needed_m;  ///< the part that is kept, world x and y
};

/// A map of materials, from an image of one channel with a number for each, or of colours.
/// `materials` has numbers, or colours as "#c8b478", and indices into Scene::materials. InputError
/// for an image whose place is not known, for a key that does not fit the image's numbers or
/// colours, and for a pixel that has no material.
MaterialTexels read_material_map(
    const AppliedMapRule& rule, const Image& image,
    const std::vector<std::pair<std::string, std::uint32_t>>& materials);

/// A map of decibels, from an image of one channel, or one and alpha. Throws as the above, and for
/// more than 100 dB.
StrengthTexels read_strength_map(const AppliedMapRule& rule, const Image& image);

}  // namespace sonarsim
