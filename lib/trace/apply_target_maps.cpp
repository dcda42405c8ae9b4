#include "trace/apply_target_maps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "trace/arrivals.h"

namespace sonarsim {

namespace {

// The view of a sonar of one or two beams is several beams wide, so it is divided by this number.
constexpr int parts_across = 32;

class TargetMapLayer {
  public:
    TargetMapLayer(const GroundMaps& maps, const View& view, const Pose& T_world_sensor)
        : maps_(maps),
          R_(T_world_sensor.rotation.toRotationMatrix()),
          sensor_(T_world_sensor.translation),
          per_depth_(static_cast<float>(2.0 / view.bin_m())) {
        const double width = view.shape == ViewShape::fan ? view.azimuth_rad / view.beams
                                                          : view.elevation_rad / parts_across;
        per_width_ = static_cast<float>(2.0 / width);
    }

    /// Appends the parts of a facet.
    void lay(const TargetFacet& facet, std::vector<TargetFacet>& out) {
        if (!maps_.lie_on(facet.instance)) {
            out.push_back(facet);
            return;
        }
        const Eigen::Vector3f u = facet.corners[1] - facet.corners[0];
        const Eigen::Vector3f v = facet.corners[2] - facet.corners[0];
        const Eigen::Vector3f middle = facet.corners[0] + (u + v) / 3.0F;
        // The corners lie up to two thirds of an edge from the middle.
        const auto alike = maps_.alike_over(facet.instance, facet.material,
                                            footprint(middle, 2.0F / 3.0F * u, 2.0F / 3.0F * v));
        if (alike) return add(facet, alike->material, alike->strength, out);
        const Arrival at = arrival_of(middle);
        const auto size = [&](float du, float dv) {
            const Eigen::Vector3f edge = du * u + dv * v;
            return std::max(per_depth_ * std::fabs(edge.dot(at.direction)),
                            per_width_ * edge.norm() / at.range_m);
        };
        cut_triangle(size, [&](const TrianglePart& part) { add_part(facet, part, out); });
    }

  private:
    GroundFootprint footprint(const Eigen::Vector3f& centre, const Eigen::Vector3f& u,
                              const Eigen::Vector3f& v) const {
        const auto from_above = [&](const Eigen::Vector3f& p) -> Eigen::Vector2d {
            return (R_ * p.cast<double>()).head<2>();
        };
        return {from_above(centre) + sensor_.head<2>(), from_above(u), from_above(v)};
    }

    void add_part(const TargetFacet& facet, const TrianglePart& part,
                  std::vector<TargetFacet>& out) {
        const auto at = [&](const TrianglePlace& place) -> Eigen::Vector3f {
            const auto& of = facet.corners;
            return of[0] + place.u * (of[1] - of[0]) + place.v * (of[2] - of[0]);
        };
        const Eigen::Vector3f a = at(part.corners[0]), b = at(part.corners[1]);
        const Eigen::Vector3f c = at(part.corners[2]), d = at(part.corners[3]);
        maps_.shares_over(
            facet.instance, facet.material,
            footprint(at(part.centroid), 0.25F * (b + c - a - d), 0.25F * (c + d - a - b)),
            shares_);
        for (const MaterialShare& share : shares_) {
            for_each_triangle(facet, part, [&](const TargetFacet& piece) {
                add(piece, share.material, static_cast<float>(share.power), out);
            });
        }
    }

    static void add(const TargetFacet& facet, std::uint32_t material, float strength,
                    std::vector<TargetFacet>& out) {
        TargetFacet& mapped = out.emplace_back(facet);
        mapped.material = material;
        mapped.strength = facet.strength * strength;
    }

    const GroundMaps& maps_;
    Eigen::Matrix3d R_;
    Eigen::Vector3d sensor_;
    float per_depth_, per_width_;
    std::vector<MaterialShare> shares_;
};

}  // namespace

void apply_maps_on_targets(const GroundMaps& maps, const View& view, const Pose& T_world_sensor,
                           std::vector<TargetFacet>& facets) {
    TargetMapLayer layer(maps, view, T_world_sensor);
    std::vector<TargetFacet> out;
    out.reserve(facets.size());
    for (const TargetFacet& facet : facets)
        layer.lay(facet, out);
    facets = std::move(out);
}

}  // namespace sonarsim
