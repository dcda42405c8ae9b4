#pragma once

#include "input/mission/mission.h"
#include "input/scene/scene.h"
#include "simulate/calibrated/beams/beams.h"
#include "simulate/calibrated/equation/instrument_levels.h"
#include "simulate/calibrated/equation/sediment.h"
#include "simulate/calibrated/equation/sonar_equation.h"
#include "simulate/calibrated/equation/specular_echoes.h"
#include "simulate/calibrated/receiver/receiver_chain.h"
#include "simulate/calibrated/speckle/scatterers.h"
#include "simulate/calibrated/speckle/speckle.h"
#include "simulate/calibrated/water_column.h"
#include "simulate/trace/echo_model.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The calibrated echo model, docs/calibrated.md: an instrument, ready to measure echo levels.
struct CalibratedModel final : EchoModel {
    InstrumentConfig instrument;
    InstrumentLevels levels;
    SonarEquation equation;
    PointLimits limits;  ///< for pieces that are not scatterers of the scene
    ScattererCells cells;
    PointLimits target_cell;  ///< the pieces of a target within it are one scatterer
    RangeTaps amplitude_taps, power_taps;
    std::shared_ptr<const Beams> beams;
    Reverberation reverberation;
    DetectedSample detected;
    std::vector<float> column_gain;  ///< edge_gains() of the columns of the grid
    /// [range bins] The factor from the power of an echo to the value of the image.
    std::vector<float> row_gain;
    /// [range bins] The value of the receiver's mean noise.
    std::vector<float> noise_values;
    std::vector<float> analog_noise_values;  ///< without that of the converter
    std::optional<WaterColumn> water;        ///< its volume scattering; nothing: none
    SpeckleMode speckle = SpeckleMode::scene;
    double sound_speed_m_s = 0.0;
    double absorption_db_per_m = 0.0;
    double wavelength_m = 0.0;
    double water_density_kg_m3 = 0.0;
    std::vector<Material> prepared_materials;  ///< materials of the scene of prepared()
    std::optional<double> prepared_wind_m_s;   ///< the wind over its water, if its surface scatters
    Scattering scattering;  ///< these materials, then the water's surface if it scatters
    /// The scattering on and below sea beds; nothing: all comes from their surface.
    std::optional<SedimentScattering> sediment;
    Texture texture;

    bool is_prepared_for(const Scene& scene) const;
    std::shared_ptr<const CalibratedModel> prepared_for(const Scene& scene) const;

    std::shared_ptr<const EchoModel> prepared(const Scene& scene) const override;
    void form(const TracedPing& traced, const FormContext& context, Ping& ping) const override;
    SurfaceEchoes surface_echoes(const TracedPing& traced, const View& view, const Scene& scene,
                                 const EchoRequest& request, const UseEchoes& use) const override;
    SignalAndNoise signal_and_noise(float clean, float noisy, int range_bin,
                                    int beam) const override;
    void describe(nlohmann::ordered_json& sensor) const override;
    std::vector<std::uint16_t> raw(const Ping& ping) const override;
};

/// Sets up the instrument of a sonar with this view; only a line array needs `sines`.
CalibratedModel calibrated_model(const InstrumentConfig& instrument, const WaterConfig& water,
                                 const View& view, const BeamSines& sines);

/// Forms the image of one ping: [range bins, beams] powers after the gain into `ping.intensity`,
/// which must be 0 before, and the counts. The numbered steps are sections 1 to 5 of
/// docs/calibrated.md. `mean`: of the size of the image, receives it without noise and without the
/// draws of amplitudes; empty: not needed.
void form_look(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
               std::span<float> mean, Ping& ping);

/// Adds reverberation to a grid: the echoes of the water's volume, and the tails of all echoes,
/// whose mean powers are `powers`; these may be the grid. `gain`: as in draw_speckle(). `mean`:
/// receives their powers; null: none.
void add_reverberation(const CalibratedModel& model, const TracedPing& traced,
                       const FormContext& context, const EchoGrid& powers, PowerForm form,
                       float gain, EchoGrid& grid, EchoGrid* mean);

}  // namespace sonarsim
