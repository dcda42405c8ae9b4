#pragma once

#include "simulate/trace/echo_model.h"

namespace sonarsim {

/// Energies by Lambert's law, without noise: a patch of visible surface adds R cos^2(incidence)
/// area / range^4 to the bin of its centre. Multipath is left out.
struct LambertModel final : EchoModel {
    LambertModel() { info.energies_add = true; }

    void form(const TracedPing& traced, const FormContext& context, Ping& ping) const override;
    SurfaceEchoes surface_echoes(const TracedPing& traced, const View& view, const Scene& scene,
                                 const EchoRequest& request, const UseEchoes& use) const override;
    SignalAndNoise signal_and_noise(float clean, float /*noisy*/, int /*range_bin*/,
                                    int /*beam*/) const override {
        return {clean, 0.0};
    }
};

}  // namespace sonarsim
