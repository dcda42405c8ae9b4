#include "materials.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "calibrated/bottom.h"
#include "calibrated/decibel.h"
#include "core/text.h"
#include "core/units.h"
#include "logging.h"
#include "scene/materials.h"

namespace sonarsim {

namespace {

using Json = nlohmann::ordered_json;

/// The backscattering strength in dB.
double strength_db(const Backscatter& material, double grazing_deg) {
    constexpr double least = 1e-40;
    const auto sine = static_cast<float>(sincos(radians(grazing_deg)).sin);
    return db_of_power(std::max(least, static_cast<double>(material.at(sine))));
}

Json strengths_json(const MaterialTable& table, const Scattering& scattering,
                    double frequency_khz) {
    Json json{{"frequency_khz", frequency_khz}, {"grazing_deg", Json::array()}};
    for (int degree = 1; degree <= 90; ++degree)
        json["grazing_deg"].push_back(degree);
    for (std::size_t k = 0; k < table.materials.size(); ++k) {
        Json& strengths = json["strength_db"][table.materials[k].name];
        for (int degree = 1; degree <= 90; ++degree)
            strengths.push_back(strength_db(scattering.materials[k], degree));
    }
    return json;
}

void print_strengths(const MaterialTable& table, const Scattering& scattering,
                     double frequency_khz) {
    constexpr std::array<int, 9> grazing_deg{5, 10, 20, 30, 45, 60, 75, 85, 90};
    std::size_t width = 0;
    for (const Material& material : table.materials)
        width = std::max(width, material.name.size());
    fmt::print("backscattering strength at {:g} kHz, dB, by the grazing angle in degrees\n{:{}}",
               frequency_khz, "", width);
    for (const int degree : grazing_deg)
        fmt::print(" {:6}", degree);
    for (std::size_t k = 0; k < table.materials.size(); ++k) {
        fmt::print("\n{:{}}", printable(table.materials[k].name), width);
        for (const int degree : grazing_deg)
            fmt::print(" {:6.1f}", strength_db(scattering.materials[k], degree));
    }
    fmt::print("\n");
}

}  // namespace

void print_materials(const std::filesystem::path& file, double frequency_khz, bool as_json) {
    MaterialTable table = read_materials(file);
    const Water water;
    for (Material& material : table.materials)
        material.reflection = static_cast<float>(
            power_reflection(material.density_kg_m3, material.sound_speed_m_s, water));
    const Scattering scattering = scattering_of(table.materials, 1e3 * frequency_khz, water);
    if (as_json)
        fmt::print("{}", json_line(strengths_json(table, scattering, frequency_khz)));
    else
        print_strengths(table, scattering, frequency_khz);
}

}  // namespace sonarsim
