#include "simulate/trace/multipath.h"

#include <limits>
#include <utility>

#include "simulate/trace/arrivals.h"
#include "simulate/trace/bounce_tracer.h"

namespace sonarsim {

namespace {

// Below this |r . n_h|, half a degree, the second plane is seen edge-on.
constexpr float min_cosine = 0.01F;

// Two traced members of a cluster have hit one plane when each point lies on the other's plane to
// within half a bin, and the normals agree to within 2.5 degrees.
constexpr float same_normal_cosine = 0.999F;
constexpr float same_plane_bins = 0.5F;

/// The plane of the second surface of a cluster, and the disc of it that was hit.
struct Plane {
    const BounceHit* hit;
    Eigen::Vector3f middle;
    float radius_m;
};

/// The counter that a sample adds to.
using Outcome = std::uint64_t MultipathCounts::*;
constexpr Outcome needs_own_ray = nullptr;  ///< to be traced by itself

/// True if two rays hit one plane, or both nothing.
bool same_plane(const BounceHit& a, const BounceHit& b, float slack_m) {
    if (!a.exists || !b.exists) return a.exists == b.exists;
    const Eigen::Vector3f apart = b.point - a.point;
    return a.reflection == b.reflection && a.normal.dot(b.normal) >= same_normal_cosine &&
           std::fabs(apart.dot(a.normal)) <= slack_m && std::fabs(apart.dot(b.normal)) <= slack_m;
}

/// The point p where the sound of one sample meets the plane, Eq. 2, and the echo that comes back
/// from there, Eq. 3. The mirror image of the sonar in the sample's plane, s, makes the path to p
/// one straight line: p lies on the ray from s through p_i, and |p - s| is the length of the path.
/// When p_i moves along an edge of its footprint, s stays where it is.
Outcome reflect(const BounceTracer& context, const Sample& sample, const Plane& plane,
                BouncePath& out) {
    const BounceHit& second = *plane.hit;
    if (!second.exists) return &MultipathCounts::missed;
    // The sound hit the side that the sonar does not see.
    const Eigen::Vector3f sonar = context.sonar();
    if (!(second.normal.dot(second.point - sonar) < 0.0F)) return &MultipathCounts::hidden;
    const Eigen::Vector3f image = 2.0F * sample.normal.dot(sample.position) * sample.normal;
    const Eigen::Vector3f through = sample.position - image;  // |p_i| r_i
    const float first_leg = arrival_range(sample.position);
    const float along = through.dot(second.normal);
    if (!(std::fabs(along) >= min_cosine * first_leg)) return &MultipathCounts::edge_on;
    // In units of |p_i|, from the mirror image: 1 is the sample itself.
    const float t = (second.point - image).dot(second.normal) / along;
    if (!(t > 1.0F)) return &MultipathCounts::behind;
    const Eigen::Vector3f p = image + t * through;
    if ((p - plane.middle).squaredNorm() > plane.radius_m * plane.radius_m) return needs_own_ray;
    const Eigen::Vector3f back = p - sonar;
    const float last_leg = arrival_range(back);
    const float range = arrival_range(t * first_leg, last_leg);
    const Eigen::Vector3f true_point = context.true_point(p);
    const float beam = context.field.beam(true_point, last_leg);
    const Eigen::Vector3f q = specular_direction(through, second.normal);
    const float cosine = -q.dot(back) / (first_leg * last_leg);
    if (!(beam >= 0.0F && range < static_cast<float>(context.view.range_max_m)))
        return &MultipathCounts::outside;
    if (!(cosine > 0.0F)) return &MultipathCounts::turned_away;
    const auto change = [&](const Eigen::Vector3f& edge, float& range_change, float& beam_change) {
        const float stretch = -t * edge.dot(second.normal) / along;
        const Eigen::Vector3f p_change = t * edge + stretch * through;
        range_change = 0.5F * (stretch * first_leg + t * edge.dot(sample.position) / first_leg +
                               p_change.dot(back) / last_leg);
        const Eigen::Vector3f true_point_change = context.true_change(p_change);
        beam_change =
            context.field.beams_per_rad() *
            (true_point.x() * true_point_change.y() - true_point.y() * true_point_change.x()) /
            (true_point.x() * true_point.x() + true_point.y() * true_point.y());
    };
    change(sample.edge_u, out.range_u, out.beam_u);
    change(sample.edge_v, out.range_v, out.beam_v);
    out.range_m = range;
    out.beam = beam;
    out.intensity = second.reflection * cosine;
    return &MultipathCounts::bounces;
}

/// The paths that return, and those that the second surface reflects away from the sonar.
struct Followed {
    std::vector<BouncePath> bounces, turned_away;
};

/// Reflects one sample off the plane, keeps a path that returns. True: trace it by itself.
bool follow(const BounceTracer& context, std::uint32_t sample, std::uint32_t ray,
            const Plane& plane, Followed& followed, MultipathCounts& counts) {
    const Sample& source = context.samples.items[sample];
    BouncePath b{};
    b.sample = sample;
    b.ray = ray;
    const Outcome outcome = reflect(context, source, plane, b);
    if (outcome == needs_own_ray) return true;
    ++(counts.*outcome);
    static_cast<SecondPoint&>(b) = *plane.hit;
    b.by_water_surface = context.uses_surface_image();
    if (outcome == &MultipathCounts::bounces) {
        b.intensity *= context.materials[source.material].reflection * source.strength;
        followed.bounces.push_back(b);
    } else if (outcome == &MultipathCounts::turned_away && context.scattered) {
        b.scattered = true;
        followed.turned_away.push_back(b);
    }
    return false;
}

/// Traces the samples and reflects each off the plane that its own ray hit.
void follow_traced(const BounceTracer& context, std::span<const std::uint32_t> sources,
                   std::vector<BounceHit>& second_hits, Followed& followed,
                   MultipathCounts& counts) {
    const std::size_t first = second_hits.size();
    trace_bounces(context, sources, second_hits, counts);
    constexpr float unbounded = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < sources.size(); ++k) {
        const BounceHit& own = second_hits[first + k];
        follow(context, sources[k], static_cast<std::uint32_t>(first + k),
               {&own, own.point, unbounded}, followed, counts);
    }
}

/// Takes out the bounces whose second point the sonar does not see.
void drop_hidden(const BounceTracer& context, const std::vector<BounceHit>& second_hits,
                 std::vector<BouncePath>& bounces, MultipathCounts& counts) {
    constexpr std::uint32_t no_sight = 0xFFFFFFFFU;
    std::vector<std::uint32_t> sight_of(second_hits.size(), no_sight);
    std::vector<SightPoint> sights;
    for (const BouncePath& b : bounces) {
        if (sight_of[b.ray] != no_sight) continue;
        const BounceHit& second = second_hits[b.ray];
        const Eigen::Vector3f at = context.true_point(second.point);
        sight_of[b.ray] = static_cast<std::uint32_t>(sights.size());
        sights.push_back({at, std::fabs(context.true_change(second.normal).dot(at.normalized())),
                          second.rounding_m});
    }
    const std::vector<bool> visible = context.engine.visible(context.T_world_sensor, sights);
    counts.rays += sights.size();
    counts.hidden +=
        std::erase_if(bounces, [&](const BouncePath& b) { return !visible[sight_of[b.ray]]; });
}

/// Follows the sound of all samples to the second surfaces that `context` allows.
std::vector<BouncePath> follow_all(const BounceTracer& context, const Clusters& clusters,
                                   MultipathCounts& counts) {
    // The first and the last member of every cluster are traced.
    std::vector<std::uint32_t> sources;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const auto members = clusters.of(c);
        sources.push_back(members.front());
        if (members.size() > 1) sources.push_back(members.back());
    }
    std::vector<BounceHit> second_hits;
    Followed followed;
    follow_traced(context, sources, second_hits, followed, counts);

    // If both hit one plane, those between are reflected off it; otherwise all are traced.
    sources.clear();
    std::uint32_t end = 0;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const auto members = clusters.of(c);
        const std::uint32_t first = end;
        end += members.size() > 1 ? 2 : 1;
        if (members.size() < 3) continue;
        const BounceHit& a = second_hits[first];
        const BounceHit& b = second_hits[end - 1];
        const bool flat = same_plane(a, b, same_plane_bins * context.bin_m);
        const Plane plane{.hit = &a,
                          .middle = 0.5F * (a.point + b.point),
                          .radius_m = (a.point - b.point).norm() + context.bin_m};
        for (const std::uint32_t i : members.subspan(1, members.size() - 2)) {
            if (!flat || follow(context, i, first, plane, followed, counts)) sources.push_back(i);
        }
    }
    follow_traced(context, sources, second_hits, followed, counts);
    drop_hidden(context, second_hits, followed.bounces, counts);
    if (context.scattered) {
        MultipathCounts counted;
        drop_hidden(context, second_hits, followed.turned_away, counted);
        counts.rays += counted.rays;
        followed.bounces.insert(followed.bounces.end(), followed.turned_away.begin(),
                                followed.turned_away.end());
    }
    return std::move(followed.bounces);
}

}  // namespace

std::vector<BouncePath> find_bounces(const Multipath& multipath, const TraceContext& trace,
                                     const Samples& samples, MultipathCounts& counts) {
    const std::optional<WaterMirror> mirror =
        mirror_of(trace.scene.water_surface, trace.T_world_sensor);
    BounceTracer context{.view = trace.view,
                         .samples = samples,
                         .materials = trace.scene.materials,
                         .maps = trace.scene.maps.get(),
                         .engine = trace.engine,
                         .T_world_sensor = trace.T_world_sensor,
                         .bin_m = static_cast<float>(trace.view.bin_m()),
                         .field = BeamLocator(trace.view),
                         .mirror = mirror ? &*mirror : nullptr,
                         .scattered = multipath.scattered};
    const Clusters clusters = cluster_samples(trace.view, samples, multipath.cluster);
    counts.samples = clusters.members.size();
    counts.clusters = clusters.size();

    std::vector<BouncePath> bounces = follow_all(context, clusters, counts);
    counts.bounces = std::ranges::count(bounces, false, &BouncePath::scattered);
    if (mirror) {
        // A sample is counted once, for its path without a reflection at the water's surface.
        MultipathCounts surface_counts;
        context.surface_role = SurfaceRole::reflector;
        const std::vector<BouncePath> more = follow_all(context, clusters, surface_counts);
        bounces.insert(bounces.end(), more.begin(), more.end());
        counts.rays += surface_counts.rays;
    }
    return bounces;
}

}  // namespace sonarsim
