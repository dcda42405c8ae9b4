#include "trace/corners.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "core/elementary.h"
#include "core/units.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr float right_angle = 0.005F;  // cosine of 89.7 degrees
// Faces meet if they are closer than this share of their size.
constexpr float meeting_share = 1e-3F;
constexpr int parts_of_seam = 16;
constexpr int directions_of_aperture = 64;
constexpr int halvings = 12;
// The faces of a corner are tested for visibility at this share of the range from the middle of the
// aperture.
constexpr double aim_by_range = 0.01;
constexpr double least_reach = 1e-3;  // a share of the smallest face

struct Box {
    Eigen::AlignedBox3f box;
    float size_m = 0.0F;
};

Box box_of(const ScenePlate& plate) {
    Box out;
    for (const auto& side : plate.border)
        out.box.extend(side[0]);
    out.size_m = out.box.diagonal().norm();
    const Eigen::Vector3f slack = Eigen::Vector3f::Constant(meeting_share * out.size_m);
    out.box.min() -= slack;
    out.box.max() += slack;
    return out;
}

/// An interval of a line.
struct Interval {
    float low = 0.0F, high = 0.0F;
    bool empty = true;

    void add(float at) {
        low = empty ? at : std::min(low, at);
        high = empty ? at : std::max(high, at);
        empty = false;
    }
};

/// The part of a line in which a plate meets the plane of another one, from `origin` along it.
Interval meets_plane(const ScenePlate& plate, const ScenePlate& plane, float slack_m,
                     const Eigen::Vector3f& origin, const Eigen::Vector3f& along) {
    const auto off = [&](const Eigen::Vector3f& p) {
        return plane.normal.dot(p - plane.border.front()[0]);
    };
    Interval out;
    for (const auto& side : plate.border) {
        const float from = off(side[0]);
        const float to = off(side[1]);
        if (std::fabs(from) < slack_m)
            out.add((side[0] - origin).dot(along));
        else if (std::fabs(to) > slack_m && (from > 0.0F) != (to > 0.0F))
            out.add((side[0] + from / (from - to) * (side[1] - side[0]) - origin).dot(along));
    }
    return out;
}

/// A point of the first plate's plane, moved along its plane into the planes of the others, which
/// are at right angles to it and to each other.
Eigen::Vector3f common_point(const ScenePlate& first, std::span<const ScenePlate* const> others) {
    Eigen::Vector3f out = first.border.front()[0];
    for (const ScenePlate* const other : others)
        out += other->normal.dot(other->border.front()[0] - out) * other->normal;
    return out;
}

/// The seam of two plates at right angles: the part of a line that is on both.
bool find_seam(const ScenePlate& a, const ScenePlate& b, float size_m, SceneDihedral& out) {
    const float slack = meeting_share * size_m;
    const Eigen::Vector3f along = a.normal.cross(b.normal).normalized();
    const std::array<const ScenePlate*, 1> other{&b};
    const Eigen::Vector3f origin = common_point(a, other);
    const Interval of_a = meets_plane(a, b, slack, origin, along);
    const Interval of_b = meets_plane(b, a, slack, origin, along);
    if (of_a.empty || of_b.empty) return false;
    const float low = std::max(of_a.low, of_b.low);
    const float high = std::min(of_a.high, of_b.high);
    if (!(high - low > slack)) return false;
    out.from = origin + low * along;
    out.to = origin + high * along;
    return true;
}

bool is_on(const SceneDihedral& seam, const Eigen::Vector3f& point, float slack_m) {
    const Eigen::Vector3f along = (seam.to - seam.from).normalized();
    const float at = along.dot(point - seam.from);
    return at > -slack_m && at < (seam.to - seam.from).norm() + slack_m;
}

/// Returns whether a point of the plane of a face lies on it: a line from it crosses the border an
/// odd number of times.
bool holds(const CornerFace& face, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
           const Eigen::Vector3d& point) {
    const double x = point.dot(u);
    const double y = point.dot(v);
    bool inside = false;
    for (const auto& side : face.border) {
        const double y0 = side[0].dot(v) - y;
        const double y1 = side[1].dot(v) - y;
        if ((y0 > 0.0) == (y1 > 0.0)) continue;
        const double x0 = side[0].dot(u) - x;
        const double x1 = side[1].dot(u) - x;
        if (x0 + (x1 - x0) * y0 / (y0 - y1) > 0.0) inside = !inside;
    }
    return inside;
}

/// Finds the points where a ray through a place of the aperture meets the faces, reflected at each.
/// `place`: relative to `corner`, a point on all faces. `away`: the direction from the sonar.
/// Returns false if the ray misses a face.
template <std::size_t N>
bool find_hits(const std::array<CornerFace, N>& faces, const Eigen::Vector3d& corner,
               const Eigen::Vector3d& place, const Eigen::Vector3d& away,
               std::vector<Eigen::Vector3d>* hits) {
    for (std::size_t f = 0; f < N; ++f) {
        const double step = -place.dot(faces[f].outwards) / away.dot(faces[f].outwards);
        Eigen::Vector3d hit = place + step * away;
        // Reflect the point to the visible side of the other faces.
        for (std::size_t other = 0; other < N; ++other) {
            const Eigen::Vector3d& n = faces[other].outwards;
            if (other != f) hit += (std::fabs(hit.dot(n)) - hit.dot(n)) * n;
        }
        hit += corner;
        const Eigen::Vector3d& u = faces[(f + 1) % N].outwards;
        if (!holds(faces[f], u, faces[f].outwards.cross(u), hit)) return false;
        if (hits) hits->push_back(hit);
    }
    return true;
}

/// The distance that the aperture reaches in a direction.
template <std::size_t N>
double reach_of(const std::array<CornerFace, N>& faces, const Eigen::Vector3d& corner,
                const Eigen::Vector3d& towards, const Eigen::Vector3d& away, double most_m) {
    double low = least_reach * most_m;
    if (!find_hits(faces, corner, low * towards, away, nullptr)) return 0.0;
    double high = most_m;
    for (int step = 0; step < halvings; ++step) {
        const double middle = 0.5 * (low + high);
        (find_hits(faces, corner, middle * towards, away, nullptr) ? low : high) = middle;
    }
    return low;
}

/// An upper bound of the aperture's reach from the corner.
template <std::size_t N>
double most_reach(const std::array<CornerFace, N>& faces, const Eigen::Vector3d& corner) {
    double least = std::numeric_limits<double>::infinity();
    for (const CornerFace& face : faces) {
        double most = 0.0;
        for (const auto& side : face.border)
            most = std::max(most, (side[0] - corner).norm());
        least = std::min(least, most);
    }
    return least;
}

/// The pairs of plates at right angles whose boxes meet, in order. Boxes are compared in the order
/// of their beginning along x, so that a scene of many faces does not compare each with all.
std::vector<std::array<std::uint32_t, 2>> pairs_that_meet(const std::vector<ScenePlate>& plates,
                                                          const std::vector<Box>& boxes) {
    std::vector<std::uint32_t> order(plates.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto begin_of = [&](std::uint32_t k) { return boxes[k].box.min().x(); };
    std::ranges::stable_sort(order, {}, begin_of);
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (auto first = order.begin(); first != order.end(); ++first) {
        const Box& box = boxes[*first];
        for (auto other = std::next(first);
             other != order.end() && begin_of(*other) <= box.box.max().x(); ++other) {
            if (std::fabs(plates[*first].normal.dot(plates[*other].normal)) <= right_angle &&
                box.box.intersects(boxes[*other].box))
                pairs.push_back({std::min(*first, *other), std::max(*first, *other)});
        }
    }
    std::ranges::sort(pairs);
    return pairs;
}

template <std::size_t N>
std::vector<Mirror> mirrors_of(const std::array<CornerFace, N>& faces,
                               const Eigen::Vector3d& away) {
    std::vector<Mirror> out;
    out.reserve(faces.size());
    for (const CornerFace& face : faces)
        out.push_back({face.material, -away.dot(face.outwards)});
    return out;
}

}  // namespace

void find_corners(CoherentFaces& faces) {
    std::vector<Box> boxes;
    for (const ScenePlate& plate : faces.plates)
        boxes.push_back(box_of(plate));
    // The seams by the first of their plates.
    std::vector<std::vector<std::uint32_t>> seams_of(faces.plates.size());
    for (const auto& [a, b] : pairs_that_meet(faces.plates, boxes)) {
        SceneDihedral seam{.plates = {a, b}, .from = {}, .to = {}};
        const float size = std::min(boxes[a].size_m, boxes[b].size_m);
        if (!find_seam(faces.plates[a], faces.plates[b], size, seam)) continue;
        seams_of[a].push_back(static_cast<std::uint32_t>(faces.dihedrals.size()));
        faces.dihedrals.push_back(seam);
    }
    for (const SceneDihedral& ab : faces.dihedrals) {
        for (const std::uint32_t bc : seams_of[ab.plates[1]]) {
            const std::uint32_t c = faces.dihedrals[bc].plates[1];
            for (const std::uint32_t ac : seams_of[ab.plates[0]]) {
                if (faces.dihedrals[ac].plates[1] != c) continue;
                const std::array<const ScenePlate*, 2> others{&faces.plates[ab.plates[1]],
                                                              &faces.plates[c]};
                const Eigen::Vector3f apex = common_point(faces.plates[ab.plates[0]], others);
                const float slack =
                    meeting_share * std::min({boxes[ab.plates[0]].size_m,
                                              boxes[ab.plates[1]].size_m, boxes[c].size_m});
                if (is_on(ab, apex, slack) && is_on(faces.dihedrals[bc], apex, slack) &&
                    is_on(faces.dihedrals[ac], apex, slack))
                    faces.trihedrals.push_back({{ab.plates[0], ab.plates[1], c}, apex});
            }
        }
    }
}

std::vector<Aperture> dihedral_apertures(const std::array<CornerFace, 2>& faces,
                                         const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    std::vector<Aperture> out;
    const Eigen::Vector3d seam = (to - from).normalized();
    for (int k = 0; k < parts_of_seam; ++k) {
        const auto at = [&](double part) -> Eigen::Vector3d {
            return from + part / parts_of_seam * (to - from);
        };
        const Eigen::Vector3d middle = at(k + 0.5);
        const Eigen::Vector3d away = middle.normalized();
        const Eigen::Vector3d across = seam.cross(away).normalized();
        const double most = most_reach(faces, middle);
        const double left = reach_of(faces, middle, -across, away, most);
        const double right = reach_of(faces, middle, across, away, most);
        if (!(left + right > 0.0)) continue;
        Aperture part{.plate = plate_along(at(k), at(k + 1.0), across, left, right), .points = {}};
        part.plate.mirrors = mirrors_of(faces, away);
        const double near = aim_by_range * arrival_range(middle.cast<float>());
        const double place =
            right > left ? std::min(0.5 * right, near) : -std::min(0.5 * left, near);
        find_hits(faces, middle, place * across, away, &part.points);
        out.push_back(std::move(part));
    }
    return out;
}

std::optional<Aperture> trihedral_aperture(const std::array<CornerFace, 3>& faces,
                                           const Eigen::Vector3d& apex) {
    const Eigen::Vector3d away = apex.normalized();
    const Eigen::Vector3d u = away.unitOrthogonal();
    const Eigen::Vector3d v = away.cross(u);
    const double most = most_reach(faces, apex);
    std::vector<Eigen::Vector3d> corners;
    double widest = 0.0;
    std::size_t at_widest = 0;
    for (int k = 0; k < directions_of_aperture; ++k) {
        const SinCos turn = sincos(2.0 * pi * k / directions_of_aperture);
        const Eigen::Vector3d towards = turn.cos * u + turn.sin * v;
        const double reach = reach_of(faces, apex, towards, away, most);
        if (reach > widest) {
            widest = reach;
            at_widest = corners.size();
        }
        corners.emplace_back(apex + reach * towards);
    }
    if (!(widest > 0.0)) return std::nullopt;
    Aperture out;
    for (std::size_t k = 0; k < corners.size(); ++k)
        out.plate.edges.push_back({corners[k], corners[(k + 1) % corners.size()]});
    out.plate.normal = away;
    out.plate.height_m = away.dot(apex);
    out.plate.mirrors = mirrors_of(faces, away);
    const Eigen::Vector3d to_widest = corners[at_widest] - apex;
    const double place = std::min(0.5, aim_by_range * out.plate.height_m / widest);
    find_hits(faces, apex, place * to_widest, away, &out.points);
    return out;
}

}  // namespace sonarsim
