#include "calibrate/correlations.h"

#include <cmath>
#include <map>

namespace sonarsim {

Correlations correlations_of(const std::vector<PatchMoments>& patches,
                             const std::vector<std::size_t>& chosen,
                             const std::vector<double>& weights) {
    Correlations out;
    double variance = 0.0;
    for (const std::size_t k : chosen) {
        const PatchMoments& patch = patches[k];
        const double w = weights[static_cast<std::size_t>(patch.place)];
        variance += w * patch.variance;
        for (std::size_t lag = 0; lag < patch_lags; ++lag) {
            out.along_range[lag] += w * patch.along_range[lag];
            out.along_beams[lag] += w * patch.along_beams[lag];
        }
        ++out.patches;
    }
    for (std::size_t lag = 0; lag < patch_lags; ++lag) {
        out.along_range[lag] = 1.0 - out.along_range[lag] / variance;
        out.along_beams[lag] = 1.0 - out.along_beams[lag] / variance;
    }
    return out;
}

BeamCorrelations beam_correlations(const std::vector<PatchMoments>& patches,
                                   const std::vector<std::size_t>& chosen, bool new_in_each_ping) {
    using Lags = Eigen::Matrix<double, patch_lags, 1>;
    struct Unit {
        Lags structure = Lags::Zero();
        double variance = 0.0;
    };
    std::map<std::size_t, Unit> units;
    Unit all;
    for (const std::size_t k : chosen) {
        const Lags structure = Eigen::Map<const Lags>(patches[k].along_beams.data());
        Unit& unit = units[new_in_each_ping ? k : static_cast<std::size_t>(patches[k].place)];
        for (Unit* one : {&unit, &all}) {
            one->structure += structure;
            one->variance += patches[k].variance;
        }
    }
    BeamCorrelations out;
    out.units = static_cast<int>(units.size());
    const Lags left = all.structure / all.variance;
    out.mean = Lags::Ones() - left;
    out.covariance.setZero();
    for (const auto& numbered : units) {
        const Lags moved =
            (left * numbered.second.variance - numbered.second.structure) / all.variance;
        out.covariance += moved * moved.transpose();
    }
    return out;
}

}  // namespace sonarsim
