#include "simulate/trace/surface_echoes.h"

#include <Eigen/Geometry>
#include <iterator>
#include <limits>
#include <utility>

#include "simulate/calibrated/equation/specular_echoes.h"
#include "simulate/calibrated/kind_echoes.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr int cells = 512;  // y / r is divided into these

/// The cells of y / r that a sample may reach, and its ranges.
struct Reach {
    int first_cell, last_cell;
    float near_m, far_m;
};

int cell_of(float sine) {
    return std::clamp(static_cast<int>(0.5F * cells * (sine + 1.0F)), 0, cells - 1);
}

/// A point within h of one at the range r lies within the angle asin(h / r) <= h / (r - h) of it,
/// and so does its y / r. A quarter of a cell more makes up for rounding.
Reach reach_of(const Sample& sample) {
    const Arrival at = arrival_of(sample.position);
    const float r = at.range_m;
    // At least the sum of the lengths of its half edges.
    const float h = std::sqrt(2.0F * (sample.edge_u.squaredNorm() + sample.edge_v.squaredNorm()));
    const float sine = at.direction.y();
    const float half_sine = (h < r ? std::min(h / (r - h), 2.0F) : 2.0F) + 0.5F / cells;
    return {cell_of(sine - half_sine), cell_of(sine + half_sine), r - h, r + h};
}

/// The directions and ranges at which a line array may receive objects that are no background, or
/// lose surface to their shadows: the cones of their visible samples, from just before them on.
class NearObjects {
  public:
    explicit NearObjects(const SceneObjects& objects) : objects_(objects) {}

    /// Adds the objects among some samples, in the sensor's frame.
    void add(std::span<const Sample> samples) {
        // A piece in a shadow covers at most a tenth of its range to either side (sight_lines.cpp).
        constexpr float before = 0.9F;
        for (const Sample& sample : samples) {
            if (objects_.is_background(objects_.object_of(sample.instance))) continue;
            const Reach reach = reach_of(sample);
            for (int cell = reach.first_cell; cell <= reach.last_cell; ++cell)
                from_m_[cell] = std::min(from_m_[cell], before * reach.near_m);
        }
    }

    /// The samples that reach these cones and ranges.
    std::vector<Sample> among(std::span<const Sample> samples) const {
        std::vector<Sample> out;
        std::ranges::copy_if(samples, std::back_inserter(out), [&](const Sample& sample) {
            const Reach reach = reach_of(sample);
            return std::any_of(&from_m_[reach.first_cell], &from_m_[reach.last_cell] + 1,
                               [&](float from_m) { return from_m < reach.far_m; });
        });
        return out;
    }

  private:
    const SceneObjects& objects_;
    /// The least range, by cell of y / r; infinite: no object.
    std::vector<float> from_m_ = std::vector(cells, std::numeric_limits<float>::infinity());
};

// Depth of a patch of labels: its echo is spread over the bins.
constexpr float max_depth_in_bins = 8.0F;

PointLimits label_limits(const CalibratedModel& model) {
    PointLimits limits = model.limits;
    limits.depth_m = max_depth_in_bins * model.equation.bin_m;
    if (const ConeBeams& cones = model.beams->cones; cones.exist())
        limits.sine = std::max(limits.sine, cones.mean_width());
    return limits;
}

/// Finds the echoes of a ping as in its image, but without speckle.
class SurfaceEchoFinder {
  public:
    SurfaceEchoFinder(const CalibratedModel& model, const TracedPing& traced, const Scene& scene,
                      ViewShape shape, bool patches, const UseEchoes& use)
        : model_(model),
          samples_(traced.samples.items),
          starts_(traced.starts().items),
          shape_(shape),
          strengths_(traced, scene, shape),
          limits_(label_limits(model)),
          patches_(patches),
          blocks_(use) {
        // A line array has no labels in its side lobes.
        if (!model.beams->cones.exist()) received_.resize(samples_.size());
    }

    void add(SampleKind kind, std::span<const Sample> samples) {
        if (kind == SampleKind::behind_wall) blocks_.begin_behind_walls();
        subdivide(samples, taper_shape(kind, shape_), limits_, pieces_, [&](PatchBlock& pieces) {
            find_echoes(kind_of(kind).is_point, model_, model_.scattering, pieces, echoes_);
            if (kind_of(kind).is_surface)
                strengths_.apply(samples, pieces, &limits_, echoes_.power);
            int last_piece = -1;
            int last_shaped = -1;
            WedgeExtent extent;
            for (const auto& [beam, k, power] : received(pieces, echoes_, nullptr)) {
                const Sample& sample = samples[pieces.sample[k]];
                const float half_m = pieces.half_range_m[k];
                if (k != last_shaped) extent = extent_of_piece(pieces, k, sample);
                last_shaped = k;
                blocks_.add(static_cast<std::uint32_t>(beam),
                            echoes_.range_m[k] + 0.5F * (extent.after - extent.before) * half_m,
                            0.5F * (extent.after + extent.before) * half_m, power, 1.0F, &sample);
                if (!received_.empty()) note_received(sample);
                if (patches_) add_echo(beam, power, pieces, k, sample, last_piece);
            }
        });
    }

    void add_multipath(const std::vector<SpecularPath>& paths) {
        blocks_.begin_multipath();
        const SonarEquation& equation = model_.equation;
        find_specular_echoes(paths, model_.scattering.materials, equation, model_.limits,
                             [&](const SpecularBlock& block) {
                                 for (const auto& [beam, k, power] :
                                      received(block.places, block.echoes, &block.out)) {
                                     const float range_m =
                                         equation.range_min_m +
                                         (block.echoes.row[k] + 0.5F) * equation.bin_m;
                                     const SpecularPath& path = paths[block.path[k]];
                                     blocks_.add(static_cast<std::uint32_t>(beam), range_m, 0.0F,
                                                 power, 1.0F, &starts_[path.sample], path.instance);
                                 }
                             });
    }

    SurfaceEchoes take() {
        blocks_.flush();
        SurfaceEchoes out;
        out.received = std::move(received_);
        out.cones = model_.beams->cones;
        out.patches = std::move(found_);
        out.patch_echoes = std::move(patch_echoes_);
        return out;
    }

  private:
    std::span<const ReceivedPiece> received(const PatchBlock& pieces, const PointEchoes& echoes,
                                            const PathEndpoint* out) {
        received_pieces_.clear();
        model_.beams->find_received(pieces, echoes, out, received_pieces_);
        return received_pieces_;
    }

    void note_received(const Sample& sample) {
        const Sample* const first = samples_.data();
        if (!std::less<>()(&sample, first) && std::less<>()(&sample, first + samples_.size()))
            received_[static_cast<std::size_t>(&sample - first)] = 1;
    }

    /// Adds the echo of piece k of a block in a beam. The echoes of a piece in several beams of a
    /// line array belong to one patch. `last_piece`: that of the last patch; -1: none.
    void add_echo(int beam, float power, const PatchBlock& pieces, int k, const Sample& sample,
                  int& last_piece) {
        const auto at = static_cast<std::uint32_t>(patch_echoes_.size());
        if (k != last_piece) {
            found_.push_back(patch_of(pieces, k, sample));
            found_.back().echo_begin = at;
        }
        last_piece = k;
        found_.back().echo_end = at + 1;
        patch_echoes_.push_back({static_cast<std::uint32_t>(beam), power});
    }

    WedgeExtent extent_of_piece(const PatchBlock& pieces, int k, const Sample& sample) const {
        if (sample.wedge == 0.0F) return {};
        const EchoPatch patch = patch_of(pieces, k, sample);
        const Eigen::Vector3f d = arrival_of(patch.position).direction;
        return wedge_extent(patch.wedge, d.dot(patch.edge_u), d.dot(patch.edge_v));
    }

    EchoPatch patch_of(const PatchBlock& pieces, int k, const Sample& sample) const {
        const Arrival at = arrival_of(sample.position);
        const auto parts_of = [&](const Eigen::Vector3f& edge) {
            return static_cast<float>(
                patches_along(extents_of(edge, at.direction), at.range_m, limits_));
        };
        const float by_u = parts_of(sample.edge_u);
        const float by_v = parts_of(sample.edge_v);
        // The parts of a wedge are as long as their shares of its area say.
        const float length = sample.wedge == 0.0F ? 1.0F
                                                  : pieces.area_m2[k] * by_u * by_v /
                                                        (sample.area_m2 * sample.strength);
        return {.position = {pieces.x[k], pieces.y[k], pieces.z[k]},
                .edge_u = sample.edge_u / by_u,
                .edge_v = length / by_v * sample.edge_v,
                .sample = &sample,
                .wedge = sample.wedge / by_u};
    }

    const CalibratedModel& model_;
    const std::vector<Sample>& samples_;
    const std::vector<Sample>& starts_;  ///< the samples that multipath starts from
    ViewShape shape_;
    PieceStrengths strengths_;
    PointLimits limits_;  ///< for direct echoes
    bool patches_;
    EchoBlocks blocks_;
    PatchBlock pieces_;
    PointEchoes echoes_;
    std::vector<ReceivedPiece> received_pieces_;
    std::vector<std::uint8_t> received_;  ///< SurfaceEchoes::received
    std::vector<EchoPatch> found_;
    std::vector<PatchEcho> patch_echoes_;  ///< one for each direct echo
};

}  // namespace

SurfaceEchoes CalibratedModel::surface_echoes(const TracedPing& traced, const View& view,
                                              const Scene& scene, const EchoRequest& request,
                                              const UseEchoes& use) const {
    if (!is_prepared_for(scene))
        return prepared_for(scene)->surface_echoes(traced, view, scene, request, use);
    const std::vector<SpecularPath> paths =
        specular_paths(traced, scene, scattering.materials, view.shape);
    const SamplesByKind samples(traced.samples.items, true);
    SurfaceEchoFinder finder(*this, traced, scene, view.shape, request.patches, use);
    std::optional<NearObjects> near_objects;
    const bool all_surface = std::ranges::all_of(kinds_of_samples, [&](const KindOfSample& kind) {
        return kind.is_surface || !kind.has_labels || samples.of(kind.kind).empty();
    });
    if (request.objects && !request.patches && paths.empty() && beams->cones.exist() &&
        all_surface) {
        near_objects.emplace(*request.objects);
        for (const KindOfSample& kind : kinds_of_samples) {
            if (kind.is_surface) near_objects->add(samples.of(kind.kind));
        }
    }
    std::vector<std::vector<Sample>> kept;
    for (const KindOfSample& kind : kinds_of_samples) {
        if (!kind.has_labels) continue;
        std::span<const Sample> chosen = samples.of(kind.kind);
        if (near_objects) chosen = kept.emplace_back(near_objects->among(chosen));
        finder.add(kind.kind, chosen);
    }
    finder.add_multipath(paths);
    return finder.take();
}

}  // namespace sonarsim
