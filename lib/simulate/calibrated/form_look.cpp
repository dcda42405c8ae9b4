#include "simulate/calibrated/form_look.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "simulate/calibrated/particle_echoes.h"
#include "simulate/calibrated/piece_strengths.h"
#include "simulate/calibrated/reverberation.h"
#include "simulate/calibrated/scatterer_search.h"
#include "simulate/calibrated/speckle.h"
#include "simulate/calibrated/specular_echoes.h"
#include "simulate/calibrated/target_scatterers.h"
#include "simulate/calibrated/water_echoes.h"

namespace sonarsim {

namespace {

// For speckle that is drawn for each ping. The error of the tank's expected image is then 1.8 %.
constexpr float deeper_patches = 2.0F;  // factor on the size of patches in range

/// The steps that form an image, and their common data. `Beams`: ArrayBeams or TransducerBeams.
template <class Beams>
class ImageFormer {
  public:
    ImageFormer(const CalibratedModel& model, const Beams& beams, const TracedPing& traced,
                const FormContext& context, Ping& ping)
        : model_(model),
          beams_(beams),
          context_(context),
          scene_draws_(context.draws.of_scene(Stream::scatterers)),
          ping_draws_(context.draws.of(Stream::speckle)),
          sonar_{traced.T_world_sensor.rotation.toRotationMatrix().cast<float>(),
                 traced.T_world_sensor.translation - context.scene.origin},
          speckle_(context.terms.random > 0 ? model.speckle : SpeckleMode::none),
          view_(widened_view(context.view, model.info.guard_beams)),
          strengths_(traced, context.scene, view_.shape),
          speckle_gain_(model.amplitude_taps.scalloping_gain * scalloping_gain(beams)),
          ping_(ping) {}

    /// Fills the image. Numbers in the comments are sections of docs/calibrated.md.
    void form(const TracedPing& traced, std::span<float> mean_image) {
        if (!mean_image.empty())
            mean_ = std::make_unique<EchoGrid>(model_.equation.rows, columns_of(beams_));
        EchoGrid grid(model_.equation.rows, columns_of(beams_));
        const bool expected_power = speckle_ == SpeckleMode::none;
        std::vector<Sample> targets;

        // 1. Sonar equation: surface in view, in the guard beams and behind walls, multipath.
        if (context_.terms.direct) {
            add_surface(traced.samples.items, targets, grid);
            add_surface(traced.outside_sector, targets, grid);
            add_behind_walls(traced.behind_walls, grid);
            if (model_.sediment) add_sediment(traced, grid);
            add_water_surface(traced.water_surface, grid);
            if (expected_power)
                add_particle_powers(model_, beams_, traced.particles, ping_.counts, grid);
        }
        if (context_.terms.multipath) add_multipath(traced, grid);

        // 2. Speckle. With `speckle: scene` the amplitudes of step 1 already have it.
        if (mean_ && speckle_ != SpeckleMode::scene) *mean_ = grid;
        if (speckle_ == SpeckleMode::ping) draw_speckle(grid, speckle_gain_, ping_draws_);
        if (context_.terms.direct && !expected_power) {
            add_targets(targets, grid);
            add_particle_amplitudes(model_, beams_, traced.particles, context_.draws, ping_.counts,
                                    grid);
            if (mean_) {
                const PingCounts counted = ping_.counts;
                add_pieces(targets, model_.limits, *mean_);
                add_particle_powers(model_, beams_, traced.particles, ping_.counts, *mean_);
                ping_.counts = counted;
            }
        }

        // 5. The water's volume. Bins with its echo alone count as empty.
        const double bins_per_cell =  // the grid has guard beams, too
            1.0 * context_.view.range_bins / grid.rows() * context_.view.beams / grid.columns();
        ping_.counts.occupied_bins = static_cast<std::uint64_t>(
            std::ceil(bins_per_cell * static_cast<double>(grid.occupied())));
        const PowerForm form = expected_power ? PowerForm::power : PowerForm::amplitude;
        if (context_.terms.direct && model_.water)
            add_water(model_, traced, context_, form, speckle_gain_, grid, mean_.get());
        receive(form, context_.terms.random > 1, ping_.intensity, grid);
        if (mean_) receive(PowerForm::power, false, mean_image, *mean_);
    }

  private:
    /// 3. Pulse, beams; 4. the receiver's noise and its gain.
    void receive(PowerForm form, bool noisy, std::span<float> image, EchoGrid& grid) const {
        const bool powers = form == PowerForm::power;
        grid.convolve_pulse(powers ? model_.power_taps : model_.amplitude_taps);
        add_reverberation(model_.reverberation, form,
                          context_.draws.of(stream_named("reverberation")), grid);
        beamform(beams_, grid, powers, noisy, context_.draws.of(Stream::receiver_noise),
                 model_.row_gain, image);
    }

    /// Without what comes from below sea beds.
    const Scattering& surface_scattering() const {
        return model_.sediment ? model_.sediment->surface : model_.scattering;
    }

    /// Computes the echoes of a block of patches: levels, range bins and columns of the grid.
    void find(const PatchBlock& patches, const Scattering& scattering) {
        ping_.counts.echoes += patches.count;
        ping_.counts.out_of_range +=
            apply_sonar_equation(patches, scattering, model_.equation, echoes_);
        ping_.counts.out_of_range += find_columns(beams_, patches, echoes_);
    }

    /// The same for pieces of surface of the scene, with its map and its texture. `limits`: those
    /// of PieceStrengths::apply().
    void find(std::span<const Sample> surface, const PatchBlock& patches,
              const PointLimits* limits) {
        find(patches, surface_scattering());
        strengths_.apply(surface, patches, limits, echoes_.power);
        model_.texture.apply(patches, sonar_, scene_draws_, echoes_.power);
    }

    /// Lets add(powers) add echoes whose amplitudes are drawn for each ping, even with `speckle:
    /// scene`.
    template <class Add>
    void add_drawn_by_ping(PhiloxKey key, EchoGrid& grid, Add add) {
        if (speckle_ != SpeckleMode::scene) return add(grid);
        EchoGrid powers(grid.rows(), grid.columns());
        add(powers);
        if (mean_) mean_->add(powers);
        draw_speckle(powers, speckle_gain_, key);
        grid.add(powers);
    }

    /// Adds the echo of surface behind thin walls. Its amplitudes are drawn for each ping: parts of
    /// it overlap where walls do, and its phase depends on the walls to a fraction of a wavelength.
    void add_behind_walls(std::span<const Sample> surface, EchoGrid& grid) {
        if (surface.empty()) return;
        const PhiloxKey key = context_.draws.of(stream_named("behind walls"));
        add_drawn_by_ping(key, grid,
                          [&](EchoGrid& powers) { add_pieces(surface, model_.limits, powers); });
    }

    /// Adds the echo of the water's surface, whose waves move from ping to ping. Its footprints are
    /// taken for parallelograms.
    void add_water_surface(std::span<const Sample> surface, EchoGrid& grid) {
        if (surface.empty()) return;
        const PhiloxKey key = context_.draws.of(stream_named("water surface"));
        add_drawn_by_ping(key, grid, [&](EchoGrid& powers) {
            PatchBlock block;
            subdivide(surface, {}, model_.limits, block, [&](const PatchBlock& patches) {
                find(patches, model_.scattering);
                add_powers(beams_, patches, echoes_, powers);
            });
        });
    }

    /// Adds the echoes of the sediment below sea beds. Their amplitudes are drawn for each ping.
    void add_sediment(const TracedPing& traced, EchoGrid& grid) {
        const SedimentScattering& sediment = *model_.sediment;
        std::vector<Sample> beds;
        const auto keep = [&](const Sample& sample) {
            if (sediment.has[sample.material]) beds.push_back(sample);
        };
        for (const std::span<const Sample> surface : traced.surfaces())
            std::ranges::for_each(surface, keep);
        if (beds.empty()) return;
        EchoGrid energy(grid.rows(), grid.columns());
        EchoGrid lagged(grid.rows(), grid.columns());
        PatchBlock block;
        subdivide(std::span<const Sample>(beds), view_.shape, model_.limits, block,
                  [&](const PatchBlock& patches) {
                      apply_sonar_equation(patches, sediment.volume, model_.equation, echoes_);
                      strengths_.apply(beds, patches, &model_.limits, echoes_.power);
                      find_columns(beams_, patches, echoes_);
                      add_powers(beams_, patches, echoes_, energy);
                      weigh_by_lag(sediment, patches, model_.equation.bin_m, echoes_);
                      add_powers(beams_, patches, echoes_, lagged);
                  });
        spread_below(lagged, energy);
        add_drawn_by_ping(context_.draws.of(stream_named("sediment")), grid,
                          [&](EchoGrid& powers) { powers.add(energy); });
    }

    /// Adds the echoes of a surface to the grid: with `speckle: scene` the amplitudes of its
    /// scatterers, else the powers of its patches. With speckle it moves pieces of targets to
    /// `targets` instead.
    void add_surface(std::span<const Sample> surface, std::vector<Sample>& targets,
                     EchoGrid& grid) {
        const auto is_target = [](const Sample& sample) { return sample.region > 0; };
        std::vector<Sample> others;
        if (speckle_ != SpeckleMode::none && std::ranges::any_of(surface, is_target)) {
            others.reserve(surface.size());
            std::ranges::partition_copy(surface, std::back_inserter(targets),
                                        std::back_inserter(others), is_target);
            surface = others;
        }
        if (speckle_ == SpeckleMode::scene) {
            Scatterers block;
            Amplitudes amplitudes;
            find_scatterers(
                surface, view_.shape, model_.cells, sonar_, scene_draws_, block,
                [&](const Scatterers& found) {
                    find(surface, found.pieces, nullptr);
                    draw_amplitudes(found, echoes_, model_.cells, sonar_, scene_draws_, amplitudes);
                    add_amplitudes(beams_, found.pieces, echoes_, amplitudes, grid, mean_.get());
                });
            return;
        }
        PointLimits limits = model_.limits;
        if (speckle_ == SpeckleMode::ping) limits.depth_m *= deeper_patches;
        add_pieces(surface, limits, grid);
    }

    /// Adds the powers of the pieces of a surface.
    void add_pieces(std::span<const Sample> surface, const PointLimits& limits, EchoGrid& grid) {
        PatchBlock block;
        subdivide(surface, view_.shape, limits, block, [&](const PatchBlock& patches) {
            find(surface, patches, &limits);
            add_powers(beams_, patches, echoes_, grid);
        });
    }

    /// Adds the amplitudes of the scatterers of targets.
    void add_targets(std::span<const Sample> targets, EchoGrid& grid) {
        std::vector<std::pair<std::uint64_t, std::size_t>> by_surface;
        for (std::size_t k = 0; k < targets.size(); ++k) {
            by_surface.emplace_back(std::uint64_t{targets[k].instance} << 32U | targets[k].region,
                                    k);
        }
        std::ranges::sort(by_surface);
        std::vector<Sample> pieces;
        pieces.reserve(targets.size());
        for (const auto& [surface, k] : by_surface)
            pieces.push_back(targets[k]);
        add_point_amplitudes(
            model_, beams_,
            join_targets(pieces, view_.shape, model_.target_cell, surface_scattering(),
                         speckle_ == SpeckleMode::ping ? ping_draws_ : scene_draws_),
            ping_.counts, grid);
    }

    /// With `speckle: scene` the amplitudes of multipath are drawn for each ping: their phase
    /// depends on the shape of the reflector to a fraction of a wavelength, and no mesh is that
    /// exact.
    void add_multipath(const TracedPing& traced, EchoGrid& grid) {
        const std::vector<SpecularPath> paths = specular_paths(traced, context_.scene, view_.shape);
        if (paths.empty()) return;
        ping_.counts.echoes += 2 * paths.size();
        add_drawn_by_ping(ping_draws_, grid, [&](EchoGrid& powers) {
            std::uint64_t outside_beams = 0;
            const std::uint64_t outside_range = find_specular_echoes(
                paths, model_.scattering.materials, model_.equation, model_.limits,
                [&](const SpecularBlock& block) {
                    outside_beams += find_columns(beams_, block.places, block.echoes);
                    add_bistatic_powers(beams_, block.out, {block.places, block.echoes}, powers);
                });
            ping_.counts.out_of_range += outside_range + outside_beams;
        });
    }

    const CalibratedModel& model_;
    const Beams& beams_;
    const FormContext& context_;
    PhiloxKey scene_draws_, ping_draws_;
    SonarInScene sonar_;
    SpeckleMode speckle_;
    View view_;  ///< with the guard beams
    PieceStrengths strengths_;
    float speckle_gain_;  ///< restores the mean power where the grid's cells draw the speckle
    PointEchoes echoes_;
    std::unique_ptr<EchoGrid> mean_;  ///< the mean powers of the grid, if they are needed
    Ping& ping_;
};

}  // namespace

void form_look(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
               std::span<float> mean, Ping& ping) {
    std::visit(
        [&]<class Beams>(const Beams& of_model) {
            ImageFormer<Beams>(model, of_model, traced, context, ping).form(traced, mean);
        },
        model.beams);
}

}  // namespace sonarsim
