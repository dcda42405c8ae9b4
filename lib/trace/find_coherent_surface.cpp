#include "trace/find_coherent_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "trace/arrivals.h"
#include "trace/lay_maps.h"
#include "trace/visibility_test.h"
#include "visibility/cut_triangle.h"

namespace sonarsim {

namespace {

constexpr int parts_of_edge = 8;
// A ray meets the plate this far inside its border, as a share of the edge's part.
constexpr double inset_by_part = 0.05;
// A partly hidden plate is cut into parts if it is smaller than this share of its range.
constexpr double small_plate = 0.1;
constexpr float parts_of_plate = 8.0F;

bool is_in_view(const View& view, const Eigen::Vector3d& point) {
    const Eigen::Vector3f p = point.cast<float>();
    return arrival_range(p) <= static_cast<float>(view.range_max_m) && beam_of(view, p) >= 0;
}

class CoherentSurfaceFinder {
  public:
    CoherentSurfaceFinder(const CoherentFaces& faces, const Scene& scene,
                          const VisibilityEngine& engine, const Pose& T_world_sensor,
                          const View& view)
        : faces_(faces),
          scene_(scene),
          engine_(engine),
          T_world_sensor_(T_world_sensor),
          view_(view),
          R_sensor_world_(T_world_sensor.rotation.conjugate()),
          sensor_(T_world_sensor.translation - scene.origin) {}

    CoherentSurface find() {
        for (const ScenePlate& plate : faces_.plates)
            add_plate(plate);
        std::ranges::stable_sort(out_.faces, {}, [](const FaceOfPing& face) {
            return std::pair(face.instance, face.normal.x());
        });
        return std::move(out_);
    }

  private:
    Eigen::Vector3d placed(const Eigen::Vector3f& point) const {
        return R_sensor_world_ * (point.cast<double>() - sensor_);
    }
    Eigen::Vector3d turned(const Eigen::Vector3f& direction) const {
        return R_sensor_world_ * direction.cast<double>();
    }

    /// The plane of a face, if it is within the range.
    std::optional<FaceOfPing> face_at(const Eigen::Vector3f& point, const Eigen::Vector3f& normal,
                                      std::uint32_t material, std::uint32_t instance) const {
        FaceOfPing out{
            .instance = instance, .material = material, .normal = turned(normal), .height_m = 0.0};
        out.height_m = out.normal.dot(placed(point));
        if (out.height_m < 0.0) {
            out.normal = -out.normal;
            out.height_m = -out.height_m;
        }
        if (out.height_m > view_.range_max_m || !(out.height_m > 0.0)) return std::nullopt;
        return out;
    }

    void add_plate(const ScenePlate& plate) {
        const auto face =
            face_at(plate.border.front()[0], plate.normal, plate.material, plate.instance);
        if (!face) return;
        plate.mapped ? add_faces_of_texels(*face) : out_.faces.push_back(*face);
        PlateOfPing at;
        at.normal = face->normal;
        at.height_m = face->height_m;
        Eigen::AlignedBox3d box;
        for (const auto& side : plate.border) {
            const Eigen::Vector3d from = placed(side[0]);
            const Eigen::Vector3d to = placed(side[1]);
            box.extend(from);
            for (int k = 0; k < parts_of_edge; ++k) {
                const auto part = [&](int n) -> Eigen::Vector3d {
                    return from + (to - from) * (static_cast<double>(n) / parts_of_edge);
                };
                at.edges.push_back({part(k), part(k + 1)});
            }
        }
        const double size = box.diagonal().norm();
        const Seen seen = find_seen(at);
        if (plate.mapped && !at.foot_seen) return;
        // Its echo comes from the foot of the perpendicular.
        const auto texel = at_point(plate, at.height_m * at.normal);
        if (!texel) return;
        at.material = texel->material;
        at.strength = texel->strength;
        if (seen == Seen::partly && size < small_plate * box.center().norm())
            add_seen_parts(plate, at, static_cast<float>(size));
        else if (seen != Seen::none)
            out_.plates.push_back(std::move(at));
    }

    /// Adds the plane with each coherent material, since a map may lay any of them on it.
    void add_faces_of_texels(FaceOfPing face) {
        for (std::uint32_t m = 0; m < scene_.materials.size(); ++m) {
            if (!scene_.materials[m].roughness_m) continue;
            face.material = m;
            out_.faces.push_back(face);
        }
    }

    /// The material and strength of a face at a point: its own, or those of a texel; nothing if a
    /// texel is not coherent.
    std::optional<MappedPoint> at_point(const ScenePlate& face,
                                        const Eigen::Vector3d& point) const {
        if (!face.mapped) return MappedPoint{face.material, 1.0F};
        const MappedPoint texel = mapped_point(*scene_.maps, T_world_sensor_, point.cast<float>(),
                                               face.instance, face.material);
        if (!scene_.materials[texel.material].roughness_m) return std::nullopt;
        return texel;
    }

    enum class Seen { none, partly, all };

    /// Finds the edges of a plate that are in view and not hidden. Returns whether all, some or
    /// none of those in view are visible.
    Seen find_seen(PlateOfPing& plate) const {
        VisibilityTest points;
        std::vector<std::pair<std::size_t, bool*>> tested;
        double area = 0.0;  // positive if the border is counter-clockwise about the normal
        for (const PlateEdge& edge : plate.edges)
            area += plate.normal.dot(edge.from.cross(edge.to));
        const Eigen::Vector3d foot = plate.height_m * plate.normal;
        plate.foot_seen = is_in_view(view_, foot);
        if (plate.foot_seen) tested.emplace_back(points.add(foot), &plate.foot_seen);
        for (PlateEdge& edge : plate.edges) {
            const Eigen::Vector3d middle = 0.5 * (edge.from + edge.to);
            edge.seen = is_in_view(view_, edge.from) || is_in_view(view_, middle) ||
                        is_in_view(view_, edge.to);
            const Eigen::Vector3d inwards = plate.normal.cross(edge.to - edge.from);
            const double inset = std::copysign(inset_by_part, area);
            if (edge.seen) tested.emplace_back(points.add(middle + inset * inwards), &edge.seen);
        }
        points.trace(engine_, T_world_sensor_);
        for (auto& [point, seen] : tested)
            *seen = points.visible(point);
        const auto count = std::ranges::count_if(tested, [](const auto& of) { return *of.second; });
        if (count == 0) return Seen::none;
        return count == std::ssize(tested) ? Seen::all : Seen::partly;
    }

    /// Adds the parts of a plate that are not hidden, each with a closed border of its own. The
    /// diffraction at the edges of an open border would not cancel.
    void add_seen_parts(const ScenePlate& plate, const PlateOfPing& whole, float size_m) {
        VisibilityTest points;
        std::vector<PlateOfPing> parts;
        for (const auto& triangle : plate.triangles) {
            const Eigen::Vector3f u = triangle[1] - triangle[0];
            const Eigen::Vector3f v = triangle[2] - triangle[0];
            const auto size = [&](float s, float t) {
                return parts_of_plate / size_m * (s * u + t * v).norm();
            };
            const auto point = [&](const TrianglePlace& place) {
                return placed(triangle[0] + place.u * u + place.v * v);
            };
            cut_triangle(size, [&](const TrianglePart& cut) {
                PlateOfPing part;
                part.normal = whole.normal;
                part.height_m = whole.height_m;
                part.material = whole.material;
                part.strength = whole.strength;
                for (std::size_t k = 0; k < 4; ++k)
                    part.edges.push_back({point(cut.corners[k]), point(cut.corners[(k + 1) % 4])});
                points.add(point(cut.centroid));
                parts.push_back(std::move(part));
            });
        }
        points.trace(engine_, T_world_sensor_);
        for (std::size_t k = 0; k < parts.size(); ++k) {
            if (points.visible(k)) out_.plates.push_back(std::move(parts[k]));
        }
    }

    const CoherentFaces& faces_;
    const Scene& scene_;
    const VisibilityEngine& engine_;
    const Pose& T_world_sensor_;
    const View& view_;
    Eigen::Quaterniond R_sensor_world_;
    Eigen::Vector3d sensor_;
    CoherentSurface out_;
};

}  // namespace

CoherentSurface find_coherent_surface(const CoherentFaces& faces, const Scene& scene,
                                      const VisibilityEngine& engine, const Pose& T_world_sensor,
                                      const View& view) {
    return CoherentSurfaceFinder(faces, scene, engine, T_world_sensor, view).find();
}

}  // namespace sonarsim
