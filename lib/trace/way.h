#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "trace/bounce_path.h"
#include "trace/counters.h"
#include "trace/lay_maps.h"
#include "trace/multipath.h"
#include "trace/water_mirror.h"
#include "visibility/engine.h"

namespace sonarsim {

/// Below this cosine surface is seen edge-on, as in find_bounces().
inline constexpr float least_seen_cosine = 0.01F;

/// A surface that a way meets.
struct WayHit {
    float distance_m;
    Eigen::Vector3f normal;
    float reflection;
    MappedPoint surface{no_material, 1.0F};  ///< no_material: the water's, or the source
};

/// Sound on its way from the sonar, over reflectors.
struct Way {
    static constexpr int most_kept = 6;

    struct Reflector {
        Eigen::Vector3f point, normal;
        bool is_water = false;
    };

    std::uint32_t source = 0;  ///< index into Samples::items
    Ray ray;                   ///< after the last reflection
    float length_m = 0.0F;     ///< up to the last reflection
    float reflected = 1.0F;    ///< share of the power after the reflections so far
    Eigen::Matrix3f unfold =
        Eigen::Matrix3f::Identity();  ///< turns directions of the scene into those of the images
    int reflections = 0;
    std::array<Reflector, most_kept> reflectors;  ///< the first reflectors
};

/// Continues a way after a reflection.
void reflect(const WayHit& at, Way& way);

/// The first hits of the rays of ways. Their number is added to `counts`.
std::vector<Intersection> cast_ways(const TraceContext& trace, std::span<const Way> ways,
                                    MultipathCounts& counts);

/// The surface at the hit of a ray.
WayHit hit_of_way(const TraceContext& trace, const std::optional<WaterMirror>& water,
                  const Ray& ray, const Intersection& hit);

}  // namespace sonarsim
