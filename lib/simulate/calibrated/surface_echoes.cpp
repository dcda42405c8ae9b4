#include "simulate/trace/surface_echoes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "simulate/calibrated/model.h"
#include "simulate/calibrated/near_objects.h"
#include "simulate/calibrated/particle_echoes.h"
#include "simulate/calibrated/patches.h"
#include "simulate/calibrated/piece_strengths.h"
#include "simulate/calibrated/specular_echoes.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

// Depth of a patch of labels: its echo is spread over the bins. With 8 bins, boxes and areas are as
// near to those of half a bin as with 2.
constexpr float max_depth_in_bins = 8.0F;

/// The greatest size of a patch of labels.
PointLimits label_limits(const CalibratedModel& model) {
    PointLimits limits = model.limits;
    limits.depth_m = max_depth_in_bins * model.equation.bin_m;
    if (model.cones.exist()) limits.sine = std::max(limits.sine, model.cones.mean_width());
    return limits;
}

/// Finds the echoes of a ping as in its image, but without speckle. `Beams`: ArrayBeams or
/// TransducerBeams.
template <class Beams>
class SurfaceEchoFinder {
  public:
    SurfaceEchoFinder(const CalibratedModel& model, const Beams& beams, const TracedPing& traced,
                      const Scene& scene, ViewShape shape, bool patches, const UseEchoes& use)
        : model_(model),
          beams_(beams),
          samples_(traced.samples.items),
          shape_(shape),
          strengths_(traced, scene, shape),
          limits_(label_limits(model)),
          patches_(patches),
          blocks_(use) {
        if constexpr (has_side_lobes) received_.resize(samples_.size());
    }

    void add_surface(std::span<const Sample> surface) {
        subdivide(surface, shape_, limits_, pieces_, [&](const PatchBlock& pieces) {
            last_piece_ = -1;
            apply_sonar_equation(pieces, model_.scattering, model_.equation, echoes_);
            strengths_.apply(surface, pieces, &limits_, echoes_.power);
            const auto half_sine = [&](int k) { return pieces.half_sine[k]; };
            for_each_beam(pieces, echoes_, nullptr, half_sine, [&](int beam, int k, float power) {
                const Sample& sample = surface[pieces.sample[k]];
                add_direct(beam, echoes_.range_m[k], pieces.half_range_m[k], power, sample);
                if (patches_) add_echo(beam, k, power, [&] { return patch_of(pieces, k, sample); });
            });
        });
    }

    /// Particles are points: their labels fill a resolution cell.
    void add_particles(const SeenParticles& particles) {
        PingCounts ignored;
        const auto spot = [&](int) { return 0.5F * model_.target_cell.sine; };
        find_particles(model_, beams_, particles.samples, ignored,
                       [&](const PatchBlock& points, const PointEchoes& echoes) {
                           last_piece_ = -1;
                           for_each_beam(points, echoes, nullptr, spot,
                                         [&](int beam, int k, float power) {
                                             add_particle(particles.samples[points.sample[k]],
                                                          {beam, k}, echoes.range_m[k], power);
                                         });
                       });
    }

    void add_behind_walls(std::span<const Sample> surface) {
        blocks_.begin_behind_walls();
        add_surface(surface);
    }

    void add_multipath(const std::vector<SpecularPath>& paths) {
        blocks_.begin_multipath();
        const SonarEquation& equation = model_.equation;
        const auto use = [&](const SpecularBlock& block) {
            const auto add = [&](int beam, int k, float power) {
                const float range_m =
                    equation.range_min_m + (block.echoes.row[k] + 0.5F) * equation.bin_m;
                const SpecularPath& path = paths[block.path[k]];
                blocks_.add(static_cast<std::uint32_t>(beam), range_m, 0.0F, power, 1.0F,
                            &samples_[path.sample], path.instance);
            };
            const auto point = [](int) { return 0.0F; };
            for_each_beam(block.places, block.echoes, &block.out, point, add);
        };
        find_specular_echoes(paths, model_.scattering.materials, equation, model_.limits, use);
    }

    SurfaceEchoes take() {
        blocks_.flush();
        SurfaceEchoes out;
        out.received = std::move(received_);
        out.cones = model_.cones;
        out.patches = std::move(found_);
        out.patch_echoes = std::move(patch_echoes_);
        return out;
    }

  private:
    static constexpr bool has_side_lobes = std::is_same_v<Beams, TransducerBeams>;

    /// A beam that receives a piece of a block.
    struct Received {
        int beam, piece;
    };

    void add_particle(const Sample& sample, const Received& at, float range_m, float power) {
        const float half_m = 0.5F * model_.target_cell.depth_m;
        add_direct(at.beam, range_m, half_m, power, sample);
        if (!patches_) return;
        add_echo(at.beam, at.piece, power, [&] {
            return EchoPatch{.position = sample.position,
                             .edge_u = sample.edge_u,
                             .edge_v = sample.edge_v,
                             .sample = &sample};
        });
    }

    void add_direct(int beam, float range_m, float half_m, float power, const Sample& sample) {
        blocks_.add(static_cast<std::uint32_t>(beam), range_m, half_m, power, 1.0F, &sample);
        if constexpr (has_side_lobes) note_received(sample);
    }

    void note_received(const Sample& sample) {
        const Sample* const first = samples_.data();
        if (!std::less<>()(&sample, first) && std::less<>()(&sample, first + samples_.size()))
            received_[static_cast<std::size_t>(&sample - first)] = 1;
    }

    /// Adds the echo of piece k of a block in a beam. The echoes of a piece in several beams of a
    /// line array belong to one patch.
    template <class PatchOfPiece>
    void add_echo(int beam, int k, float power, PatchOfPiece patch_of_piece) {
        const auto at = static_cast<std::uint32_t>(patch_echoes_.size());
        if (k != last_piece_) {
            found_.push_back(patch_of_piece());
            found_.back().echo_begin = at;
        }
        last_piece_ = k;
        found_.back().echo_end = at + 1;
        patch_echoes_.push_back({static_cast<std::uint32_t>(beam), power});
    }

    EchoPatch patch_of(const PatchBlock& pieces, int k, const Sample& sample) const {
        const Arrival at = arrival_of(sample.position);
        const auto part_of = [&](const Eigen::Vector3f& edge) -> Eigen::Vector3f {
            const int parts = patches_along(extents_of(edge, at.direction), at.range_m, limits_);
            return edge / static_cast<float>(parts);
        };
        return {.position = {pieces.x[k], pieces.y[k], pieces.z[k]},
                .edge_u = part_of(sample.edge_u),
                .edge_v = part_of(sample.edge_v),
                .sample = &sample};
    }

    /// Calls use(beam, piece, power) for every beam that receives a piece's echo in its main lobe.
    /// A line array receives it in the beams of its sines, `half_sine` to either side of the
    /// piece's. `out`: the places to which the sound was sent, if not the pieces.
    template <class HalfSine, class Use>
    void for_each_beam(const PatchBlock& pieces, const PointEchoes& echoes, const PathEndpoint* out,
                       HalfSine half_sine, Use use) {
        if constexpr (std::is_same_v<Beams, ArrayBeams>) {
            for (int k = 0; k < pieces.count; ++k) {
                const float power = echoes.power[k];
                if (!(power > 0.0F)) continue;
                const float sine = piece_sine(pieces.y[k], echoes.range_m[k]);
                const float low = sine - half_sine(k);
                const float high = sine + half_sine(k);
                const auto add = [&](int beam, float share) { use(beam, k, share * power); };
                if (high > low)
                    model_.cones.for_each(low, high, add);
                else if (const int beam = model_.cones.beam(sine); beam >= 0)
                    add(beam, 1.0F);
            }
        } else {
            for (int beam = 0; beam < beams_.beams(); ++beam) {
                find_gains(beams_, beam, pieces, echoes, gain_);
                if (out) find_gains(beams_, beam, out->places, out->echoes, sent_);
                for (int k = 0; k < pieces.count; ++k) {
                    // A gain is that of both ways.
                    const float gain = out ? std::sqrt(sent_[k] * gain_[k]) : gain_[k];
                    const float power = echoes.power[k] * gain;
                    if (power > 0.0F && in_main_lobe(beams_, pieces, echoes, k))
                        use(beam, k, power);
                }
            }
        }
    }

    const CalibratedModel& model_;
    const Beams& beams_;
    const std::vector<Sample>& samples_;
    ViewShape shape_;
    PieceStrengths strengths_;
    PointLimits limits_;  ///< for direct echoes
    bool patches_;
    EchoBlocks blocks_;
    PatchBlock pieces_;
    PointEchoes echoes_;
    PatchBlock::Array<float> sent_{}, gain_{};
    std::vector<std::uint8_t> received_;  ///< SurfaceEchoes::received
    std::vector<EchoPatch> found_;
    std::vector<PatchEcho> patch_echoes_;  ///< one for each direct echo
    int last_piece_ = -1;  ///< the piece of the block that is the last of found_; -1: none
};

}  // namespace

SurfaceEchoes CalibratedModel::surface_echoes(const TracedPing& traced, const View& view,
                                              const Scene& scene, const EchoRequest& request,
                                              const UseEchoes& use) const {
    if (!is_prepared_for(scene))
        return prepared_for(scene)->surface_echoes(traced, view, scene, request, use);
    return std::visit(
        [&]<class Beams>(const Beams& model_beams) {
            const std::vector<SpecularPath> paths = specular_paths(traced, scene, view.shape);
            SurfaceEchoFinder<Beams> finder(*this, model_beams, traced, scene, view.shape,
                                            request.patches, use);
            const bool is_local = request.objects && !request.patches && paths.empty() &&
                                  traced.particles.samples.empty() &&
                                  std::is_same_v<Beams, ArrayBeams>;
            std::array<std::span<const Sample>, 3> surfaces = traced.surfaces();
            std::array<std::vector<Sample>, 3> near_objects;
            if (is_local) {
                NearObjects near(*request.objects);
                for (const std::span<const Sample> surface : surfaces)
                    near.add(surface);
                for (std::size_t k = 0; k < surfaces.size(); ++k)
                    surfaces[k] = near_objects[k] = near.among(surfaces[k]);
            }
            finder.add_surface(surfaces[0]);
            finder.add_surface(surfaces[1]);
            finder.add_particles(traced.particles);
            finder.add_behind_walls(surfaces[2]);
            finder.add_multipath(paths);
            return finder.take();
        },
        beams);
}

}  // namespace sonarsim
