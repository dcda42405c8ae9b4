#include "ping/multipath.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sonarsim {

namespace {

// Below this |r . n_h| the second plane is seen edge-on, half a degree: where the ray would meet
// it is beyond what a float position can tell, and beyond what the plane can stand for.
constexpr float edge_on = 0.01F;

// Two traced ends of a cluster have met one plane when each lies on the other's to within half a
// bin, and the normals to within 2.5 degrees.
constexpr float same_normal = 0.999F;
constexpr float same_plane_bins = 0.5F;

/// Where a traced ray met a second surface.
struct Second {
    Eigen::Vector3f point;  ///< p_h, sensor frame
    Eigen::Vector3f normal;
    float rounding_m = 0.0F;  ///< as in Intersection
    float reflection = 0.0F;
    bool met = false;
};

/// The second plane of a cluster, as far as it is known to reach.
struct Plane {
    const Second* second;
    Eigen::Vector3f middle;
    float radius_m;
};

/// What became of a sample, as the count that it goes into.
using Fate = std::uint64_t MultipathCounts::*;
constexpr Fate stray = nullptr;  ///< the plane is not known to reach this far

/// What all steps need.
struct Context {
    const View& view;
    const Samples& samples;
    std::span<const Material> materials;
    const VisibilityEngine& engine;
    const Pose& T_world_sensor;
    float bin_m;
    FieldOfView field;
};

/// [1]
Eigen::Vector3f mirrored(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal) {
    return direction - 2.0F * normal.dot(direction) * normal;
}

/// The ray that leaves a sample. A sample on a curved surface may lie a little below it, by no
/// more than the facets that it stands for disagree; the ray starts above that.
Ray mirrored_ray(const Sample& sample, float bin_m) {
    const float range = sample.position.norm();
    const float size = sample.edge_u.norm() + sample.edge_v.norm();
    const float lift = 1e-4F * range + std::min(0.05F * size, 0.5F * bin_m);
    return {sample.position + lift * sample.normal,
            mirrored(sample.position / range, sample.normal)};
}

/// Whether a ray may have met the surface that it started from: its start lies on what it met to
/// within rounding.
bool met_its_start(const Ray& ray, const Intersection& hit) {
    return std::fabs(hit.distance_m * hit.normal.dot(ray.direction)) <= hit.rounding_m;
}

/// Traces the samples and adds what they met to `seconds`. Far from the scene's origin, or on a
/// triangle that reaches far, a start may be rounded to below its surface; it then tries once more
/// from above that rounding.
void trace(const Context& context, std::span<const std::uint32_t> chosen,
           std::vector<Second>& seconds, MultipathCounts& counts) {
    std::vector<Ray> rays;
    rays.reserve(chosen.size());
    for (const std::uint32_t i : chosen)
        rays.push_back(mirrored_ray(context.samples.items[i], context.bin_m));
    std::vector<Intersection> hits(rays.size());
    context.engine.intersect(context.T_world_sensor, rays, hits);
    counts.rays += rays.size();
    for (std::size_t k = 0; k < rays.size(); ++k) {
        if (!met_its_start(rays[k], hits[k])) continue;
        rays[k].origin += 2.0F * hits[k].rounding_m * context.samples.items[chosen[k]].normal;
        context.engine.intersect(context.T_world_sensor, {&rays[k], 1}, {&hits[k], 1});
        ++counts.rays;
    }
    for (std::size_t k = 0; k < rays.size(); ++k) {
        Second second;
        if (std::isfinite(hits[k].distance_m)) {
            second = {rays[k].origin + hits[k].distance_m * rays[k].direction, hits[k].normal,
                      hits[k].rounding_m, context.materials[hits[k].material].reflection, true};
        }
        seconds.push_back(second);
    }
}

bool agree(const Second& a, const Second& b, float slack_m) {
    if (!a.met || !b.met) return a.met == b.met;
    const Eigen::Vector3f apart = b.point - a.point;
    return a.reflection == b.reflection && a.normal.dot(b.normal) >= same_normal &&
           std::fabs(apart.dot(a.normal)) <= slack_m && std::fabs(apart.dot(b.normal)) <= slack_m;
}

/// [2-3] for one sample of a cluster: where it meets the plane, and what comes back from there. The
/// mirror image of the sonar in the sample's plane, s, makes this one straight line: p lies on the
/// ray from s through p_i, and |p - s| is the length of the path to p. Moving p_i along an edge e
/// of its footprint leaves s where it is.
Fate bounce(const Context& context, const Sample& sample, const Plane& plane, Bounce& out) {
    const Second& second = *plane.second;
    if (!second.met) return &MultipathCounts::missed;
    // The sound met the back of what the sonar faces.
    if (!(second.normal.dot(second.point) < 0.0F)) return &MultipathCounts::hidden;
    const Eigen::Vector3f image = 2.0F * sample.normal.dot(sample.position) * sample.normal;
    const Eigen::Vector3f through = sample.position - image;  // |p_i| r_i
    const float first_leg = sample.position.norm();
    const float along = through.dot(second.normal);
    if (!(std::fabs(along) >= edge_on * first_leg)) return &MultipathCounts::edge_on;
    // In units of |p_i|, from the mirror image: 1 is the sample itself.
    const float t = (second.point - image).dot(second.normal) / along;
    if (!(t > 1.0F)) return &MultipathCounts::behind;
    const Eigen::Vector3f p = image + t * through;
    if ((p - plane.middle).squaredNorm() > plane.radius_m * plane.radius_m) return stray;
    const float last_leg = p.norm();
    const float range = 0.5F * (t * first_leg + last_leg);
    const float beam = context.field.beam(p, last_leg);
    const Eigen::Vector3f q = mirrored(through, second.normal);
    const float cosine = -q.dot(p) / (first_leg * last_leg);
    if (!(beam >= 0.0F && range < static_cast<float>(context.view.range_max_m)))
        return &MultipathCounts::outside;
    if (!(cosine > 0.0F)) return &MultipathCounts::turned_away;
    const auto change = [&](const Eigen::Vector3f& edge, float& of_range, float& of_beam) {
        const float stretch = -t * edge.dot(second.normal) / along;
        const Eigen::Vector3f of_p = t * edge + stretch * through;
        of_range = 0.5F * (stretch * first_leg + t * edge.dot(sample.position) / first_leg +
                           of_p.dot(p) / last_leg);
        of_beam = context.field.beams_per_rad() * (p.x() * of_p.y() - p.y() * of_p.x()) /
                  (p.x() * p.x() + p.y() * p.y());
    };
    change(sample.edge_u, out.range_u, out.beam_u);
    change(sample.edge_v, out.range_v, out.beam_v);
    out.range_m = range;
    out.beam = beam;
    out.intensity = second.reflection * cosine;
    return &MultipathCounts::bounces;
}

/// Follows one sample to the plane, and keeps what comes back. Returns whether the sample has to
/// be traced itself.
bool follow(const Context& context, std::uint32_t sample, std::uint32_t second, const Plane& plane,
            std::vector<Bounce>& bounces, MultipathCounts& counts) {
    const Sample& source = context.samples.items[sample];
    Bounce b;
    b.sample = sample;
    b.second = second;
    const Fate fate = bounce(context, source, plane, b);
    if (fate == stray) return true;
    ++(counts.*fate);
    if (fate == &MultipathCounts::bounces) {
        b.intensity *= context.materials[source.material].reflection;
        bounces.push_back(b);
    }
    return false;
}

/// Traces the samples and follows each to what it met itself.
void follow_traced(const Context& context, std::span<const std::uint32_t> chosen,
                   std::vector<Second>& seconds, std::vector<Bounce>& bounces,
                   MultipathCounts& counts) {
    const std::size_t first = seconds.size();
    trace(context, chosen, seconds, counts);
    constexpr float anywhere = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        const Second& own = seconds[first + k];
        follow(context, chosen[k], static_cast<std::uint32_t>(first + k),
               {&own, own.point, anywhere}, bounces, counts);
    }
}

/// Whether what a ray from the sonar to p_h meets lies before p_h. Where both are the same surface,
/// two ranges of one point are compared: each is off by its rounding across the surface, and that
/// counts for 1 / cos of the incidence along the ray.
bool hides(const Intersection& hit, const Second& second, const Ray& ray) {
    if (std::isinf(hit.distance_m)) return false;
    const auto along_ray = [&](float rounding_m, const Eigen::Vector3f& normal) {
        return rounding_m / std::fabs(normal.dot(ray.direction));
    };
    const float slack =
        along_ray(hit.rounding_m, hit.normal) + along_ray(second.rounding_m, second.normal);
    return !(hit.distance_m + slack >= second.point.norm());
}

/// Takes out the bounces from points that the sonar does not see.
void drop_hidden(const Context& context, const std::vector<Second>& seconds,
                 std::vector<Bounce>& bounces, MultipathCounts& counts) {
    constexpr std::uint32_t unasked = 0xFFFFFFFFU;
    std::vector<std::uint32_t> ray_of(seconds.size(), unasked);
    std::vector<Ray> rays;
    for (const Bounce& b : bounces) {
        if (ray_of[b.second] != unasked) continue;
        ray_of[b.second] = static_cast<std::uint32_t>(rays.size());
        rays.push_back({Eigen::Vector3f::Zero(), seconds[b.second].point.normalized()});
    }
    std::vector<Intersection> hits(rays.size());
    context.engine.intersect(context.T_world_sensor, rays, hits);
    counts.rays += rays.size();
    counts.hidden += std::erase_if(bounces, [&](const Bounce& b) {
        const std::uint32_t ray = ray_of[b.second];
        return hides(hits[ray], seconds[b.second], rays[ray]);
    });
}

}  // namespace

std::vector<Bounce> find_bounces(const Multipath& multipath, const View& view,
                                 const Samples& samples, std::span<const Material> materials,
                                 const VisibilityEngine& engine, const Pose& T_world_sensor,
                                 MultipathCounts& counts) {
    const Context context{view,
                          samples,
                          materials,
                          engine,
                          T_world_sensor,
                          static_cast<float>(view.bin_m()),
                          FieldOfView(view)};
    const Clusters clusters = cluster_samples(view, samples, multipath.cluster);
    counts.samples = clusters.members.size();
    counts.clusters = clusters.size();

    std::vector<std::uint32_t> chosen;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const auto members = clusters.of(c);
        chosen.push_back(members.front());
        if (members.size() > 1) chosen.push_back(members.back());
    }
    std::vector<Second> seconds;
    std::vector<Bounce> bounces;
    follow_traced(context, chosen, seconds, bounces, counts);

    chosen.clear();
    std::uint32_t end = 0;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const auto members = clusters.of(c);
        const std::uint32_t first = end;
        end += members.size() > 1 ? 2 : 1;
        if (members.size() < 3) continue;
        const Second& a = seconds[first];
        const Second& b = seconds[end - 1];
        const bool one = agree(a, b, same_plane_bins * context.bin_m);
        const Plane plane{&a, 0.5F * (a.point + b.point),
                          (a.point - b.point).norm() + context.bin_m};
        for (const std::uint32_t i : members.subspan(1, members.size() - 2)) {
            if (!one || follow(context, i, first, plane, bounces, counts)) chosen.push_back(i);
        }
    }
    follow_traced(context, chosen, seconds, bounces, counts);
    drop_hidden(context, seconds, bounces, counts);
    counts.bounces = bounces.size();
    return bounces;
}

}  // namespace sonarsim
