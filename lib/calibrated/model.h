#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "calibrated/array_beams.h"
#include "calibrated/instrument_levels.h"
#include "calibrated/scatterers.h"
#include "calibrated/sediment.h"
#include "calibrated/sonar_equation.h"
#include "calibrated/specular_path.h"
#include "calibrated/target_scatterers.h"
#include "calibrated/transducer_beams.h"
#include "calibrated/water_column.h"
#include "calibrated/wind_surface.h"
#include "core/pose.h"
#include "mission/mission.h"
#include "scene/scene.h"
#include "trace/echo_model.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The calibrated echo model, docs/calibrated.md: an instrument, ready to turn traced surface into
/// the echo levels that it measures.
struct CalibratedModel final : EchoModel {
    InstrumentConfig instrument;
    InstrumentLevels levels;
    SonarEquation equation;
    PointLimits limits;  ///< for pieces that are not scatterers of the scene
    ScattererCells cells;
    TargetCells target_cells;
    Clutter clutter;
    RangeTaps amplitude_taps, power_taps;
    std::variant<TransducerBeams, ArrayBeams> beams;
    /// [samples in range] The factor from the power of an echo to the value of the image.
    std::vector<float> row_gain;
    /// [range bins of the image] The value of the receiver's mean noise.
    std::vector<float> noise_values;
    std::optional<WaterColumn> water;  ///< its volume scattering; nothing: none
    GuardBeams guard;
    ConeBeams cones;  ///< the beams of a line array
    SpeckleMode speckle = SpeckleMode::scene;
    double sound_speed_m_s = 0.0;
    double absorption_db_per_m = 0.0;
    double wavelength_m = 0.0;
    double water_density_kg_m3 = 0.0;
    std::vector<Material> prepared_materials;  ///< materials of the scene of prepared()
    Scattering scattering;                     ///< the scattering of these materials
    /// The parts of the scattering on and below sea beds; nothing: the whole echo comes from their
    /// surface.
    std::optional<SedimentScattering> sediment;
    WindSurface water_surface;  ///< its table, if the model was prepared for it

    Scattering scattering_of(std::span<const Material> materials) const;
    std::optional<SedimentScattering> sediment_of(std::span<const Material> materials,
                                                  const Scattering& whole) const;

    std::shared_ptr<const EchoModel> prepared(const Scene& scene) const override;
    void form(const TracedPing& traced, const FormContext& context, Ping& ping) const override;
    SurfaceEchoes surface_echoes(const TracedPing& traced, const View& view, const Scene& scene,
                                 bool patches) const override;
    std::span<const std::string_view> random_terms() const override;
    GuardBeams guard_beams() const override { return guard; }
    bool needs_scattered_paths() const override { return true; }
    bool needs_rays(const View& view) const override;
    bool energies_add() const override { return true; }
    bool is_slow() const override { return true; }
    double working_bytes(bool multipath) const override;
    SignalAndNoise signal_and_noise(float clean, float noisy, int range_bin,
                                    int beam) const override;
    void describe(nlohmann::ordered_json& sensor) const override;
    int raw_bits() const override { return instrument.receiver.bits; }
    std::vector<std::uint16_t> raw(const Ping& ping) const override;
    std::span<const float> mean_noise() const override;
};

/// The sines of the azimuths of a fan's beams, and of the edges between them.
struct BeamSines {
    std::vector<double> middles, edges;  ///< the edges are one more
};

/// Sets up the instrument of a sonar with this view; only a line array needs `sines`.
CalibratedModel calibrated_model(const InstrumentConfig& instrument, const WaterConfig& water,
                                 const View& view, const BeamSines& sines);

/// The scattering of a scene's materials: that of the model if it was prepared for them, else one
/// of its own.
class ScatteringOfScene {
  public:
    ScatteringOfScene(const CalibratedModel& model, const Scene& scene)
        : own_(model.prepared_materials == scene.materials ? Scattering{}
                                                           : model.scattering_of(scene.materials)),
          own_sediment_(own_.materials.empty() ? std::nullopt
                                               : model.sediment_of(scene.materials, own_)),
          used_(own_.materials.empty() ? &model.scattering : &own_),
          sediment_(own_.materials.empty() ? &model.sediment : &own_sediment_) {}
    ScatteringOfScene(const ScatteringOfScene&) = delete;
    ScatteringOfScene& operator=(const ScatteringOfScene&) = delete;

    const Scattering& operator*() const { return *used_; }
    const Scattering* operator->() const { return used_; }
    /// The sediment below sea beds; null: all echoes come from surfaces.
    const SedimentScattering* sediment() const { return *sediment_ ? &**sediment_ : nullptr; }

  private:
    Scattering own_;
    std::optional<SedimentScattering> own_sediment_;
    const Scattering* used_;
    const std::optional<SedimentScattering>* sediment_;
};

}  // namespace sonarsim
