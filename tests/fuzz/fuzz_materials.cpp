#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.h"
#include "scene/materials.h"

// Any bytes as a material CSV: materials with positive finite densities and speeds and with finite
// numbers else, or InputError.

using namespace sonarsim;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
    try {
        const MaterialTable table =
            parse_materials(std::string_view(reinterpret_cast<const char*>(data), size), "m.csv");
        for (const Material& material : table.materials) {
            bool holds = !material.name.empty() && is_positive(material.density_kg_m3) &&
                         is_positive(material.sound_speed_m_s) &&
                         std::isfinite(material.lambert_db) &&
                         std::isfinite(material.slope_rms_deg);
            for (const auto& number :
                 {material.grain_phi, material.loss_parameter, material.spectral_strength_cm4,
                  material.spectral_exponent, material.volume_parameter})
                holds = holds && std::isfinite(number.value_or(0.0));
            if (!holds) std::abort();
        }
    } catch (const InputError&) {
        return 0;
    }
    return 0;
}
