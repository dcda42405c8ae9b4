#include <algorithm>

#include "core/elementary.h"
#include "simulate/visibility/octree/tree.h"

namespace sonarsim {

namespace {

/// The gap of ranges that ends a cluster.
constexpr float gap_leaves = 4.0F;

struct Vote {
    std::uint64_t pixel;  ///< index of azimuth and elevation, azimuth first
    int beam;
    float range_m;
    Eigen::Vector3f centre;  ///< sensor frame
    Eigen::Vector3f normal;
    std::uint32_t triangle;
};

/// The leaves in view.
class Votes {
  public:
    Votes(const View& view, const ViewVolume& volume, double leaf_m)
        : view_(view), volume_(volume), leaf_m_(static_cast<float>(leaf_m)) {
        // A leaf at half the greatest range.
        const auto middle = static_cast<float>(0.5 * view.range_max_m);
        row_height_ = static_cast<double>(leaf_m_ / middle);
    }

    void add(const TileInView& tile) {
        for (const Leaf& one : *tile.leaves) {
            const Eigen::Vector3f at(one.x, one.y, one.z);
            const Eigen::Vector3f centre = tile.corner.array() + leaf_m_ * (at.array() + 0.5F);
            const bool may_be_outside = tile.containment != Containment::inside;
            if (may_be_outside && volume_.contains_cube(centre, leaf_m_) == Containment::outside)
                continue;
            add(one, volume_.R_sensor_local() * centre);
        }
    }

    /// The leaves of the first cluster of each pixel.
    Samples samples(const Scene& scene) {
        std::stable_sort(votes_.begin(), votes_.end(), [](const Vote& a, const Vote& b) {
            return a.pixel != b.pixel ? a.pixel < b.pixel : a.range_m < b.range_m;
        });
        Samples samples;
        samples.dropped = dropped_;
        samples.beam_begin.assign(view_.beams + 1, 0);
        bool visible = false;
        for (std::size_t k = 0; k < votes_.size(); ++k) {
            const Vote& vote = votes_[k];
            const bool first = k == 0 || votes_[k - 1].pixel != vote.pixel;
            visible =
                first || (visible && vote.range_m - votes_[k - 1].range_m <= gap_leaves * leaf_m_);
            if (!visible) continue;
            samples.items.push_back(sample_of(vote, scene));
            ++samples.beam_begin[vote.beam + 1];
        }
        for (int b = 0; b < view_.beams; ++b)
            samples.beam_begin[b + 1] += samples.beam_begin[b];
        return samples;
    }

  private:
    /// `centre` is in the sensor frame.
    void add(const Leaf& leaf, const Eigen::Vector3f& centre) {
        const double range = centre.norm();
        if (!(range > 0.0)) {
            ++dropped_;  // the leaf's centre is at the sonar and has no direction
            return;
        }
        const int beam = beam_of(view_, centre);
        if (beam < 0) return;
        const double azimuth = arctan2(centre.y(), centre.x()) + 0.5 * view_.azimuth_rad;
        const double elevation = arcsin(centre.z() / range) + 0.5 * view_.elevation_rad;
        // A pixel is as wide as a beam of a fan; the wide beams of other views are divided.
        const auto column = view_.shape == ViewShape::fan
                                ? beam
                                : static_cast<int>(std::max(azimuth, 0.0) / row_height_);
        const auto row = static_cast<int>(std::max(elevation, 0.0) / row_height_);
        const Eigen::Vector3f normal = volume_.R_sensor_local() * leaf.normal;
        votes_.push_back(
            {static_cast<std::uint64_t>(column) << 32U | static_cast<std::uint64_t>(row), beam,
             static_cast<float>(range), centre,
             normal.dot(centre) > 0.0F ? Eigen::Vector3f(-normal) : normal, leaf.triangle});
    }

    static Sample sample_of(const Vote& vote, const Scene& scene) {
        Sample sample;
        sample.position = vote.centre;
        sample.edge_u = sample.edge_v = Eigen::Vector3f::Zero();
        sample.normal = vote.normal;
        sample.height_m = -vote.normal.dot(vote.centre);
        sample.area_m2 = 1.0F;
        sample.material = scene.triangle_material[vote.triangle];
        sample.instance = scene.triangle_instance[vote.triangle];
        return sample;
    }

    const View& view_;
    const ViewVolume& volume_;
    float leaf_m_;
    double row_height_;
    std::vector<Vote> votes_;
    std::uint64_t dropped_ = 0;
};

class OctreeEngine final : public VisibilityEngine {
  public:
    OctreeEngine(const Scene& scene, double leaf_m)
        : VisibilityEngine(scene, Caster(scene)), tree_(scene, caster(), leaf_m) {}

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override {
        const ViewVolume volume(
            view, {T_world_sensor.rotation, T_world_sensor.translation - scene().origin});
        Votes votes(view, volume, tree_.leaf_m());
        for (const TileInView& tile : tree_.tiles_in_view(volume))
            votes.add(tile);
        return votes.samples(scene());
    }

  private:
    mutable Octree tree_;  ///< grows, which changes no result
};

}  // namespace

std::unique_ptr<VisibilityEngine> make_octree_engine(const Scene& scene, double leaf_m) {
    return std::make_unique<OctreeEngine>(scene, leaf_m);
}

}  // namespace sonarsim
