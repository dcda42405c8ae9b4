#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/clock.h"
#include "simulate/calibrated/equation/bottom.h"
#include "simulate/calibrated/model.h"
#include "simulate/calibrated/receiver/receiver_chain.h"

namespace sonarsim {

namespace {

std::optional<double> wind_over(const Scene& scene) {
    return scene.water_surface ? scene.water_surface->wind_m_s : std::nullopt;
}

}  // namespace

void CalibratedModel::form(const TracedPing& traced, const FormContext& context, Ping& ping) const {
    if (!is_prepared_for(context.scene))
        return prepared_for(context.scene)->form(traced, context, ping);
    Stopwatch watch;
    const ReceiverConfig& receiver = instrument.receiver;
    std::vector<float> mean;
    if (detected.changes() && context.terms.random > 0) mean.resize(ping.intensity.size());
    form_look(*this, traced, context, mean, ping);
    const ImageRows rows{.range_min_m = context.view.range_min_m,
                         .bin_m = context.view.bin_m(),
                         .bin_s = 2.0 * context.view.bin_m() / sound_speed_m_s,
                         .pulse_bins = amplitude_taps.reach + 1,
                         .rows = context.view.range_bins,
                         .beams = context.view.beams,
                         .noise = noise_values};
    if (!mean.empty()) {
        // The mean is that of the draws, for the same places of the scatterers.
        if (context.terms.random > 1)
            add_to_rows(std::span(noise_values).first(rows.rows), rows, mean);
        detected.apply(mean, ping.intensity);
    }
    // Faults belong to the receiver's noise, the last of the random terms.
    if (context.terms.random > 1) add_faults(receiver, rows, context.draws, ping.intensity);
    ping.seconds.accumulate = watch.lap();
}

bool CalibratedModel::is_prepared_for(const Scene& scene) const {
    return prepared_materials == scene.materials && prepared_wind_m_s == wind_over(scene);
}

std::shared_ptr<const CalibratedModel> CalibratedModel::prepared_for(const Scene& scene) const {
    const Water seawater{water_density_kg_m3, sound_speed_m_s};
    auto out = std::make_shared<CalibratedModel>(*this);
    out->prepared_materials = scene.materials;
    out->scattering = scattering_of(scene.materials, instrument.frequency_hz, seawater);
    out->texture = Texture(scene.materials, instrument.speckle.texture);
    out->info.wall_transmissions =
        two_way_transmissions(scene.materials, instrument.frequency_hz, seawater);
    out->sediment.reset();
    if (instrument.below_bottom) {
        out->sediment = sediment_scattering(scene.materials, instrument.frequency_hz, seawater,
                                            equation.bin_m, out->scattering);
    }
    out->prepared_wind_m_s = wind_over(scene);
    if (out->prepared_wind_m_s)
        append(wind_surface(*out->prepared_wind_m_s, instrument.frequency_hz), out->scattering);
    return out;
}

std::shared_ptr<const EchoModel> CalibratedModel::prepared(const Scene& scene) const {
    return prepared_for(scene);
}

EchoModel::SignalAndNoise CalibratedModel::signal_and_noise(float clean, float noisy,
                                                            int /*range_bin*/, int /*beam*/) const {
    return {clean, std::fabs(noisy - clean)};
}

void CalibratedModel::describe(nlohmann::ordered_json& sensor) const {
    const ReceiverConfig& receiver = instrument.receiver;
    const bool absolute = !is_relative_source(levels.source_level_db);
    // The gain is constant up to tvg_from_m.
    const std::string range = receiver.tvg_from_m > 0.0 ? "max(range_m, tvg_from_m)" : "range_m";
    sensor["instrument"] = {
        {"echo_level", "full_scale_db + 10 log10(polar) - tvg_log log10(" + range + ")" +
                           (receiver.tvg_absorption ? " - 2 absorption_db_per_m " + range : "")},
        {"echo_level_unit", absolute ? "dB re 1 uPa" : "dB re the source level, per uPa at 1 m"},
        {"source_level_db", levels.source_level_db},
        {"noise_db", levels.noise_db},
        {"full_scale_db", levels.full_scale_db},
        {"tvg_log", receiver.tvg_log},
        {"absorption_db_per_m", absorption_db_per_m},
        {"tvg_makes_up_for_absorption", receiver.tvg_absorption},
        {"sound_speed_m_s", sound_speed_m_s},
        {"wavelength_m", wavelength_m}};
    if (receiver.tvg_from_m > 0.0) sensor["instrument"]["tvg_from_m"] = receiver.tvg_from_m;
}

std::vector<std::uint16_t> CalibratedModel::raw(const Ping& ping) const {
    return companded(ping.intensity, instrument.receiver);
}

}  // namespace sonarsim
