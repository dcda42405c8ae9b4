#include "simulate/calibrated/water_column.h"

#include "calibrated/water_fixtures.h"
#include "simulate/calibrated/piston.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The greatest difference of an image's beams `from` to `to` from the closed form, dB. The pulse
/// reaches over the ends of the range in the first and the last bins.
template <class Psi>
double greatest_error_db(const CalibratedModel& model, const View& view, Psi psi_of_beam) {
    const std::vector<float> image = water_image(model, view);
    double worst = 0.0;
    for (int row = 10; row < view.range_bins - 10; ++row) {
        const double range_m = view.range_min_m + (row + 0.5) * view.bin_m();
        for (int beam = 0; beam < view.beams; ++beam) {
            const double psi = psi_of_beam(beam, range_m);
            if (psi == 0.0) continue;
            const double error =
                db_of_power(image[static_cast<std::size_t>(row) * view.beams + beam] /
                            expected_power(model, psi, range_m));
            worst = std::max(worst, std::fabs(error));
        }
    }
    return worst;
}

double sinc4(double t) {
    const double x = pi * t;
    return x == 0.0 ? 1.0 : std::pow(std::sin(x) / x, 4.0);
}

}  // namespace

TEST_SUITE("calibrated") {
    // The equivalent beam angle of a disc is 5.78 / (ka)^2 (e.g. Simmonds and MacLennan, Fisheries
    // Acoustics, 2005). The far side lobes outside the view, and that constant, leave 0.03 dB.
    TEST_CASE("water: the level in an echosounder, at every range") {
        const View view = view_of(ViewShape::cone, 40.0, 40.0, 1);
        const CalibratedModel model = sounder(SpeckleMode::none);
        const double ka = piston_scale(radians(7.0));
        CHECK(greatest_error_db(model, view, [&](int, double) { return 5.78 / (ka * ka); }) < 0.05);
    }

    // A fan whose pattern is constant over E of elevation. The beam at the sine u is a cone; about
    // its axis it sees 2 asin(sin(E / 2) / sqrt(1 - u^2)), and its width in u is the integral of
    // the array's pattern, taper_loss / (L / lambda). The outer beams have lobes beyond the view.
    TEST_CASE("water: the level in the beams of a fan, at every range") {
        InstrumentConfig config = instrument_of(Aperture::line, 2.0);
        config.beam.side_lobe_db = -25.0;
        const View view = view_of(ViewShape::fan, 90.0, 20.0, 64);
        const BeamSines sines = fan_sines(90.0, 64);
        const CalibratedModel model = calibrated_model(config, scattering_water(), view, sines);
        const LineArray array = line_array(radians(2.0), -25.0);
        const double width = taper_loss(array) / array.wavelengths;
        const auto psi = [&](int beam, double) {
            if (beam < 6 || beam >= 58) return 0.0;
            const double u = sines.middles[beam];
            return 2.0 * std::asin(std::sin(radians(10.0)) / std::sqrt(1.0 - u * u)) * width;
        };
        CHECK(greatest_error_db(model, view, psi) < 0.1);
    }

    // Beyond L^2 / lambda = 0.03 m^2 / 0.0074 m the patterns are those of the far field: across the
    // integral of sinc^4 over the angle, along 2 / 3 of lambda / L, since sinc^4 has that integral.
    TEST_CASE("water: the level in a side-scan sonar's far field") {
        InstrumentConfig config = instrument_of(Aperture::port_starboard, 2.5);
        const View view = view_of(ViewShape::port_starboard, 170.0, 60.0, 2);
        const CalibratedModel model = calibrated_model(config, scattering_water(), view, {});
        const LineArray along = line_array(radians(2.5), config.beam.side_lobe_db);
        const double across = line_array(radians(50.0), 0.0).wavelengths;
        double psi = 0.0;
        constexpr int steps = 1000;
        for (int k = 0; k < steps; ++k) {
            // Off the axis of the side, from straight down on, within the view.
            const double azimuth = radians(85.0) * (k + 0.5) / steps;
            const double other = azimuth - radians(70.0);
            const double step = radians(85.0) / steps;
            psi += sinc4(across * std::sin(other)) * step;
            if (std::cos(azimuth + radians(70.0)) > 0.0)
                psi += sinc4(across * std::sin(azimuth + radians(70.0))) * step;
        }
        psi *= 2.0 / 3.0 / along.wavelengths;
        const auto far = [&](int, double range_m) { return range_m > 15.0 ? psi : 0.0; };
        CHECK(greatest_error_db(model, view, far) < 0.15);
    }

    // As the fan's, but the head sends through the array, too: the integral of sinc^4.
    TEST_CASE("water: the level in a scanning sonar") {
        InstrumentConfig config = instrument_of(Aperture::head, 2.0);
        const View view = view_of(ViewShape::fan, 40.0, 20.0, 1);
        const CalibratedModel model = calibrated_model(config, scattering_water(), view, {});
        const LineArray array = line_array(radians(2.0), config.beam.side_lobe_db);
        const double psi = radians(20.0) * 2.0 / 3.0 / array.wavelengths;
        CHECK(greatest_error_db(model, view, [&](int, double) { return psi; }) < 0.05);
    }
}
