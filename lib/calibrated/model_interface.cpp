#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "calibrated/companding.h"
#include "calibrated/model.h"

namespace sonarsim {

namespace {

// In the order in which they enter an image.
constexpr std::array<std::string_view, 2> calibrated_terms{"speckle", "receiver_noise"};

}  // namespace

Scattering CalibratedModel::scattering_of(std::span<const Material> materials) const {
    return sonarsim::scattering_of(materials, instrument.frequency_hz,
                                   {water_density_kg_m3, sound_speed_m_s});
}

std::optional<SedimentScattering> CalibratedModel::sediment_of(std::span<const Material> materials,
                                                               const Scattering& whole) const {
    if (!instrument.below_bottom) return std::nullopt;
    return sediment_scattering(materials, instrument.frequency_hz,
                               {water_density_kg_m3, sound_speed_m_s}, equation.bin_m, whole);
}

std::shared_ptr<const EchoModel> CalibratedModel::prepared(const Scene& scene) const {
    auto out = std::make_shared<CalibratedModel>(*this);
    out->prepared_materials = scene.materials;
    out->scattering = scattering_of(scene.materials);
    out->sediment = sediment_of(scene.materials, out->scattering);
    if (scene.water_surface && scene.water_surface->wind_m_s)
        out->water_surface = wind_surface(*scene.water_surface->wind_m_s, instrument.frequency_hz);
    return out;
}

std::span<const std::string_view> CalibratedModel::random_terms() const {
    return calibrated_terms;
}

// In a cone slices are off by up to 1 %; rays are as fast and have a third of that error.
bool CalibratedModel::needs_rays(const View& view) const {
    return view.shape != ViewShape::fan;
}

double CalibratedModel::working_bytes(bool multipath) const {
    const auto columns =
        std::visit([](const auto& of_model) { return columns_of(of_model); }, beams);
    // Multipath has a grid of its own, sediment has two.
    const double grids = 1.0 + (multipath ? 1.0 : 0.0) + (instrument.below_bottom ? 2.0 : 0.0);
    // Several samples or looks are images of their own.
    const bool several = instrument.receiver.samples > 1 || instrument.receiver.looks > 1;
    const double images = several ? 2.0 * columns * equation.rows * sizeof(float) : 0.0;
    return grids * columns * equation.rows * sizeof(float) * 2.0 + images;
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
    if (receiver.tvg_step_db > 0.0) sensor["instrument"]["tvg_step_db"] = receiver.tvg_step_db;
}

std::span<const float> CalibratedModel::mean_noise() const {
    constexpr double none_db = -300.0;  // docs/mission.md
    const bool has_noise =
        levels.noise_db > none_db || instrument.receiver.common_mode_db > none_db;
    return has_noise ? std::span<const float>(noise_values) : std::span<const float>();
}

std::vector<std::uint16_t> CalibratedModel::raw(const Ping& ping) const {
    return companded(ping.intensity, instrument.receiver);
}

}  // namespace sonarsim
