#include "simulate/calibrated/directivity.h"

#include <cmath>

#include "core/units.h"
#include "simulate/calibrated/piston.h"

namespace sonarsim {

namespace {

/// The vertical side of a transmitter or a receiver, by the width of both together.
LineArray one_way_elevation(const BeamConfig& beam) {
    return line_array(std::sqrt(2.0) * radians(beam.elevation_width_deg), 0.0);
}

/// The integral of the pattern of an array over the sine of the angle.
double equivalent_sine(const LineArray& array) {
    return taper_loss(array) / array.wavelengths;
}

}  // namespace

double taper_loss(const LineArray& array) {
    // w = p + (1 - p) cos^2: the means of cos^2 and cos^4 are 1/2 and 3/8.
    const double p = array.pedestal;
    const double q = 1.0 - p;
    const double mean = p + 0.5 * q;
    return (p * p + p * q + 0.375 * q * q) / (mean * mean);
}

double line_directivity(const LineArray& array) {
    return 2.0 / equivalent_sine(array);
}

double rectangle_directivity(const LineArray& along, const LineArray& across) {
    return 4.0 * pi / (equivalent_sine(along) * equivalent_sine(across));
}

double piston_directivity(double width_rad) {
    const double circumference = piston_scale(width_rad);  // pi D / lambda
    return circumference * circumference;
}

double receiving_directivity(const BeamConfig& beam) {
    if (beam.aperture == Aperture::piston) return piston_directivity(radians(beam.width_deg));
    const LineArray along = line_array(radians(beam.width_deg), beam.side_lobe_db);
    if (beam.aperture == Aperture::port_starboard)
        return rectangle_directivity(along, line_array(radians(beam.across_width_deg), 0.0));
    if (beam.elevation_width_deg <= 0.0) return line_directivity(along);
    return rectangle_directivity(along, one_way_elevation(beam));
}

double transmitting_directivity(const BeamConfig& beam, const View& view) {
    if (beam.aperture != Aperture::line) return receiving_directivity(beam);
    const double sines = beam.elevation_width_deg > 0.0 ? equivalent_sine(one_way_elevation(beam))
                                                        : 2.0;  // elevations from -90 to 90 degrees
    return 4.0 * pi / (view.azimuth_rad * sines);
}

}  // namespace sonarsim
