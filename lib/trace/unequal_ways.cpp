#include "trace/unequal_ways.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "trace/arrivals.h"
#include "trace/bounce_tracer.h"

namespace sonarsim {

namespace {

/// The greatest distance between the end of a way and its piece: half a bin and a chosen bound on
/// the rounding of the rays.
float slack_at(const View& view, float range_m) {
    return 0.5F * static_cast<float>(view.bin_m()) + 1e-3F * range_m;
}

/// A piece of surface, or its image: place, normal, direction of the incident sound, and half
/// edges.
struct Piece {
    Eigen::Vector3f at, normal, direction, u, v;
};

/// The image over one more reflector, nearer to the sonar.
Piece image_over(const Way::Reflector& reflector, const Piece& piece) {
    const auto turned = [&](const Eigen::Vector3f& direction) -> Eigen::Vector3f {
        return specular_direction(direction, reflector.normal);
    };
    return {reflector.point + turned(piece.at - reflector.point), turned(piece.normal),
            turned(piece.direction), turned(piece.u), turned(piece.v)};
}

/// True if find_bounces() has the path: out straight and back over one reflector, or over one and
/// the water's surface.
bool is_bounce(const Way& way, unsigned chosen) {
    return chosen == 0 &&
           (way.reflections == 1 || (way.reflections == 2 && way.reflectors[1].is_water));
}

/// The image of a piece over the reflectors whose bits are set.
Piece image_over(const Way& way, unsigned chosen, Piece piece) {
    for (int k = way.reflections - 1; k >= 0; --k) {
        if ((chosen >> static_cast<unsigned>(k)) & 1U) piece = image_over(way.reflectors[k], piece);
    }
    return piece;
}

/// True if the image is known for this piece. A known image keeps the fewer reflections of the two.
bool is_known(const Eigen::Vector3f& image, int reflections, float slack_m,
              std::span<CandidatePath> of_piece) {
    for (CandidatePath& known : of_piece) {
        if ((known.path.point.at - image).squaredNorm() > slack_m * slack_m) continue;
        known.reflections = std::min(known.reflections, reflections);
        return true;
    }
    return false;
}

}  // namespace

void add_candidates(const TraceContext& trace, const BeamLocator& field, const Way& way,
                    const WayHit& at, const Sample& seen, std::vector<CandidatePath>& candidates) {
    if (way.reflections > Way::most_kept) return;
    const auto range_max = static_cast<float>(trace.view.range_max_m);
    const std::size_t first = candidates.size();
    const float seen_range = arrival_range(seen.position);
    const float seen_sine = seen.height_m / seen_range;
    const Piece piece{way.ray.origin + at.distance_m * way.ray.direction, at.normal,
                      way.ray.direction, way.unfold.transpose() * seen.edge_u,
                      way.unfold.transpose() * seen.edge_v};
    const unsigned all = (1U << static_cast<unsigned>(way.reflections)) - 1U;
    for (unsigned chosen = 0; chosen < all; ++chosen) {
        if (is_bounce(way, chosen)) continue;
        const Piece image = image_over(way, chosen, piece);
        const float range = arrival_range(image.at);
        if (!(arrival_range(range, seen_range) < range_max)) continue;
        const float sine = -image.normal.dot(image.at) / range;
        if (!(sine >= least_seen_cosine && field.beam(image.at, range) >= 0.0F)) continue;
        const int reflections = std::popcount(chosen);
        if (is_known(image.at, reflections, slack_at(trace.view, range),
                     std::span(candidates).subspan(first)))
            continue;
        SpecularPath path;
        path.point = {image.at, image.u, image.v};
        path.image_source = {seen.position, seen.edge_u, seen.edge_v};
        path.area_m2 = seen.area_m2;
        path.sine_of_point = sine;
        path.sine_of_image = seen_sine;
        path.sine_between = (sine + seen_sine) / (image.at / range + image.direction).norm();
        path.reflection = way.reflected * at.surface.strength;
        path.material = seen.material;
        path.sample = way.source;
        candidates.push_back({path, piece.at, reflections});
    }
}

void trace_candidates(const Multipath& multipath, const TraceContext& trace,
                      const std::optional<WaterMirror>& water,
                      std::vector<CandidatePath>& candidates, std::vector<SpecularPath>& arrived,
                      MultipathCounts& counts) {
    std::vector<Way> ways(candidates.size());
    for (std::uint32_t k = 0; k < candidates.size(); ++k) {
        ways[k].source = k;
        ways[k].ray = {Eigen::Vector3f::Zero(), arrival_of(candidates[k].path.point.at).departure};
    }
    while (!ways.empty()) {
        const std::vector<Intersection> hits = cast_ways(trace, ways, counts);
        std::vector<Way> further;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            Way& way = ways[i];
            CandidatePath& to = candidates[way.source];
            const float range = arrival_range(to.path.point.at);
            const float slack = slack_at(trace.view, range);
            const WayHit at = hit_of_way(trace, water, way.ray, hits[i]);
            const float left = range - way.length_m - at.distance_m;
            if (!(left >= -slack)) continue;
            if (way.reflections < to.reflections) {
                reflect(at, way);
                further.push_back(way);
                continue;
            }
            const Eigen::Vector3f end = way.ray.origin + at.distance_m * way.ray.direction;
            if (!(left <= slack && (end - to.place).norm() <= slack)) continue;
            to.path.reflection *= way.reflected;
            if (to.path.reflection >= multipath.retraced_least) arrived.push_back(to.path);
        }
        ways = std::move(further);
    }
    candidates.clear();
}

}  // namespace sonarsim
