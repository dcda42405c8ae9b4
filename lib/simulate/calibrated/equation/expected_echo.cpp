#include "simulate/calibrated/equation/expected_echo.h"

#include <algorithm>

#include "core/decibel.h"
#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/equation/seafloor_scattering.h"
#include "simulate/calibrated/equation/water.h"
#include "simulate/calibrated/signal/directivity.h"
#include "simulate/calibrated/signal/range_response.h"

namespace sonarsim {

namespace {

constexpr double grazing_deg = 20.0;

/// Integral over [-end, end] of an even function by midpoints.
template <class Function>
double even_integral(double end, double step, const Function& value) {
    const int steps = 16 + static_cast<int>(end / step);
    double sum = 0.0;
    for (int k = 0; k < steps; ++k)
        sum += value(end * (k + 0.5) / steps);
    return 2.0 * end / steps * sum;
}

double square(double x) {
    return x * x;
}

/// The solid angle of the two-way beam of a disc, to the end of the view.
double piston_solid_angle(double width_rad, double end_rad) {
    const double scale = piston_scale(width_rad);
    return pi * even_integral(end_rad, 0.02 * width_rad, [&](double angle) {
               const SinCos off = sincos(angle);
               return square(square(piston_pattern(scale * off.sin))) * off.sin;
           });
}

/// The two-way power of a side-scan array at the sine u.
double near_power(const ExpectedEcho& echo, double u, double range_m) {
    // At ranges below the array's length the pattern is that at its length.
    const double range = std::max(range_m, echo.along.wavelengths * echo.wavelength_m);
    return square(std::norm(unfocused_pattern(echo.along, u, echo.wavelength_m, 1.0 / range)));
}

/// The integral of the two-way pattern along a range bin.
double pattern_integral(const ExpectedEcho& echo, double range_m) {
    const double length_m = echo.along.wavelengths * echo.wavelength_m;
    const bool near = range_m < 10.0 * length_m * echo.along.wavelengths;
    if (echo.aperture != Aperture::port_starboard || !near) return echo.far_integral;
    const double reach = length_m / std::max(range_m, length_m) + 4.0 / echo.along.wavelengths;
    return even_integral(std::min(reach, echo.greatest_sine), 0.1 / echo.along.wavelengths,
                         [&](double u) { return near_power(echo, u, range_m); });
}

double spreading_and_absorption_db(const ExpectedEcho& echo, double range_m) {
    return 4.0 * db_of_power(range_m) + 2.0 * echo.absorption_db_per_m * range_m;
}

/// The insonified area of the bottom.
double cell_area_m2(const ExpectedEcho& echo, double range_m) {
    if (echo.aperture == Aperture::piston) {
        // The beam over the ring that the pulse covers.
        const double ring_rad = 0.5 * pi - arcsin(range_m / (range_m + echo.pulse_length_m));
        return piston_solid_angle(echo.width_rad, std::min(echo.half_opening_rad, ring_rad)) *
               square(range_m);
    }
    return pattern_integral(echo, range_m) * range_m * echo.pulse_length_m /
           sincos(echo.grazing_rad).cos;
}

}  // namespace

double scattering_strength(const Material& sea_bed, double frequency_hz, double sine) {
    const Water water;
    const SeafloorScattering scattering(sea_bed_of(sea_bed, water),
                                        2.0 * pi * frequency_hz / water.sound_speed_m_s);
    const double grazing_rad = arcsin(sine);
    return scattering.diffuse(grazing_rad) + scattering.specular(grazing_rad);
}

const std::array<Material, 3>& example_bottoms() {
    static const std::array<Material, 3> bottoms{{{.name = "mud", .grain_phi = 8.0},
                                                  {.name = "sand", .grain_phi = 1.5},
                                                  {.name = "rock", .grain_phi = -9.99}}};
    return bottoms;
}

bool is_profile(const View& view) {
    constexpr double thickest_deg = 5.0;
    return view.shape == ViewShape::fan && view.elevation_rad < radians(thickest_deg);
}

ExpectedEcho expected_echo(const InstrumentConfig& instrument, const WaterConfig& water,
                           const View& view) {
    const BeamConfig& beam = instrument.beam;
    const double width = radians(beam.width_deg);
    ExpectedEcho out;
    out.aperture = beam.aperture;
    out.along = line_array(width, beam.side_lobe_db);
    out.frequency_hz = instrument.frequency_hz;
    out.wavelength_m = water.sound_speed_m_s / instrument.frequency_hz;
    out.absorption_db_per_m = absorption_db_per_m(
        instrument.frequency_hz, {water.temperature_c, water.salinity_psu, water.depth_m});
    out.pulse_length_m = pulse_band(instrument.pulse, view.bin_m(), water.sound_speed_m_s).length_m;
    out.grazing_rad = radians(beam.aperture == Aperture::piston ? 90.0 : grazing_deg);
    const auto two_way = [&](double u) { return square(square(line_pattern(out.along, u))); };
    if (beam.aperture == Aperture::piston) {
        out.width_rad = width;
        out.half_opening_rad = 0.5 * view.elevation_rad;
    } else if (beam.aperture == Aperture::line) {
        // The transmitter is uniform in azimuth. A profiler has its elevation along a range bin.
        if (beam.elevation_width_deg > 0.0 && is_profile(view))
            out.along = line_array(radians(beam.elevation_width_deg), beam.elevation_side_lobe_db);
        out.far_integral = taper_loss(out.along) / out.along.wavelengths;
    } else {
        const bool head = beam.aperture == Aperture::head;
        out.greatest_sine =
            sincos(std::min(0.5 * (head ? view.azimuth_rad : view.elevation_rad), 0.5 * pi)).sin;
        out.far_integral = even_integral(std::min(out.greatest_sine, 4.0 / out.along.wavelengths),
                                         0.02 / out.along.wavelengths, two_way);
    }
    return out;
}

double bottom_strength_db(const ExpectedEcho& echo, const Material& material) {
    return db_of_power(
        scattering_strength(material, echo.frequency_hz, sincos(echo.grazing_rad).sin));
}

double bottom_echo_db(const ExpectedEcho& echo, double strength_db, double range_m) {
    return strength_db + db_of_power(cell_area_m2(echo, range_m)) -
           spreading_and_absorption_db(echo, range_m);
}

double target_echo_db(const ExpectedEcho& echo, double target_strength_db, double range_m) {
    const bool unfocused = echo.aperture == Aperture::port_starboard;
    const double loss_db = unfocused ? db_of_power(near_power(echo, 0.0, range_m)) : 0.0;
    return target_strength_db + loss_db - spreading_and_absorption_db(echo, range_m);
}

}  // namespace sonarsim
