#include <cmath>

#include "input/scene/materials.h"
#include "target.h"

// Any bytes as a material CSV: materials with positive densities and speeds and finite numbers.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace sonarsim;
    const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
    return read_or_refuse([&] {
        for (const Material& material : parse_materials(text_of(data, size), "m.csv").materials) {
            require(!material.name.empty() && is_positive(material.density_kg_m3) &&
                    is_positive(material.sound_speed_m_s) && std::isfinite(material.lambert_db) &&
                    std::isfinite(material.slope_rms_deg));
            for (const auto& number :
                 {material.grain_phi, material.loss_parameter, material.spectral_strength_cm4,
                  material.spectral_exponent, material.volume_parameter})
                require(std::isfinite(number.value_or(0.0)));
        }
    });
}
