#include <Eigen/Geometry>

#include "simulate/reference/reference.h"
#include "simulate/trace/apply_maps.h"
#include "simulate/trace/arrivals.h"
#include "simulate/trace/target_surface.h"
#include "simulate/trace/traced_ping.h"
#include "simulate/trace/visible_surface.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

namespace {

/// Images of points, added in parts: the expected powers of the parts sum to the image of all.
class EnergyImage {
  public:
    EnergyImage(const Scene& scene, const PingSettings& settings, const Pose& T_world_sensor,
                const VisibilityEngine& rays, const TargetSurface& targets)
        : scene_(scene),
          settings_(settings),
          rays_(rays),
          targets_(targets),
          pose_(local_pose(T_world_sensor, scene.origin)),
          R_sensor_local_(pose_.rotation.transpose()),
          sum_(static_cast<std::size_t>(settings.view.range_bins) * settings.view.beams),
          area_m2_(sum_.size()) {
        traced_.T_world_sensor = T_world_sensor;
        traced_.samples.items = targets.pieces;
        assign_to_first_beam();
        if (scene.maps) apply_maps(*scene.maps, settings.view, T_world_sensor, traced_.samples);
        traced_.samples.items.reserve(traced_.samples.items.size() + at_once);
    }

    void add(const SurfacePoint& point) {
        const auto range = static_cast<float>(point.range_m);
        const Eigen::Vector3f position = range * (R_sensor_local_ * point.direction);
        add_area(position, point.range_m, point.area_m2);
        if (targets_.has(point.facet.instance)) return;
        if (settings_.view.guards.count > 0 && !in_array_cones(settings_.view, position)) return;
        Sample& sample = traced_.samples.items.emplace_back();
        sample.position = position;
        sample.edge_u.setZero();
        sample.edge_v.setZero();
        const float side = point.facet.normal.dot(point.direction) > 0.0F ? -1.0F : 1.0F;
        sample.normal = side * (R_sensor_local_ * point.facet.normal);
        sample.height_m = static_cast<float>(point.range_m * point.cosine);
        sample.area_m2 = static_cast<float>(point.area_m2);
        const MappedPoint surface = surface_at(point, scene_, pose_);
        sample.material = surface.material;
        sample.strength = surface.strength;
        sample.instance = point.facet.instance;
        ++hits_;
        if (traced_.samples.items.size() >= at_once) form();
    }

    std::vector<double> take() {
        form();
        return std::move(sum_);
    }

    std::uint64_t hits() const { return hits_; }
    /// The visible surface in the bins where it lies, whatever beams receive it.
    const std::vector<double>& area_m2() const { return area_m2_; }

  private:
    static constexpr std::size_t at_once = 1U << 20U;

    void add_area(const Eigen::Vector3f& position, double range_m, double area_m2) {
        const View& view = settings_.view;
        const int beam = beam_of(view, position);
        const double bin = std::floor((range_m - view.range_min_m) / view.bin_m());
        if (beam < 0 || !(bin >= 0.0 && bin < view.range_bins)) return;
        area_m2_[static_cast<std::size_t>(bin) * view.beams + beam] += area_m2;
    }

    /// Adds the points behind the walls among the collected ones.
    void follow_through_walls() {
        std::vector<Sample>& items = traced_.samples.items;
        const std::size_t points = items.size();
        add_behind_walls(settings_.wall_transmissions,
                         {settings_.view, scene_, rays_, traced_.T_world_sensor}, traced_.samples);
        for (Sample& sample : std::span(items).subspan(points)) {
            const float range = arrival_range(sample.position);
            add_area(sample.position, static_cast<double>(range),
                     static_cast<double>(sample.area_m2));
            if (!scene_.maps) continue;
            const MappedPoint at = mapped_point(*scene_.maps, traced_.T_world_sensor,
                                                sample.position, sample.instance, sample.material);
            sample.material = at.material;
            sample.strength *= at.strength;
        }
    }

    /// The calibrated model assigns samples to beams itself.
    void assign_to_first_beam() {
        traced_.samples.beam_begin.assign(static_cast<std::size_t>(settings_.view.beams) + 1,
                                          static_cast<std::uint32_t>(traced_.samples.items.size()));
        traced_.samples.beam_begin.front() = 0;
    }

    void form() {
        if (traced_.samples.items.empty()) return;
        assign_to_first_beam();
        follow_through_walls();
        const Ping ping = form_image(traced_, settings_, scene_, {}, surface_alone);
        for (std::size_t k = 0; k < sum_.size(); ++k)
            sum_[k] += static_cast<double>(ping.intensity[k]);
        traced_.samples.items.clear();
    }

    const Scene& scene_;
    const PingSettings& settings_;
    const VisibilityEngine& rays_;
    const TargetSurface& targets_;
    LocalPose pose_;
    Eigen::Matrix3f R_sensor_local_;
    TracedPing traced_;
    std::vector<double> sum_;
    std::vector<double> area_m2_;
    std::uint64_t hits_ = 0;
};

}  // namespace

Reference cast_energy_reference(const Caster& caster, const Scene& scene,
                                const PingSettings& settings, const Pose& T_world_sensor,
                                const ReferenceGoal& goal) {
    const View view = widened_view(settings.view);
    const std::unique_ptr<VisibilityEngine> rays = make_rays_engine(scene, caster);
    TargetSurface targets;
    if (settings.targets) {
        targets = target_surface(*settings.targets, settings.view, scene, *rays, T_world_sensor);
    }
    const ReferenceView looking{caster, scene, view, T_world_sensor};
    return settled(settings.view, goal, [&](const RayLayout& layout) -> CastResult {
        EnergyImage image(scene, settings, T_world_sensor, *rays, targets);
        const std::uint64_t cast = cast_over_surface(
            looking, layout, [&](const SurfacePoint& point) { image.add(point); });
        std::vector<double> sum = image.take();
        std::vector<double> weight(sum.size(), 1.0);
        return {std::move(sum), std::move(weight), image.area_m2(), cast, image.hits()};
    });
}

}  // namespace sonarsim
