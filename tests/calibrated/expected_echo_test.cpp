#include "simulate/calibrated/equation/expected_echo.h"

#include "calibrated/preset_fixtures.h"
#include "core/decibel.h"

namespace {

/// The mean echo of sand over the noise, dB.
double sand_over_noise_db(const Sonar& sonar, double range_m) {
    const InstrumentLevels& levels = calibrated_model_of(sonar).levels;
    const ExpectedEcho echo = expected_echo(sonar.config.instrument, {}, sonar.settings.view);
    return levels.source_level_db +
           bottom_echo_db(echo, bottom_strength_db(echo, example_sand()), range_m) -
           levels.noise_db;
}

/// A floor of sand that meets the axis of a sonar at the origin at 20 degrees of grazing.
Scene sand_at(double range_m) {
    return bed_scene(example_sand(), static_cast<float>(2.0 * range_m),
                     -range_m * std::sin(radians(20.0)));
}

/// The mean of the rows about a range. Off the middle a beam is a cone at another angle.
double mean_at(const Sonar& sonar, const std::vector<float>& image, double range_m, int rows) {
    const int beams = sonar.settings.view.beams;
    return image_array(image, beams)
        .block(bin_at(sonar, range_m) - rows, beams / 4, 2 * rows + 1, beams - beams / 4 * 2)
        .mean();
}

/// A floor of a grain size at z = 0.
Scene bed_of(double phi) {
    return bed_scene({.name = "bed", .grain_phi = phi}, 150.0F, 0.0);
}

/// The mean power of range bins over pings and beams `first` to `last` of a preset over a bed.
Eigen::ArrayXd mean_rows(const Sonar& sonar, const Scene& scene, double altitude_m, int first,
                         int last) {
    constexpr int pings = 6;
    const auto engine = make_rays_engine(scene);
    const View& view = sonar.settings.view;
    Eigen::ArrayXd out = Eigen::ArrayXd::Zero(view.range_bins);
    for (std::uint32_t ping = 0; ping < pings; ++ping) {
        const Pose vehicle{.translation = {0.5 * ping, 0.0, altitude_m}};
        const Ping image = render_ping(sonar, scene, *engine, vehicle, {.seed = 1, .ping = ping});
        const auto beams = image_array(image.intensity, view.beams).middleCols(first, last - first);
        out += beams.cast<double>().rowwise().mean() / pings;
    }
    return out;
}

double mean_between(const Sonar& sonar, const Eigen::ArrayXd& rows, double from_m, double to_m) {
    const View& view = sonar.settings.view;
    const auto row_at = [&](double range_m) {
        return static_cast<int>(std::ceil((range_m - view.range_min_m) / view.bin_m() - 0.5));
    };
    return rows.segment(row_at(from_m), row_at(to_m) - row_at(from_m)).mean();
}

}  // namespace

// The noise is the mean of 81 rows or more. The mean of exponential powers is known to 0.5 dB,
// and the gain of those rows differs by less than that of their middle.
TEST_CASE("presets: a flat floor in the picture is as far above the noise as by closed form") {
    struct Case {
        std::string preset, keys;
        double pitch_deg, range_m;
    };
    for (const Case& c :
         {Case{"gemini_720is", "    azimuth_deg: 10\n    azimuth_bins: 21\n    instrument: {", 20.0,
               20.0},
          Case{"micron", "    sector_deg: 1\n    step_deg: 1\n    instrument: {", 20.0, 40.0},
          Case{"sidescan_900khz", "    instrument: {receiver: {samples: 1, expansion: 1}, ", 0.0,
               20.0}}) {
        CAPTURE(c.preset);
        const Sonar sonar = preset_sonar(c.preset, c.keys + "usual_water: none}\n");
        const CalibratedModel& model = calibrated_model_of(sonar);
        const Pose pose = pitched(c.pitch_deg);
        const std::vector<float> echo =
            expected_image(sonar, sand_at(c.range_m), EngineKind::rays, pose);
        const std::vector<float> noise =
            image_of_samples(model, sonar.settings.view, {}, {.random = 2});
        const double over_noise_db =
            db_of_power(mean_at(sonar, echo, c.range_m, 2) / mean_at(sonar, noise, c.range_m, 40));
        const double closed_db = sand_over_noise_db(sonar, c.range_m);
        CHECK(std::fabs(over_noise_db - closed_db) < 1.0);
        const double range_m =
            range_of_level([&](double r) { return sand_over_noise_db(sonar, r); }, closed_db);
        CHECK(std::fabs(range_m / c.range_m - 1.0) < 1e-6);
    }
}

// The pulse, 11 cm, holds the whole beam: at its edge the bottom is 2 cm farther.
TEST_CASE("presets: the bottom below an echosounder is as loud as by closed form") {
    const Sonar sonar =
        preset_sonar("echosounder_200khz", "    range_max_m: 25\n    range_bins: 500\n");
    constexpr double depth_m = 12.525;
    const std::vector<float> image =
        expected_image(sonar, sand_at(depth_m / std::sin(radians(20.0))), EngineKind::rays);
    // The image is relative to full scale.
    const CalibratedModel& model = calibrated_model_of(sonar);
    const double closed_db =
        sand_over_noise_db(sonar, depth_m) + model.levels.noise_db - model.levels.full_scale_db +
        tvg_db(sonar.config.instrument.receiver, model.absorption_db_per_m, depth_m);
    CHECK(std::fabs(db_of_power(std::ranges::max(image)) - closed_db) < 1.0);
}

// In files of real side-scan sonars the bottom is 35 dB above the water before it, which is
// even along range. Their bottoms are not known: silt at 900 kHz is the weakest of these.
TEST_CASE("presets: the water before the bottom of a side-scan sonar") {
    const auto level_db = [](const char* preset, double altitude_m, double phi) {
        const Sonar sonar = preset_sonar(preset, "");
        const Eigen::ArrayXd rows = mean_rows(sonar, bed_of(phi), altitude_m, 0, 2);
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

// In 20 pings of real multibeam sonars the first bottom echo is a ring, 31 dB above the water.
TEST_CASE("presets: the ring of a multibeam sonar") {
    const Sonar sonar =
        preset_sonar("bathymetric_400khz", "    range_max_m: 30\n    range_bins: 600\n");
    const View& view = sonar.settings.view;
    constexpr double altitude_m = 10.0;
    for (const double phi : {1.5, 6.0}) {
        // Beams from 35 to 55 degrees off.
        const Eigen::ArrayXd rows =
            mean_rows(sonar, bed_of(phi), altitude_m, view.beams * 5 / 120, view.beams * 25 / 120);
        const double ring = rows.segment(bin_at(sonar, altitude_m) - 2, 8).maxCoeff();
        const double water = mean_between(sonar, rows, 0.5 * altitude_m, 0.9 * altitude_m);
        CHECK(std::fabs(db_of_power(ring / water) - 31.0) < 6.0);
    }
}
