#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "calibrated/array_beams.h"
#include "calibrated/scatterers.h"
#include "calibrated/sonar_equation.h"
#include "calibrated/specular_path.h"
#include "calibrated/target_scatterers.h"
#include "calibrated/transducer_beams.h"
#include "core/pose.h"
#include "mission/mission.h"
#include "scene/scene.h"
#include "trace/echo_model.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The calibrated echo model, docs/calibrated.md: an instrument, ready to turn what a sonar saw
/// into the echo levels that it measures.
struct CalibratedModel final : EchoModel {
    InstrumentConfig instrument;
    SonarEquation equation;
    PointLimits limits;  ///< for pieces that are not scatterers of the scene
    ScattererCells cells;
    TargetCells target_cells;
    Clutter clutter;
    RangeTaps amplitude_taps, power_taps;
    std::variant<TransducerBeams, ArrayBeams> beams;
    /// [range bins] The factor from the power of an echo to the value of the image.
    std::vector<float> row_gain;
    GuardBeams guard;
    SpeckleMode speckle = SpeckleMode::scene;
    double sound_speed_m_s = 0.0;
    double absorption_db_per_m = 0.0;
    double wavelength_m = 0.0;

    void form(const TracedPing& traced, const FormContext& context, Ping& ping) const override;
    std::span<const std::string_view> random_terms() const override;
    GuardBeams guard_beams() const override { return guard; }
    bool needs_scattered_paths() const override { return true; }
    double rays_goal(const View& view) const override;
    bool energies_add() const override { return true; }
    bool is_slow() const override { return true; }
    double working_bytes(bool multipath) const override;
    SignalAndNoise signal_and_noise(float clean, float noisy, int range_bin,
                                    int beam) const override;
    void describe(nlohmann::ordered_json& sensor) const override;
    int raw_bits() const override { return instrument.receiver.bits; }
    std::vector<std::uint16_t> raw(const Ping& ping) const override;
};

/// Sets up the instrument of a sonar with this view; `beam_sines` are the sines of the azimuths
/// that the beams of a fan look at.
CalibratedModel calibrated_model(const InstrumentConfig& instrument, const WaterConfig& water,
                                 const View& view, const std::vector<double>& beam_sines);

}  // namespace sonarsim
