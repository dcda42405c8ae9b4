#include "calibrated/sediment_paths.h"

#include "calibrated/seafloor_scattering.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

std::vector<SedimentPath> sediment_paths(std::span<const Material> materials, const Water& water,
                                         double frequency_hz, double absorption_db_per_m) {
    const double water_loss_per_m = 0.2 * logarithm(10.0) * absorption_db_per_m;
    const double wavenumber = 2.0 * pi * frequency_hz / water.sound_speed_m_s;
    std::vector<SedimentPath> out(materials.size());
    for (std::size_t k = 0; k < out.size(); ++k) {
        if (!is_sea_bed(materials[k])) continue;
        const SeaBed bed = sea_bed_of(materials[k], water);
        out[k] = {.speed_ratio = bed.speed_ratio,
                  .density_ratio = bed.density_ratio,
                  .loss_per_m = (4.0 * wavenumber * bed.loss - water_loss_per_m) / bed.speed_ratio};
    }
    return out;
}

}  // namespace sonarsim
