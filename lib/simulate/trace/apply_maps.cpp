#include "simulate/trace/apply_maps.h"

#include <utility>

#include "simulate/trace/arrivals.h"
#include "simulate/trace/ping_motion.h"
#include "simulate/trace/taper.h"

namespace sonarsim {

namespace {

/// A part of a sample, in the sensor frame and on the map.
struct MapPiece {
    Eigen::Vector3f position, u, v;  ///< centre and half edges
    Taper taper;
    GroundFootprint ground;
    float area_m2;

    /// The part of this piece between two places along u, -1 to 1 from end to end.
    MapPiece between(double low, double high) const {
        const double middle = 0.5 * (low + high);
        const double share = 0.5 * (high - low);
        const float width = 1.0F + taper.u * static_cast<float>(middle);  // over the mean
        MapPiece out = *this;
        out.position += static_cast<float>(middle) * u;
        out.u *= static_cast<float>(share);
        out.v *= width;
        if (width > 0.0F)
            out.taper = {taper.u * static_cast<float>(share) / width, taper.v / width};
        out.ground.centre += middle * ground.u;
        out.ground.u *= share;
        out.ground.v *= static_cast<double>(width);
        out.area_m2 *= static_cast<float>(share) * width;
        return out;
    }
    void swap_edges() {
        std::swap(taper.u, taper.v);
        std::swap(u, v);
        std::swap(ground.u, ground.v);
    }
};

/// Cuts the samples of a ping.
class GroundMapApplier {
  public:
    GroundMapApplier(const GroundMaps& maps, const View& view, const Pose& T_world_sensor,
                     const SoundProfile* profile, MapStrengths strengths)
        : maps_(maps),
          profile_(profile),
          strengths_(strengths),
          pose_(T_world_sensor),
          R_(T_world_sensor.rotation.toRotationMatrix().topRows<2>()),
          sensor_(T_world_sensor.translation.head<2>()),
          shape_(view.shape),
          range_min_m_(static_cast<float>(view.range_min_m)),
          bin_m_(static_cast<float>(view.bin_m())),
          depth_m_(static_cast<float>(depth_in_bins * view.bin_m())),
          sine_y_(static_cast<float>(view.azimuth_rad /
                                     (view.shape == ViewShape::fan ? view.beams : parts_of_cone))),
          sine_z_(static_cast<float>(view.elevation_rad / parts_of_cone)) {}

    /// Appends the pieces of a sample.
    void apply(const Sample& sample, std::vector<Sample>& out) {
        with_strength_ =
            strengths_ == MapStrengths::in_samples || sample.kind == SampleKind::target;
        if (!maps_.lie_on(sample.instance) || !(with_strength_ || maps_.have_materials())) {
            out.push_back(sample);
            return;
        }
        sample_ = &sample;
        MapPiece piece{
            sample.position,
            sample.edge_u,
            sample.edge_v,
            taper_of(sample, shape_),
            {ground_of(sample.position), from_above(sample.edge_u), from_above(sample.edge_v)},
            sample.area_m2};
        cut(piece, max_halvings, out);
    }

  private:
    static constexpr double depth_in_bins = 0.5;
    static constexpr int parts_of_cone = 8;  ///< across a cone or a side, which no beams divide
    static constexpr int max_halvings = 16;
    static constexpr float whole_piece = 0.95F;  ///< parts below a fortieth are not cut off

    Eigen::Vector2d from_above(const Eigen::Vector3f& v) const { return R_ * v.cast<double>(); }

    Eigen::Vector2d ground_of(const Eigen::Vector3f& p) const {
        if (profile_) return true_place(profile_, pose_, p.cast<double>()).head<2>();
        return from_above(p) + sensor_;
    }

    /// The extent of an edge over the greatest extent of a piece.
    float size_of(const Eigen::Vector3f& half_edge, const Arrival& at) const {
        const auto [depth, y, z] = extents_of(half_edge, at.direction);
        const float across = 2.0F / at.range_m;
        return std::max({2.0F * std::fabs(depth) / depth_m_, across * std::fabs(y) / sine_y_,
                         across * std::fabs(z) / sine_z_});
    }

    void cut(MapPiece piece, int halvings, std::vector<Sample>& out) {
        const auto alike =
            maps_.alike_over(sample_->instance, sample_->material, piece.ground, with_strength_);
        if (alike) return add(piece, alike->material, alike->strength, out);
        const Arrival at = arrival_of(piece.position);
        const float size_u = size_of(piece.u, at);
        const float size_v = size_of(piece.v, at);
        if (size_v > size_u) piece.swap_edges();
        // The sizes of a piece at the sonar are NaN; in this order of arguments it is not cut.
        if (std::max(size_u, size_v) > 1.0F && halvings > 0) {
            for (const double low : {-1.0, 0.0})
                cut(piece.between(low, low + 1.0), halvings - 1, out);
            return;
        }
        // Strips follow each other along `u`, the edge of less depth, so that ranges stay right.
        if (std::fabs(piece.u.dot(at.direction)) > std::fabs(piece.v.dot(at.direction)))
            piece.swap_edges();
        add_by_bins(piece, at, out);
    }

    /// Cuts a piece at the border between two range bins, so that each part has its own mean.
    void add_by_bins(MapPiece piece, const Arrival& at, std::vector<Sample>& out) {
        const float depth = piece.v.dot(at.direction);
        const float farthest = at.range_m + std::fabs(depth);
        const float border = range_min_m_ + bin_m_ * std::floor((farthest - range_min_m_) / bin_m_);
        const float place = (border - at.range_m) / depth;
        if (!(std::fabs(place) < whole_piece)) return add_strips(piece, out);
        piece.swap_edges();
        for (MapPiece part : {piece.between(-1.0, place), piece.between(place, 1.0)}) {
            part.swap_edges();
            add_strips(part, out);
        }
    }

    void add_strips(const MapPiece& piece, std::vector<Sample>& out) {
        maps_.shares_over(sample_->instance, sample_->material, piece.ground, shares_);
        double whole = 0.0;
        for (const MaterialShare& share : shares_)
            whole += share.area;
        double done = 0.0;
        for (const MaterialShare& share : shares_) {
            const double low = 2.0 * done / whole - 1.0;
            done += share.area;
            const double high = 2.0 * done / whole - 1.0;
            add(shares_.size() == 1 ? piece : piece.between(low, high), share.material,
                with_strength_ ? static_cast<float>(share.power / share.area) : 1.0F, out);
        }
    }

    void add(const MapPiece& piece, std::uint32_t material, float strength,
             std::vector<Sample>& out) const {
        Sample& sample = out.emplace_back(*sample_);
        sample.position = piece.position;
        sample.edge_u = piece.u;
        sample.edge_v = piece.v;
        sample.area_m2 = piece.area_m2;
        if (piece.u != sample_->edge_u || piece.v != sample_->edge_v) sample.wedge = 0.0F;
        sample.material = material;
        sample.strength = sample_->strength * strength;
    }

    const GroundMaps& maps_;
    const SoundProfile* profile_;
    MapStrengths strengths_;
    const Pose& pose_;
    Eigen::Matrix<double, 2, 3> R_;  ///< from the sensor frame to the world's x and y
    Eigen::Vector2d sensor_;
    ViewShape shape_;
    float range_min_m_, bin_m_;
    float depth_m_, sine_y_, sine_z_;  ///< the greatest extents of a piece
    const Sample* sample_ = nullptr;
    bool with_strength_ = true;  ///< its strength is that of the map
    std::vector<MaterialShare> shares_;
};

}  // namespace

void apply_maps(const GroundMaps& maps, const View& view, const Pose& T_world_sensor,
                Samples& samples, const SoundProfile* profile, MapStrengths strengths) {
    GroundMapApplier layer(maps, view, T_world_sensor, profile, strengths);
    std::vector<Sample> items;
    items.reserve(2 * samples.items.size());
    std::size_t next = 0;
    const auto apply_up_to = [&](std::size_t end) {
        for (; next < end; ++next)
            layer.apply(samples.items[next], items);
        return static_cast<std::uint32_t>(items.size());
    };
    for (std::uint32_t& begin : samples.beam_begin)
        begin = apply_up_to(begin);
    apply_up_to(samples.items.size());
    samples.items = std::move(items);
}

MappedPoint mapped_point(const GroundMaps& maps, const Pose& T_world_sensor,
                         const Eigen::Vector3f& point, std::uint32_t instance,
                         std::uint32_t material) {
    const Eigen::Vector3d world =
        T_world_sensor.rotation * point.cast<double>() + T_world_sensor.translation;
    return maps.at(instance, material, world.head<2>());
}

}  // namespace sonarsim
