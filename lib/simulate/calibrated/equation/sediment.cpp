#include "simulate/calibrated/equation/sediment.h"

#include <algorithm>

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/equation/seafloor_scattering.h"

namespace sonarsim {

std::optional<SedimentScattering> sediment_scattering(std::span<const Material> materials,
                                                      double frequency_hz, const Water& water,
                                                      double bin_m, const Scattering& whole) {
    // As a share of a bin: below it less than e^-4 of the energy lies behind the surface's bin.
    constexpr double shortest_lag = 0.25;
    const double wavenumber = 2.0 * pi * frequency_hz / water.sound_speed_m_s;
    SedimentScattering out{.surface = whole, .volume = {}, .lag_m = {}, .has = {}};
    out.volume.materials.resize(materials.size());
    out.volume.sea_beds.resize(materials.size() * AngularTable::size, 0.0F);
    out.lag_m.resize(materials.size() * AngularTable::size, 0.0F);
    for (std::size_t m = 0; m < materials.size(); ++m) {
        out.has.push_back(false);
        if (!is_sea_bed(materials[m])) continue;
        const SeafloorScattering bed(sea_bed_of(materials[m], water), wavenumber);
        // The lag is longest at normal incidence.
        if (bed.lag_m(0.5 * pi) < shortest_lag * bin_m) continue;
        out.has[m] = true;
        for (int k = 0; k < AngularTable::size; ++k) {
            const std::size_t at = m * AngularTable::size + k;
            const double grazing_rad = arcsin(AngularTable::sine(k));
            float& surface = out.surface.sea_beds[at];
            out.volume.sea_beds[at] = std::min(static_cast<float>(bed.below(grazing_rad)), surface);
            surface -= out.volume.sea_beds[at];
            float& diffuse = out.surface.materials[m].diffuse[k];  // that targets have
            diffuse = std::max(diffuse - out.volume.sea_beds[at], 0.0F);
            out.lag_m[at] = static_cast<float>(bed.lag_m(grazing_rad));
        }
    }
    if (std::ranges::find(out.has, true) == out.has.end()) return std::nullopt;
    return out;
}

void weigh_by_lag(const SedimentScattering& sediment, const PatchBlock& pieces, float bin_m,
                  PointEchoes& echoes) {
    for (int k = 0; k < pieces.count; ++k) {
        const float sine = pieces.height_m[k] / echoes.range_m[k];
        const float* const lags =
            sediment.lag_m.data() + std::size_t{AngularTable::size} * pieces.material[k];
        echoes.power[k] *= AngularTable::value(lags, sine) / bin_m;
    }
}

void spread_below(const EchoGrid& lagged, EchoGrid& energy) {
    for (int column = 0; column < energy.columns(); ++column) {
        const float* const added_lag = lagged.column(column);
        float* const cells = energy.column(column);
        double left = 0.0;      // energy still in the sediment
        double left_lag = 0.0;  // the same times its lag, in bins
        // An echo before the middle of the first bin is shared with the bin before.
        for (std::ptrdiff_t row = -1; row < energy.rows(); ++row) {
            left += cells[2 * row];
            left_lag += added_lag[2 * row];
            if (!(left > 0.0)) continue;
            const double lag = left_lag / left;
            const double stays = lag > 0.0 ? exponential(-1.0 / lag) : 0.0;
            cells[2 * row] = static_cast<float>((1.0 - stays) * left);
            left *= stays;
            left_lag *= stays;
            // Less than this is lost when a float adds it to the echo itself.
            if (left < 1e-30) left = left_lag = 0.0;
        }
    }
}

}  // namespace sonarsim
