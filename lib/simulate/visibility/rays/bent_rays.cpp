#include "simulate/visibility/rays/bent_rays.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/elementary.h"
#include "simulate/water/water_ray.h"

namespace sonarsim {

namespace {

// A chord meets facets up to this share beyond its end, so that consecutive chords leave no crack.
constexpr float chord_overlap = 1e-5F;
constexpr int newton_steps = 3;
// A ray steeper than this has no azimuth.
constexpr double steep_cosine = 1e-6;

/// Axes at a point of a ray: along it, across in its vertical plane (upwards), across to port.
struct RayAxes {
    Eigen::Vector3d along, across, port;

    RayAxes(const Eigen::Vector2d& ahead, double elevation_rad) {
        const SinCos e = sincos(elevation_rad);
        along = {e.cos * ahead.x(), e.cos * ahead.y(), e.sin};
        across = {-e.sin * ahead.x(), -e.sin * ahead.y(), e.cos};
        port = {-ahead.y(), ahead.x(), 0.0};
    }
};

/// A ray that is being cast.
struct RayState {
    Eigen::Vector2d ahead;  ///< unit, horizontal
    double elevation_rad;   ///< at its start
    WaterRay at;
};

class BentCast {
  public:
    BentCast(const Caster& caster, const BentWater& water, const Eigen::Vector3f& position)
        : caster_(caster),
          water_(water),
          profile_(*water.profile),
          position_(position.cast<double>()) {}

    RayState way(const Eigen::Vector3f& direction, float from_m) const {
        const Eigen::Vector3d d = direction.cast<double>();
        const double level = d.head<2>().norm();
        RayState out{level > 0.0 ? Eigen::Vector2d(d.head<2>() / level) : Eigen::Vector2d::UnitX(),
                     arctan2(d.z(), level),
                     {}};
        out.at = water_ray(profile_, position_.z() + water_.origin_m, out.elevation_rad);
        while (range_of(out.at) < static_cast<double>(from_m)) {
            const double left = length_to(out.at, from_m);
            if (left < 1e-6 * static_cast<double>(from_m)) break;
            advance(profile_, left, out.at);
        }
        return out;
    }

    double range_of(const WaterRay& ray) const { return ray.time_s * profile_.range_speed_m_s; }

    /// The ray at the end of its next chord.
    WaterRay next(const RayState& way, float reach_m) const {
        WaterRay ray = way.at;
        // Slightly longer than the rest, so that the last chord ends beyond the reach.
        const double rest = 1.05 * length_to(ray, reach_m) + 1e-6 * static_cast<double>(reach_m);
        advance(profile_, std::min(rest, length_with_sag(profile_, ray, water_.sag_m)), ray);
        return ray;
    }

    Eigen::Vector3d place(const RayState& way, const WaterRay& ray) const {
        Eigen::Vector3d out;
        out << position_.head<2>() + ray.along_m * way.ahead, ray.height_m - water_.origin_m;
        return out;
    }

    /// The hit of a ray whose next chord met a facet at the distance `chord_m`.
    BentHit hit(const RayState& way, std::uint32_t met, double chord_m) const {
        const Facet facet = caster_.facet(met);
        const Eigen::Vector3d normal = facet.normal.cast<double>();
        const Eigen::Vector3d vertex = facet.vertex.cast<double>();
        double length = chord_m;
        WaterRay ray = way.at;
        for (int k = 0; k < newton_steps; ++k) {
            ray = on_arc(profile_, way.at, length);
            const double slope = normal.dot(RayAxes(way.ahead, ray.elevation_rad).along);
            // At grazing incidence the arc may miss the facet; the chord has met it.
            const double change = normal.dot(vertex - place(way, ray)) / slope;
            if (!(std::fabs(length + change - chord_m) < 0.5 * chord_m)) break;
            length += change;
        }
        ray = on_arc(profile_, way.at, length);
        return appearance(way, ray, met, normal);
    }

  private:
    double length_to(const WaterRay& ray, float range_m) const {
        return (static_cast<double>(range_m) - range_of(ray)) *
               profile_.speed_in(ray.layer, ray.height_m) / profile_.range_speed_m_s;
    }

    /// The map from apparent to true places stretches by c / c0 along the ray, by tube width over
    /// range across the ray in its plane, and by true over apparent horizontal distance to port.
    /// The transpose of this map takes a plane's true normal to the apparent one.
    BentHit appearance(const RayState& way, const WaterRay& ray, std::uint32_t facet,
                       const Eigen::Vector3d& normal) const {
        const double range = range_of(ray);
        const auto bounded = [](double x) {
            return std::fabs(x) < min_spread ? std::copysign(min_spread, x) : x;
        };
        const double cosine = sincos(way.elevation_rad).cos;
        const double along = profile_.speed_in(ray.layer, ray.height_m) / profile_.range_speed_m_s;
        const double across = bounded(ray.tube_m / range);
        const double port =
            cosine > steep_cosine ? bounded(ray.along_m / (range * cosine)) : across;
        const RayAxes there(way.ahead, ray.elevation_rad);
        const RayAxes here(way.ahead, way.elevation_rad);
        const double facing = normal.dot(there.along) > 0.0 ? -1.0 : 1.0;
        const Eigen::Vector3d n =
            facing * Eigen::Vector3d(normal.dot(there.along), normal.dot(there.across),
                                     normal.dot(there.port));
        const Eigen::Vector3d visible =
            Eigen::Vector3d(along * n.x(), across * n.y(), port * n.z()).normalized();
        const auto in_scene = [&](const Eigen::Vector3d& v) -> Eigen::Vector3f {
            return (v.x() * here.along + v.y() * here.across + v.z() * here.port).cast<float>();
        };
        const double tube = std::fabs(across * port);
        return {.facet = facet,
                .range_m = static_cast<float>(range),
                .normal = in_scene(visible),
                .cosine = static_cast<float>(-visible.x()),
                .tube = {.normal = in_scene(n),
                         .cosine = static_cast<float>(-n.x()),
                         .area = static_cast<float>(tube * visible.x() / n.x()),
                         .strength = static_cast<float>(1.0 / (tube * tube))}};
    }

    const Caster& caster_;
    const BentWater& water_;
    const SoundProfile& profile_;
    Eigen::Vector3d position_;
};

}  // namespace

void cast_bent_rays(const Caster& caster, const BentWater& water, const Eigen::Vector3f& position,
                    std::span<const Eigen::Vector3f> directions, std::span<const float> from_m,
                    float reach_m, std::span<BentHit> hits) {
    const BentCast cast(caster, water, position);
    std::vector<RayState> rays;
    rays.reserve(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i)
        rays.push_back(cast.way(directions[i], from_m.empty() ? 0.0F : from_m[i]));
    std::vector<std::uint32_t> active(directions.size());
    std::iota(active.begin(), active.end(), 0U);
    std::vector<WaterRay> ends;
    std::vector<Eigen::Vector3f> origins;
    std::vector<Eigen::Vector3f> chords;
    std::vector<float> lengths;
    std::vector<std::uint32_t> facets;
    // All rays advance by one chord at a time, so that neighbours are traced together.
    while (!active.empty()) {
        ends.clear();
        origins.clear();
        chords.clear();
        lengths.clear();
        for (const std::uint32_t i : active) {
            ends.push_back(cast.next(rays[i], reach_m));
            const Eigen::Vector3d from = cast.place(rays[i], rays[i].at);
            const Eigen::Vector3d chord = cast.place(rays[i], ends.back()) - from;
            lengths.push_back(static_cast<float>(chord.norm()));
            origins.push_back(from.cast<float>());
            chords.push_back(chord.normalized().cast<float>());
        }
        facets.resize(active.size());
        const float longest = *std::ranges::max_element(lengths);
        caster.cast(origins, chords, facets, longest * (1.0F + 2.0F * chord_overlap));
        std::size_t left = 0;
        for (std::size_t k = 0; k < active.size(); ++k) {
            const std::uint32_t i = active[k];
            if (facets[k] != Caster::nothing) {
                const Facet facet = caster.facet(facets[k]);
                const float to =
                    facet.normal.dot(facet.vertex - origins[k]) / facet.normal.dot(chords[k]);
                if (to <= lengths[k] * (1.0F + chord_overlap)) {
                    hits[i] = cast.hit(rays[i], facets[k], static_cast<double>(to));
                    continue;
                }
            }
            if (cast.range_of(ends[k]) > static_cast<double>(reach_m)) continue;
            rays[i].at = ends[k];
            active[left++] = i;
        }
        active.resize(left);
    }
}

void pass_bent_rays(const Caster& caster, const BentWater& water, const LocalPose& pose,
                    std::span<const Ray> rays, float reach_m, int max_surfaces,
                    const UseSurfaces& use) {
    std::vector<std::vector<Intersection>> met(rays.size());
    std::vector<std::size_t> active(rays.size());
    std::iota(active.begin(), active.end(), std::size_t{0});
    std::vector<float> from_m;
    for (const Ray& ray : rays)
        from_m.push_back(ray.origin.norm());
    for (int layer = 0; layer < max_surfaces && !active.empty(); ++layer) {
        std::vector<Eigen::Vector3f> directions;
        std::vector<float> starts_m;
        for (const std::size_t i : active) {
            directions.emplace_back(pose.rotation * rays[i].direction);
            starts_m.push_back(from_m[i]);
        }
        std::vector<BentHit> hits(active.size());
        cast_bent_rays(caster, water, pose.position, directions, starts_m, reach_m, hits);
        std::size_t left = 0;
        for (std::size_t k = 0; k < hits.size(); ++k) {
            const BentHit& hit = hits[k];
            if (hit.facet == Caster::nothing || !(hit.range_m < reach_m)) continue;
            const std::size_t i = active[k];
            const Facet facet = caster.facet(hit.facet);
            met[i].push_back({hit.range_m - rays[i].origin.norm(), static_cast<float>(water.sag_m),
                              pose.rotation.transpose() * hit.normal, facet.material,
                              facet.instance});
            // The gap keeps the next ray from the same surface.
            from_m[i] = hit.range_m + 2.0F * met[i].back().rounding_m / std::max(hit.cosine, 0.1F);
            if (from_m[i] < reach_m) active[left++] = i;
        }
        active.resize(left);
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
        use(i, met[i]);
}

}  // namespace sonarsim
