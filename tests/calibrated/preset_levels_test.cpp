#include "calibrated/preset_fixtures.h"
#include "simulate/calibrated/decibel.h"
#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// A floor of a grain size at z = 0.
Scene bed_of(double phi) {
    Scene scene = empty_scene();
    const std::uint32_t bed = add_material(scene, 0.1F);
    scene.materials[bed].grain_phi = phi;
    add_floor(scene, 150.0F, 0.0F, bed, 4);
    return scene;
}

/// The mean power of each range bin over pings and the beams from `first` to `last` of a sonar over
/// a bed, as its preset delivers it.
std::vector<double> mean_rows(const Sonar& sonar, const Scene& scene, double altitude_m, int first,
                              int last) {
    constexpr int pings = 6;
    const auto engine = make_engine(scene, {.type = EngineKind::rays, .octree = {}});
    const View& view = sonar.settings.view;
    std::vector<double> out(view.range_bins);
    for (std::uint32_t ping = 0; ping < pings; ++ping) {
        Pose vehicle;
        vehicle.translation = {0.5 * ping, 0.0, altitude_m};
        const std::vector<float> image =
            render_ping(sonar, scene, *engine, vehicle, {.seed = 1, .ping = ping}).intensity;
        for (int row = 0; row < view.range_bins; ++row) {
            for (int beam = first; beam < last; ++beam) {
                out[row] += image[static_cast<std::size_t>(row) * view.beams + beam] /
                            static_cast<double>(pings * (last - first));
            }
        }
    }
    return out;
}

double mean_between(const Sonar& sonar, const std::vector<double>& rows, double from_m,
                    double to_m) {
    const View& view = sonar.settings.view;
    const auto row_at = [&](double range_m) {
        return static_cast<int>(std::ceil((range_m - view.range_min_m) / view.bin_m() - 0.5));
    };
    return mean({rows.begin() + row_at(from_m), rows.begin() + row_at(to_m)});
}

}  // namespace

TEST_SUITE("calibrated") {
    // In files of real side-scan sonars the bottom is 35 dB above the water before it, which is
    // even along range. Their bottoms are not known: silt at 900 kHz is the weakest of these.
    TEST_CASE("presets: the water before the bottom of a side-scan sonar") {
        const auto level_db = [](const char* preset, double altitude_m, double phi) {
            const Sonar sonar = preset_sonar(preset, "");
            const std::vector<double> rows = mean_rows(sonar, bed_of(phi), altitude_m, 0, 2);
            const double bottom = mean_between(sonar, rows, 1.33 * altitude_m, 2.67 * altitude_m);
            const double water = mean_between(sonar, rows, 1.2, 0.9 * altitude_m);
            return db_of_power(bottom / water);
        };
        // Sand, silty sand, silt.
        for (const double phi : {1.5, 4.0, 6.0}) {
            CHECK(std::fabs(level_db("sidescan_900khz", 5.0, phi) - 35.0) < 9.0);
            CHECK(std::fabs(level_db("sidescan_400khz", 6.0, phi) - 35.0) < 6.0);
        }
    }

    // In all of 20 pings of real multibeam sonars that look down, the first bottom echo makes a
    // ring in all beams, 31 dB above the water.
    TEST_CASE("presets: the ring of a multibeam sonar") {
        const Sonar sonar =
            preset_sonar("bathymetric_400khz", "    range_max_m: 30\n    range_bins: 600\n");
        const View& view = sonar.settings.view;
        constexpr double altitude_m = 10.0;
        for (const double phi : {1.5, 6.0}) {
            // Beams from 35 to 55 degrees off.
            const std::vector<double> rows = mean_rows(sonar, bed_of(phi), altitude_m,
                                                       view.beams * 5 / 120, view.beams * 25 / 120);
            const int first = static_cast<int>((altitude_m - view.range_min_m) / view.bin_m());
            const double ring =
                *std::max_element(rows.begin() + first - 2, rows.begin() + first + 6);
            const double water = mean_between(sonar, rows, 0.5 * altitude_m, 0.9 * altitude_m);
            CHECK(std::fabs(db_of_power(ring / water) - 31.0) < 6.0);
        }
    }
}
