#include "simulate/visibility/rays/fine_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "core/groups.h"
#include "input/scene/mesh_topology.h"
#include "simulate/visibility/cut_triangle.h"
#include "simulate/visibility/view_volume.h"

namespace sonarsim {

namespace {

using Corners = std::array<Eigen::Vector3f, 3>;

// Surface is resolved if its radius is this many of the larger spacing.
constexpr float resolved_spacings = 2.0F;
// The size of a piece, in the smaller spacing.
constexpr float piece_spacings = 0.7F;

/// The triangles around a place.
struct Surroundings {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< mean of their unit normals
    float triangles = 0.0F;
    Eigen::Vector3f open = Eigen::Vector3f::Zero();  ///< sum of the sides opposite to the place
    float length_m = 0.0F;                           ///< the length of these sides

    /// True if the surface ends here: the sides are no loop.
    bool is_border() const { return open.norm() > 0.01F * length_m; }
};

/// A piece of fine surface and the facet that it is part of.
struct Piece {
    Sample sample{};
    std::uint32_t facet;
    std::uint32_t beam;
};

/// Cuts a triangle of the sensor frame into pieces of at most `size_m` that lie in the view.
void cut(const Corners& p, float size_m, const View& view, const BeamLocator& field, Piece piece,
         std::vector<Piece>& pieces) {
    const Eigen::Vector3f u = p[1] - p[0];
    const Eigen::Vector3f v = p[2] - p[0];
    // In double: in float, a needle's cross product is mostly cancellation.
    const Eigen::Vector3d cross = u.cast<double>().cross(v.cast<double>());
    Sample& sample = piece.sample;
    sample.normal = cross.normalized().cast<float>();
    const float height = -sample.normal.dot(p[0]);
    if (height < 0.0F) sample.normal = -sample.normal;
    sample.height_m = std::fabs(height);
    const float area_m2 = 0.5F * static_cast<float>(cross.norm());
    const auto reach_m = static_cast<float>(view.range_max_m);
    cut_triangle([&](float du, float dv) { return (du * u + dv * v).norm() / size_m; },
                 [&](const TrianglePart& part) {
                     const auto at = [&](const TrianglePlace& place) -> Eigen::Vector3f {
                         return p[0] + place.u * u + place.v * v;
                     };
                     sample.position = at(part.centroid);
                     const float range = sample.position.norm();
                     const float beam = field.beam(sample.position, range);
                     if (!(beam >= 0.0F && range < reach_m)) return;
                     const auto corner = [&](int k) { return at(part.corners[k]); };
                     sample.edge_u = 0.25F * (corner(1) + corner(2) - corner(0) - corner(3));
                     sample.edge_v = 0.25F * (corner(2) + corner(3) - corner(0) - corner(1));
                     sample.area_m2 = part.share * area_m2;
                     piece.beam = static_cast<std::uint32_t>(beam);
                     pieces.push_back(piece);
                 });
}

}  // namespace

float FineSurface::resolved_m(float distance_m, const RaySpacing& spacing) {
    return resolved_spacings * std::max(spacing.across, spacing.along) * distance_m;
}

FineSurface::FineSurface(const Scene& scene) : scene_(scene) {
    const std::vector<std::uint32_t> first = first_at_place(scene.vertices);
    std::vector<Surroundings> places(scene.vertices.size());
    const auto corners_of = [&](const std::array<std::uint32_t, 3>& triangle) -> Corners {
        return {scene.vertices[triangle[0]], scene.vertices[triangle[1]],
                scene.vertices[triangle[2]]};
    };
    for (const auto& triangle : scene.triangles) {
        const Corners p = corners_of(triangle);
        const Eigen::Vector3f normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3f side = p[(k + 2) % 3] - p[(k + 1) % 3];
            Surroundings& place = places[first[triangle[k]]];
            place.normal += normal;
            place.triangles += 1.0F;
            place.open += side;
            place.length_m += side.norm();
        }
    }
    for (Surroundings& place : places)
        place.normal /= std::max(place.triangles, 1.0F);
    radii_m_.reserve(scene.triangles.size());
    for (const auto& triangle : scene.triangles) {
        const Corners p = corners_of(triangle);
        float radius_m = std::numeric_limits<float>::infinity();
        float longest_m = 0.0F;
        bool is_border = false;
        for (int k = 0; k < 3; ++k) {
            const Surroundings& a = places[first[triangle[k]]];
            const Surroundings& b = places[first[triangle[(k + 1) % 3]]];
            const float side_m = (p[(k + 1) % 3] - p[k]).norm();
            const float turn = (b.normal - a.normal).norm();
            if (turn > 1e-3F) radius_m = std::min(radius_m, side_m / turn);
            longest_m = std::max(longest_m, side_m);
            is_border |= a.is_border();
        }
        const float width_m = (p[1] - p[0]).cross(p[2] - p[0]).norm() / longest_m;
        radii_m_.push_back(is_border ? std::min(radius_m, 0.5F * width_m) : radius_m);
    }
    for (std::size_t t = 0; t < radii_m_.size(); t += run_triangles)
        add_run(t);
}

void FineSurface::add_run(std::size_t first) {
    const std::size_t count = std::min(run_triangles, radii_m_.size() - first);
    const auto radii = std::span(radii_m_).subspan(first, count);
    runs_.push_back(
        {ball_around(scene_.vertices, std::span(scene_.triangles).subspan(first, count)),
         *std::ranges::min_element(radii)});
}

/// The numbers of the triangles whose runs may reach into the view.
std::vector<std::uint32_t> FineSurface::in_view(const ViewVolume& volume, const LocalPose& pose,
                                                float reach_m, const RaySpacing& spacing) const {
    std::vector<std::uint32_t> found;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
        const Run& run = runs_[r];
        if (run.min_radius_m >= resolved_m(reach_m + 2.0F * run.ball.radius_m, spacing)) continue;
        const Eigen::Vector3f centre = run.ball.centre - pose.position;
        if (run.min_radius_m >= resolved_m(centre.norm() + run.ball.radius_m, spacing) ||
            volume.containment(centre, run.ball.radius_m + volume.rounding_m()) ==
                Containment::outside)
            continue;
        const std::size_t end = std::min((r + 1) * run_triangles, radii_m_.size());
        for (auto t = static_cast<std::uint32_t>(r * run_triangles); t < end; ++t) {
            const Eigen::Vector3f& corner = scene_.vertices[scene_.triangles[t][0]];
            if (has(t, (corner - pose.position).norm(), spacing)) found.push_back(t);
        }
    }
    return found;
}

Samples FineSurface::seen(const Caster& caster, const View& view, const Pose& T_world_sensor,
                          const RaySpacing& spacing) const {
    const LocalPose pose = local_pose(T_world_sensor, scene_.origin);
    const Eigen::Matrix3f R_sensor_local = pose.rotation.transpose();
    const ViewVolume volume(view, T_world_sensor);
    const BeamLocator field(view);
    const auto reach_m = static_cast<float>(view.range_max_m);
    const float piece_rad = piece_spacings * std::min(spacing.across, spacing.along);
    std::vector<Piece> pieces;
    for (const std::uint32_t t : in_view(volume, pose, reach_m, spacing)) {
        Corners p;
        for (int k = 0; k < 3; ++k)
            p[k] = R_sensor_local * (scene_.vertices[scene_.triangles[t][k]] - pose.position);
        const Eigen::Vector3f middle = (p[0] + p[1] + p[2]) / 3.0F;
        float ball_m = volume.rounding_m();
        for (const Eigen::Vector3f& corner : p)
            ball_m = std::max(ball_m, (corner - middle).norm());
        if (volume.of_sensor_frame(middle, ball_m) == Containment::outside) continue;
        Piece piece{};
        for (Eigen::Vector3f* v : {&piece.sample.position, &piece.sample.normal,
                                   &piece.sample.edge_u, &piece.sample.edge_v})
            v->setZero();  // copies of what is not set yet would warn
        piece.facet = t;
        piece.sample.material = scene_.triangle_material[t];
        piece.sample.instance = scene_.triangle_instance[t];
        cut(p, piece_rad * middle.norm(), view, field, piece, pieces);
    }
    std::vector<std::uint32_t> beams;
    beams.reserve(pieces.size());
    for (const Piece& piece : pieces)
        beams.push_back(piece.beam);
    const std::vector<std::uint32_t> order = sort_into_groups(beams, view.beams).items;
    std::vector<Eigen::Vector3f> directions;
    directions.reserve(order.size());
    for (const std::uint32_t k : order)
        directions.emplace_back(pose.rotation * pieces[k].sample.position.normalized());
    std::vector<std::uint32_t> met(pieces.size());
    caster.cast(pose.position, directions, 1.01F * reach_m, met);
    Samples out;
    out.beam_begin.resize(static_cast<std::size_t>(view.beams) + 1);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Piece& piece = pieces[order[k]];
        if (met[k] != piece.facet) continue;
        out.items.push_back(piece.sample);
        ++out.beam_begin[piece.beam + 1];
    }
    std::partial_sum(out.beam_begin.begin(), out.beam_begin.end(), out.beam_begin.begin());
    return out;
}

}  // namespace sonarsim
