#pragma once

#include "paper/pixel_noise.h"
#include "paper/range_noise.h"
#include "paper/streaks.h"
#include "trace/echo_model.h"

namespace sonarsim {

/// The paper's echo model: steps 3 to 7 of docs/model.md.
struct PaperModel final : EchoModel {
    RangeNoise range_noise;
    PixelNoise pixel_noise;
    Streaks streaks;

    void form(const TracedPing& traced, const FormContext& context, Ping& ping) const override;
    std::span<const std::string_view> random_terms() const override;
    SignalAndNoise signal_and_noise(float clean, float noisy, int range_bin,
                                    int beam) const override;
};

}  // namespace sonarsim
