#include "visibility/octree/sight_lines.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

/// Along a sight line a surface deviates by its thickness over the cosine of incidence. The cosine
/// is limited to this, since it falls to zero behind the limb of a sphere.
constexpr float least_sight_cosine = 0.1F;

/// Positions are floats; their error is some roundings of 6e-8 of the range.
constexpr float sight_rounding = 1e-6F;

/// True if the plane that a sight line met lies in front of the sample. `towards` is the vector
/// from the sonar to the sample in local axes.
bool hides(const Facet& facet, const LocalPose& pose, const Eigen::Vector3f& towards,
           const Sample& sample, float thickness_m, float rounding_m) {
    // A sample in that plane belongs to the same surface, even if it is so nearly edge-on that
    // ranges are meaningless.
    const float height = facet.normal.dot(pose.position - facet.vertex);
    const float along = facet.normal.dot(towards);
    if (std::fabs(height + along) <= thickness_m + rounding_m) return false;
    const float range_m = sample.position.norm();
    const float cosine = std::max(sample.height_m / range_m, least_sight_cosine);
    const float nearer = 1.0F - (thickness_m / cosine + rounding_m) / range_m;
    return std::fabs(height) < nearer * std::fabs(along);
}

}  // namespace

std::vector<std::uint32_t> in_sight(const Caster& caster, const LocalPose& pose, float reach_m,
                                    std::span<const Sample> samples,
                                    std::span<const float> thickness_m) {
    std::vector<Eigen::Vector3f> directions(samples.size());
    std::vector<std::uint32_t> met(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        directions[i] = pose.rotation * samples[i].position.normalized();
    caster.cast(pose.position, directions, reach_m, met);
    std::vector<std::uint32_t> seen;
    seen.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const bool hidden = met[i] != Caster::nothing &&
                            hides(caster.facet(met[i]), pose, pose.rotation * samples[i].position,
                                  samples[i], thickness_m[i], sight_rounding * reach_m);
        if (!hidden) seen.push_back(static_cast<std::uint32_t>(i));
    }
    return seen;
}

}  // namespace sonarsim
