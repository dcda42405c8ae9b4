#include "simulate/trace/target_surface.h"

#include <array>
#include <iterator>
#include <utility>

#include "core/groups.h"
#include "input/scene/maps/ground_maps.h"
#include "input/scene/materials.h"
#include "simulate/trace/arrivals.h"
#include "simulate/visibility/view.h"
#include "simulate/water/water_ray.h"

namespace sonarsim {

namespace {

// Resolution cells below which an object or its highlight is a target: an engine is right to 1 dB.
constexpr float max_cells = 4.0F;
// The sonar is outside of the ball around a target.
constexpr float min_distance_by_radius = 1.05F;
// Vertices are moved by up to this share of a target's radius when they are joined.
constexpr float weld_slack = 2e-5F;
// The greatest size of a piece, as a share of a target's diameter: within 0.5 dB.
constexpr float part_by_diameter = 1.0F / 8.0F;
// The greatest size of a piece across a view or its only beam, as a share of that: a piece is
// received as a whole.
constexpr float part_by_view = 1.0F / 16.0F;
// Size of a part of a highlight that one ray decides on, relative to the highlight's own, curvature
// radius times slope; no smaller than a share of a resolution cell.
constexpr float glint_by_highlight = 1.5F;
constexpr float min_glint_by_cell = 0.25F;
// A part of a triangle is halved at most this many times, to a thousandth of its sides and less.
constexpr int max_halvings = 22;

/// A corner of a piece of a triangle, in the sensor frame.
struct Corner {
    Eigen::Vector3f place;
    Eigen::Vector3f normal;  ///< interpolated between those of the triangle, facing the sonar
    Eigen::Vector3f off;     ///< difference between the normal and the direction to the sonar

    Corner(const Eigen::Vector3f& at, const Eigen::Vector3f& n) : place(at), normal(n) {
        // Nearly of unit length: normals are at least 0.9 long.
        const float to_unit = 1.5F - 0.5F * n.squaredNorm();
        off = to_unit * n + at / arrival_range(at);
    }
};
using Corners = std::array<Corner, 3>;

/// A lower bound of the length of `off` on a triangle. Highlights lie below a few slopes.
float min_off(const Corners& corners) {
    const Eigen::Vector3f middle = (corners[0].off + corners[1].off + corners[2].off) / 3.0F;
    float spread2 = 0.0F;
    for (const Corner& corner : corners)
        spread2 = std::max(spread2, (corner.off - middle).squaredNorm());
    return middle.norm() - std::sqrt(spread2);
}

/// The effect of sound that bends on a target: see ApparentPlace.
struct Bending {
    float strength = 1.0F, off_per_m = 0.0F;
};

/// The angles within which a view receives, beside one of its axes.
struct ViewSlab {
    int axis;
    float half_sine;      ///< sine of half the angle
    float part_m = 0.0F;  ///< the greatest extent of a piece along the axis

    ViewSlab(int number, double angle_rad)
        : axis(number), half_sine(sincos_float(0.5 * std::min(angle_rad, pi)).sin) {}

    /// True if a triangle lies outside: what is beyond a side lies in a convex cone.
    bool is_beside(const Corners& corners) const {
        const auto is_beyond = [&](float side) {
            return std::ranges::all_of(corners, [&](const Corner& corner) {
                return side * corner.place[axis] > half_sine * arrival_range(corner.place);
            });
        };
        return is_beyond(1.0F) || is_beyond(-1.0F);
    }
};

/// Cuts the objects of a ping into pieces.
class TargetSampler {
  public:
    TargetSampler(const View& view, const Scene& scene)
        : view_(view), field_(view), volume_(widened_view(view), Pose{}), maps_(scene.maps.get()) {
        for (const Material& material : scene.materials)
            slopes_.push_back(static_cast<float>(facet_slope(material)));
        slabs_.emplace_back(2, view.elevation_rad);
        if (view.beams == 1) slabs_.emplace_back(1, view.azimuth_rad);
    }

    /// Cuts an object. False if it lies outside or is large enough for an engine's samples.
    bool add(const PlacedTarget& placed, const TargetShape& shape,
             const Eigen::Affine3f& T_sensor_shape, const Bending& bending) {
        piece_.strength = bending.strength;
        const float scale = T_sensor_shape.linear().col(0).norm();
        const Eigen::Vector3f centre = T_sensor_shape * shape.centre;
        const float radius = scale * shape.radius_m;
        const float range = arrival_range(centre);
        if (range < min_distance_by_radius * radius ||
            volume_.contains_in_sensor_frame(centre, radius + volume_.rounding_m()) ==
                Containment::outside)
            return false;
        const float cell = std::max(static_cast<float>(resolved_width_rad(view_)) * range,
                                    static_cast<float>(view_.bin_m()));
        const float highlight =
            shape.curvature_m > 0.0F ? scale * shape.curvature_m * placed.min_slope : radius;
        // On a coarse mesh an engine sees facets where the surface is curved.
        const bool is_smooth = shape.turn <= placed.min_slope;
        if (highlight > max_cells * cell && is_smooth) return false;
        part_m_ = part_by_diameter * 2.0F * radius;
        for (ViewSlab& slab : slabs_)
            slab.part_m = part_by_view * 2.0F * slab.half_sine * range;
        min_glint_m_ = std::min(min_glint_by_cell * cell, part_m_);
        slack_m_ = (weld_slack + bending.off_per_m) * radius;
        cut(placed, shape, T_sensor_shape, scale);
        return true;
    }

    /// The pieces that are seen.
    std::vector<Sample> take_visible(const VisibilityEngine& engine, const Pose& T_world_sensor) {
        const std::vector<bool> visible = engine.visible(T_world_sensor, sights_);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            if (visible[sight_of_[k]]) pieces_[kept++] = pieces_[k];
        }
        pieces_.resize(kept);
        return std::move(pieces_);
    }

  private:
    void cut(const PlacedTarget& placed, const TargetShape& shape,
             const Eigen::Affine3f& T_sensor_shape, float scale) {
        const Eigen::Matrix3f R = T_sensor_shape.linear() / scale;
        const bool is_mapped = maps_ && maps_->lie_on(placed.instance);
        last_point_.reset();
        piece_.instance = placed.instance;
        for (const TargetTriangle& triangle : shape.triangles) {
            const auto place = [&](int k) -> Eigen::Vector3f {
                return T_sensor_shape * shape.vertices[triangle.corners[k]];
            };
            flat_normal_ = R * triangle.normal;
            const float height = -flat_normal_.dot(place(0));
            if (shape.closed && !(height > 0.0F)) continue;
            const float side = height < 0.0F ? -1.0F : 1.0F;
            flat_normal_ *= side;
            curvature_m_ = side * scale * triangle.curvature_m;
            slope_ = is_mapped ? placed.min_slope : slopes_[triangle.material];
            piece_.material = triangle.material;
            piece_.kind = SampleKind::target;
            piece_.number = triangle.region + 1;
            const auto corner = [&](int k) {
                return Corner(place(k), side * (R * triangle.normals[k]));
            };
            halve({corner(0), corner(1), corner(2)}, max_halvings, slope_ > 0.0F);
        }
    }

    /// Halves a part of the triangle until it is small and, where a highlight may lie, its normal
    /// turns by about a slope. `may_glint`: a highlight may lie on the whole that it is a part of.
    void halve(const Corners& corners, int halvings, bool may_glint) {
        const bool glints = may_glint && min_off(corners) <= highlight_slopes * slope_;
        const float per_part = 1.0F / part_m_;
        const float per_turn = glints ? 1.0F / slope_ : 0.0F;
        int longest = -1;
        float size = 1.0F;
        for (int k = 0; k < 3; ++k) {
            const Corner& from = corners[k];
            const Corner& to = corners[(k + 1) % 3];
            const Eigen::Vector3f side = to.place - from.place;
            float side_size =
                std::max(per_part * side.norm(), per_turn * (to.off - from.off).norm());
            for (const ViewSlab& slab : slabs_)
                side_size = std::max(side_size, std::fabs(side[slab.axis]) / slab.part_m);
            if (!(side_size > size)) continue;
            size = side_size;
            longest = k;
        }
        if (longest < 0 || halvings == 0) return add_piece(corners, glints);
        const auto is_beside = [&](const ViewSlab& slab) { return slab.is_beside(corners); };
        if (std::ranges::any_of(slabs_, is_beside)) return;
        const Corner& a = corners[longest];
        const Corner& b = corners[(longest + 1) % 3];
        const Corner& c = corners[(longest + 2) % 3];
        const Corner middle(0.5F * (a.place + b.place), 0.5F * (a.normal + b.normal));
        halve({a, middle, c}, halvings - 1, glints);
        halve({middle, b, c}, halvings - 1, glints);
    }

    void add_piece(const Corners& corners, bool glints) {
        // From b to c is the shortest side: the edges of the footprint are far from parallel.
        const auto length2 = [&](int k) {
            return (corners[(k + 1) % 3].place - corners[k].place).squaredNorm();
        };
        const int shortest =
            std::min({0, 1, 2}, [&](int i, int j) { return length2(i) < length2(j); });
        const Corner& a = corners[(shortest + 2) % 3];
        const Corner& b = corners[shortest];
        const Corner& c = corners[(shortest + 1) % 3];
        const Eigen::Vector3f middle = (a.place + b.place + c.place) / 3.0F;
        if (!field_.contains(middle)) return;
        look_at(middle, glints);
        const Eigen::Vector3f n = (a.normal + b.normal + c.normal) / 3.0F;
        const float length = n.norm();
        const float flat_m2 = 0.5F * (b.place - a.place).cross(c.place - a.place).norm();
        piece_.normal = n / length;
        piece_.position = middle + curvature_m_ * (1.0F - length) * piece_.normal;
        // The edges are those of a parallelogram with the area of the triangle.
        piece_.edge_u = 0.25F * (b.place + c.place - 2.0F * a.place);
        piece_.edge_v = 0.25F * (c.place - b.place);
        piece_.height_m = std::max(-piece_.position.dot(piece_.normal), 0.0F);
        piece_.area_m2 =
            flat_m2 * std::max(flat_normal_.dot(piece_.normal), 0.0F) / (length * length);
        pieces_.push_back(piece_);
        sight_of_.push_back(static_cast<std::uint32_t>(sights_.size() - 1));
    }

    /// Aims a ray at a piece, unless the last one arrives on the same part of its surface.
    void look_at(const Eigen::Vector3f& middle, bool glints) {
        const float glint_m = glint_by_highlight * std::fabs(curvature_m_) * slope_;
        const float part_m = glints ? std::clamp(glint_m, min_glint_m_, part_m_) : part_m_;
        if (last_point_ && (middle - *last_point_).norm() < 0.5F * part_m &&
            flat_normal_.dot(last_normal_) > 0.9F)
            return;
        sights_.push_back(
            {middle, std::fabs(flat_normal_.dot(arrival_of(middle).direction)), slack_m_});
        last_point_ = middle;
        last_normal_ = flat_normal_;
    }

    const View& view_;
    GuardedField field_;
    ViewVolume volume_;
    const GroundMaps* maps_;  ///< null: none
    std::vector<ViewSlab> slabs_;
    std::vector<float> slopes_;  ///< RMS slopes of the materials' facets
    // The target that is cut:
    float part_m_ = 0.0F;       ///< the greatest size of a piece
    float min_glint_m_ = 0.0F;  ///< the least size of a part of a highlight that one ray decides on
    float slack_m_ = 0.0F;      ///< the way by which its places are off at most
    // The triangle that is cut:
    Eigen::Vector3f flat_normal_ = Eigen::Vector3f::Zero();  ///< facing the sonar
    float curvature_m_ = 0.0F;  ///< as in TargetTriangle, negative if hollow
    float slope_ = 0.0F;        ///< RMS slope of its facets; 0: none
    Sample piece_{};

    std::vector<Sample> pieces_;
    std::vector<std::uint32_t> sight_of_;
    std::vector<SightPoint> sights_;
    std::optional<Eigen::Vector3f> last_point_;
    Eigen::Vector3f last_normal_ = Eigen::Vector3f::Zero();
};

Eigen::Affine3d in_world(const PlacedTarget& placed, const Scene& scene,
                         std::span<const Pose> T_world_body) {
    return placed.body ? affine(T_world_body[*placed.body])
                       : Eigen::Translation3d(scene.origin) * placed.T_local_shape.cast<double>();
}

}  // namespace

TargetSurface target_surface(const TargetShapes& shapes, const View& view, const Scene& scene,
                             const VisibilityEngine& engine, const Pose& T_world_sensor) {
    TargetSurface out;
    TargetSampler sampler(view, scene);
    const std::span<const Pose> bodies = engine.body_poses();
    for (const PlacedTarget& placed : shapes.placed) {
        if (placed.body && bodies.empty()) continue;  // without a pose it is invisible
        const TargetShape& shape = shapes.shapes[placed.shape];
        Eigen::Affine3d T_world_shape = in_world(placed, scene, bodies);
        Bending bending;
        if (scene.sound_profile) {
            // An object is small, so it appears as a whole where its centre does.
            const Eigen::Vector3d& source = T_world_sensor.translation;
            const auto appears = apparent_place(*scene.sound_profile, source,
                                                T_world_shape * shape.centre.cast<double>());
            if (!appears) continue;
            T_world_shape = Eigen::Translation3d(source + appears->apparent) * appears->R *
                            Eigen::Translation3d(-appears->place) * T_world_shape;
            bending = {static_cast<float>(appears->strength),
                       static_cast<float>(appears->off_per_m)};
        }
        const Eigen::Affine3d T_sensor_shape =
            affine(T_world_sensor).inverse(Eigen::Isometry) * T_world_shape;
        if (sampler.add(placed, shape, T_sensor_shape.cast<float>(), bending))
            out.instances.push_back(placed.instance);
    }
    std::ranges::sort(out.instances);
    if (!out.instances.empty()) out.pieces = sampler.take_visible(engine, T_world_sensor);
    return out;
}

void replace_samples(const TargetSurface& targets, const View& view, Samples& samples) {
    if (targets.instances.empty()) return;
    const auto is_replaced = [&](const Sample& sample) { return targets.has(sample.instance); };
    std::vector<Sample> outside;
    std::ranges::remove_copy_if(samples.in_no_beam(), std::back_inserter(outside), is_replaced);
    const BeamLocator field(view);
    std::vector<std::uint32_t> beam_of_piece;
    for (const Sample& piece : targets.pieces) {
        const float beam = field.beam(piece.position, arrival_range(piece.position));
        if (beam < 0.0F) outside.push_back(piece);
        beam_of_piece.push_back(beam < 0.0F ? no_group : static_cast<std::uint32_t>(beam));
    }
    const Groups by_beam = sort_into_groups(beam_of_piece, view.beams);
    Samples merged{.items = {}, .beam_begin = {0}, .dropped = samples.dropped};
    merged.items.reserve(samples.items.size() + targets.pieces.size());
    for (int j = 0; j < view.beams; ++j) {
        std::ranges::remove_copy_if(samples.beam(j), std::back_inserter(merged.items), is_replaced);
        for (std::uint32_t k = by_beam.begin[j]; k < by_beam.begin[j + 1]; ++k)
            merged.items.push_back(targets.pieces[by_beam.items[k]]);
        merged.beam_begin.push_back(static_cast<std::uint32_t>(merged.items.size()));
    }
    merged.items.insert(merged.items.end(), outside.begin(), outside.end());
    samples = std::move(merged);
}

}  // namespace sonarsim
