#pragma once

#include "core/pose.h"
#include "input/scene/maps/ground_maps.h"
#include "simulate/visibility/engine.h"
#include "simulate/water/sound_profile.h"

namespace sonarsim {

/// The place where the strengths of a map enter.
enum class MapStrengths {
    in_samples,  ///< Sample::strength
    at_points    ///< the echo model applies them to points of samples, pieces of targets excepted
};

/// Gives the samples of a ping the materials and strengths of the maps that lie on them. A sample
/// on which the maps change is cut until its pieces are half a range bin deep and as wide as a
/// beam; a piece with several materials becomes strips with the area of each. So the strips tile
/// the surface as the samples did, and a bin's echo is the mean over the area that it sees.
/// `profile` bends the sound, if not null.
void apply_maps(const GroundMaps& maps, const View& view, const Pose& T_world_sensor,
                Samples& samples, const SoundProfile* profile = nullptr,
                MapStrengths strengths = MapStrengths::in_samples);

/// The material and strength of a point in the sensor frame.
MappedPoint mapped_point(const GroundMaps& maps, const Pose& T_world_sensor,
                         const Eigen::Vector3f& point, std::uint32_t instance,
                         std::uint32_t material);

}  // namespace sonarsim
