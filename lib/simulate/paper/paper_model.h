#pragma once

#include <vector>

#include "input/mission/mission.h"
#include "simulate/paper/noise.h"
#include "simulate/trace/echo_model.h"

namespace sonarsim {

/// The paper's echo model: steps 3 to 7 of docs/model.md.
struct PaperModel final : EchoModel {
    RangeNoise range_noise;
    PixelNoise pixel_noise;
    Streaks streaks;

    void form(const TracedPing& traced, const FormContext& context, Ping& ping) const override;
    SurfaceEchoes surface_echoes(const TracedPing& traced, const View& view, const Scene& scene,
                                 const EchoRequest& request, const UseEchoes& use) const override;
    SignalAndNoise signal_and_noise(float clean, float noisy, int range_bin,
                                    int beam) const override;
};

/// The properties of a sonar on which its noise depends.
struct PaperSonar {
    double gain;                            ///< m of Eq. 12, unless the mission sets it
    bool range_noise_fades;                 ///< Eq. 8
    std::vector<float> range_scale;         ///< for PixelNoise
    std::vector<double> beam_azimuths_rad;  ///< middles of a fan's beams; empty: no lobe
    int beams;
};

/// The model with the noise and the streaks of the mission. If the mission asks for it, the pixel
/// noise of a fan has the lobe of Eq. 10 over its beams, 1 + 0.5 exp(-phi^2 / (2 sigma^2)).
PaperModel paper_model(const SonarConfig& config, const PaperSonar& sonar);

}  // namespace sonarsim
