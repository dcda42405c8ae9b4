#include <algorithm>
#include <memory>
#include <utility>

#include "core/elementary.h"
#include "simulate/calibrated/equation/specular_echoes.h"
#include "simulate/calibrated/kind_echoes.h"
#include "simulate/calibrated/receiver/receiver_chain.h"
#include "simulate/calibrated/speckle/scatterers.h"
#include "simulate/calibrated/speckle/speckle.h"

namespace sonarsim {

namespace {

// For speckle that is drawn for each ping. The error of the tank's expected image is then 1.8 %.
constexpr float deeper_patches = 2.0F;  // factor on the size of patches in range

class ImageFormer {
  public:
    ImageFormer(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
                Ping& ping)
        : model_(model),
          beams_(*model.beams),
          traced_(traced),
          context_(context),
          scene_draws_(context.draws.scene_key(Stream::scatterers)),
          ping_draws_(context.draws.of(Stream::speckle)),
          sonar_{traced.T_world_sensor.rotation.toRotationMatrix().cast<float>(),
                 traced.T_world_sensor.translation - context.scene.origin},
          places_{traced.T_world_sensor, context.scene.sound_profile.get(), traced.motion,
                  context.view.shape},
          speckle_(context.terms.random > 0 ? model.speckle : SpeckleMode::none),
          form_(speckle_ == SpeckleMode::none ? PowerForm::power : PowerForm::amplitude),
          samples_(traced.samples.items, form_ == PowerForm::power),
          strengths_(traced, context.scene, context.view.shape),
          speckle_gain_(model.amplitude_taps.scalloping_gain * beams_.scalloping_gain()),
          ping_(ping) {}

    /// Fills the image. Numbers in the comments are sections of docs/calibrated.md.
    void form(std::span<float> mean_image) {
        EchoGrid grid(model_.equation.rows, beams_.columns());
        const bool has_tails = form_ == PowerForm::amplitude && model_.reverberation.share > 0.0F;
        is_mean_shown_ = !mean_image.empty();
        if (context_.terms.random > 1) column_gains_ = model_.column_gain;
        if (is_mean_shown_ || has_tails) mean_ = std::make_unique<EchoGrid>(grid);

        // 1. The sonar equation: powers or, with `speckle: scene`, amplitudes of scatterers.
        if (context_.terms.direct) add_samples(grid);
        if (context_.terms.multipath) add_multipath(grid);

        // 2. Speckle of the powers, and echoes with phases of their own.
        if (mean_ && speckle_ != SpeckleMode::scene) *mean_ = grid;
        if (speckle_ == SpeckleMode::ping) draw_speckle(grid, speckle_gain_, ping_draws_);
        if (context_.terms.direct && form_ == PowerForm::amplitude) add_own_phases(grid);

        count_occupied(grid);

        // 3. The water and the tails of echoes; cells of amplitudes share scatterers with their
        // neighbours, so the tails are of mean powers.
        add_reverberation(model_, traced_, context_, mean_ ? *mean_ : grid, form_, speckle_gain_,
                          grid, is_mean_shown_ ? mean_.get() : nullptr);

        // 4. Pulse and beams. 5. The receiver's noise and its gain.
        receive(form_, context_.terms.random > 1, grid, ping_.intensity);
        if (!mean_image.empty()) receive(PowerForm::power, false, *mean_, mean_image);
    }

  private:
    void receive(PowerForm form, bool noisy, EchoGrid& grid, std::span<float> image) const {
        const bool powers = form == PowerForm::power;
        grid.convolve_pulse(powers ? model_.power_taps : model_.amplitude_taps, column_gains_,
                            powers);
        beams_.form(grid, powers, noisy, context_.draws.received(Stream::receiver_noise),
                    model_.row_gain, image);
    }

    void count_occupied(const EchoGrid& grid) {
        const double bins_per_cell =  // the grid has guard beams, too
            1.0 * context_.view.range_bins / grid.rows() * context_.view.beams / grid.columns();
        ping_.counts.occupied_bins = static_cast<std::uint64_t>(
            std::ceil(bins_per_cell * static_cast<double>(grid.occupied())));
    }

    /// Adds the echoes of all samples but those that have phases of their own.
    void add_samples(EchoGrid& grid) {
        for (const KindOfSample& kind : kinds_of_samples) {
            const std::span<const Sample> samples = samples_.of(kind.kind);
            if (samples.empty() || !(kind.is_surface || context_.terms.water)) continue;
            if (kind.phase == PhaseSource::ping) {
                const auto add = [&](EchoGrid& powers) {
                    add_pieces(kind.kind, samples, model_.limits, powers);
                };
                add_drawn_by_ping(stream_named(kind.stream), grid, add);
            } else if (form_ == PowerForm::power) {
                add_pieces(kind.kind, samples, model_.limits, grid);
            } else if (kind.phase == PhaseSource::scene) {
                add_surface(samples, grid);
            }
        }
        if (model_.sediment) add_sediment(grid);
    }

    void add_pieces(SampleKind kind, std::span<const Sample> samples, const PointLimits& limits,
                    EchoGrid& grid) {
        PatchBlock block;
        subdivide(samples, taper_shape(kind, context_.view.shape), limits, block,
                  [&](PatchBlock& pieces) {
                      find(kind_of(kind), samples, pieces, &limits);
                      beams_.deposit(pieces, echoes_, nullptr, grid, nullptr);
                  });
    }

    /// Adds surface whose phases are those of the scene's scatterers.
    void add_surface(std::span<const Sample> surface, EchoGrid& grid) {
        if (speckle_ == SpeckleMode::ping) {
            PointLimits limits = model_.limits;
            limits.depth_m *= deeper_patches;
            return add_pieces(SampleKind::surface, surface, limits, grid);
        }
        Scatterers block;
        Amplitudes amplitudes;
        find_scatterers(surface, context_.view.shape, model_.cells, sonar_, scene_draws_, block,
                        [&](const Scatterers&) {
                            find(kind_of(SampleKind::surface), surface, block.pieces, nullptr);
                            draw_amplitudes(block, echoes_, model_.cells, sonar_, scene_draws_,
                                            amplitudes);
                            beams_.deposit(block.pieces, echoes_, &amplitudes, grid, mean_.get());
                        });
    }

    /// Computes the echoes of a block of pieces: levels, range bins and columns of the grid.
    /// Surface has its map's strengths and its texture. `limits`: as PieceStrengths::apply().
    void find(const KindOfSample& kind, std::span<const Sample> samples, PatchBlock& pieces,
              const PointLimits* limits) {
        const bool is_surface = kind.is_surface;
        ping_.counts.echoes += pieces.count;
        ping_.counts.out_of_range +=
            find_echoes(kind.is_point, model_,
                        is_surface ? surface_scattering() : model_.scattering, pieces, echoes_);
        ping_.counts.out_of_range += beams_.find_columns(pieces, echoes_);
        if (!is_surface) return;
        strengths_.apply(samples, pieces, limits, echoes_.power);
        add_texture(samples, pieces);
    }

    void add_texture(std::span<const Sample> samples, const PatchBlock& pieces) {
        model_.texture.apply(samples, pieces, sonar_, places_, scene_draws_, echoes_.power);
    }

    /// Without what comes from below sea beds.
    const Scattering& surface_scattering() const {
        return model_.sediment ? model_.sediment->surface : model_.scattering;
    }

    /// Lets add(powers) add echoes whose amplitudes are drawn for each ping, even with `speckle:
    /// scene`: parts behind walls overlap, waves move, and no mesh is exact to a wavelength.
    template <class Add>
    void add_drawn_by_ping(Stream stream, EchoGrid& grid, Add add) {
        if (speckle_ != SpeckleMode::scene) return add(grid);
        EchoGrid powers(grid.rows(), grid.columns());
        add(powers);
        if (mean_) mean_->add(powers);
        draw_speckle(powers, speckle_gain_, context_.draws.of(stream));
        grid.add(powers);
    }

    void add_sediment(EchoGrid& grid) {
        const SedimentScattering& sediment = *model_.sediment;
        std::vector<Sample> beds;
        for (const Sample& sample : traced_.samples.items) {
            if (kind_of(sample.kind).is_surface && sediment.has[sample.material])
                beds.push_back(sample);
        }
        if (beds.empty()) return;
        EchoGrid energy(grid.rows(), grid.columns());
        EchoGrid lagged(grid.rows(), grid.columns());
        PatchBlock block;
        subdivide(std::span<const Sample>(beds), context_.view.shape, model_.limits, block,
                  [&](const PatchBlock& patches) {
                      apply_sonar_equation(patches, sediment.volume, model_.equation, echoes_);
                      strengths_.apply(beds, patches, &model_.limits, echoes_.power);
                      beams_.find_columns(patches, echoes_);
                      beams_.deposit(patches, echoes_, nullptr, energy, nullptr);
                      weigh_by_lag(sediment, patches, model_.equation.bin_m, echoes_);
                      beams_.deposit(patches, echoes_, nullptr, lagged, nullptr);
                  });
        spread_below(lagged, energy);
        add_drawn_by_ping(stream_named("sediment"), grid,
                          [&](EchoGrid& powers) { powers.add(energy); });
    }

    void add_multipath(EchoGrid& grid) {
        const std::vector<SpecularPath> paths = specular_paths(
            traced_, context_.scene, model_.scattering.materials, context_.view.shape);
        if (paths.empty()) return;
        ping_.counts.echoes += 2 * paths.size();
        add_drawn_by_ping(Stream::speckle, grid, [&](EchoGrid& powers) {
            std::uint64_t outside_beams = 0;
            const std::uint64_t outside_range = find_specular_echoes(
                paths, model_.scattering.materials, model_.equation, model_.limits,
                [&](const SpecularBlock& block) {
                    outside_beams += beams_.find_columns(block.places, block.echoes);
                    beams_.deposit_paths(block.out, {block.places, block.echoes}, powers);
                });
            ping_.counts.out_of_range += outside_range + outside_beams;
        });
    }

    void add_own_phases(EchoGrid& grid) {
        for (const KindOfSample& kind : kinds_of_samples) {
            if (kind.phase != PhaseSource::own) continue;
            const std::span<const Sample> samples = samples_.of(kind.kind);
            if (samples.empty()) continue;
            const bool target = kind.kind == SampleKind::target;
            add_points(target ? joined(samples) : points_of(kind, samples), target, grid);
            if (!is_mean_shown_) continue;
            const PingCounts counted = ping_.counts;
            add_pieces(kind.kind, samples, model_.limits, *mean_);
            ping_.counts = counted;
        }
    }

    PointScatterers joined(std::span<const Sample> targets) const {
        std::vector<std::pair<std::uint64_t, std::size_t>> by_surface;
        for (std::size_t k = 0; k < targets.size(); ++k) {
            by_surface.emplace_back(std::uint64_t{targets[k].instance} << 32U | targets[k].number,
                                    k);
        }
        std::ranges::sort(by_surface);
        std::vector<Sample> pieces;
        pieces.reserve(targets.size());
        for (const auto& [surface, k] : by_surface)
            pieces.push_back(targets[k]);
        return join_targets(pieces, context_.view.shape, model_.target_cell, surface_scattering(),
                            speckle_ == SpeckleMode::ping ? ping_draws_ : scene_draws_);
    }

    PointScatterers points_of(const KindOfSample& kind, std::span<const Sample> samples) const {
        const PhiloxKey key = context_.draws.scene_key(stream_named(kind.stream));
        PointScatterers out{.points = {samples.begin(), samples.end()}, .turns = {}};
        for (const Sample& sample : samples)
            out.turns.push_back(unit_float(philox({sample.number, 0, 0, 0}, key).x0));
        return out;
    }

    /// Adds the amplitudes of points. The phase of the path follows from the range.
    void add_points(const PointScatterers& scatterers, bool have_texture, EchoGrid& grid) {
        Amplitudes amplitudes;
        const double turns_per_m = 2.0 / model_.wavelength_m;
        PatchBlock block;
        subdivide(std::span(scatterers.points), {}, {}, block, [&](PatchBlock& points) {
            find({.is_point = true}, scatterers.points, points, nullptr);
            if (have_texture) {
                for (int k = 0; k < points.count; ++k)
                    points.material[k] = scatterers.points[points.sample[k]].material;
                add_texture(scatterers.points, points);
            }
            for (int k = 0; k < points.count; ++k) {
                const double way = turns_per_m * static_cast<double>(echoes_.range_m[k]);
                const auto turns = static_cast<float>(way - std::floor(way));
                const SinCosFloat phase = sincos_turns(scatterers.turns[points.sample[k]] + turns);
                const float amplitude = std::sqrt(echoes_.power[k]);
                amplitudes.re[k] = amplitude * phase.cos;
                amplitudes.im[k] = amplitude * phase.sin;
            }
            // Echoes up to a whole vector are added, too.
            for (int k = points.count; k < echoes_.count; ++k)
                amplitudes.re[k] = amplitudes.im[k] = 0.0F;
            // For the tails alone, the points' own powers do.
            beams_.deposit(points, echoes_, &amplitudes, grid,
                           is_mean_shown_ ? nullptr : mean_.get());
        });
    }

    const CalibratedModel& model_;
    const Beams& beams_;
    const TracedPing& traced_;
    const FormContext& context_;
    PhiloxKey scene_draws_, ping_draws_;
    SonarInScene sonar_;
    TruePlaces places_;
    SpeckleMode speckle_;
    PowerForm form_;         ///< the form of the grid
    SamplesByKind samples_;  ///< without phases, targets are surface like any other
    PieceStrengths strengths_;
    float speckle_gain_;  ///< restores the mean power where the grid's cells draw the speckle
    PointEchoes echoes_;
    std::span<const float> column_gains_;  ///< with the receiver's noise
    std::unique_ptr<EchoGrid> mean_;       ///< the mean powers of the grid, if they are needed
    bool is_mean_shown_ = false;           ///< not for tails alone
    Ping& ping_;
};

}  // namespace

void form_look(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
               std::span<float> mean, Ping& ping) {
    ImageFormer(model, traced, context, ping).form(mean);
}

}  // namespace sonarsim
