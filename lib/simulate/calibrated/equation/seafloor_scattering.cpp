#include "simulate/calibrated/equation/seafloor_scattering.h"

#include <algorithm>
#include <array>

#include "core/decibel.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

using Complex = std::complex<double>;

template <class Number>
Number squared(Number x) {
    return x * x;
}

/// The square root in the upper half plane. The C library's root differs between processors.
Complex root(Complex z) {
    const double size = std::sqrt(std::norm(z));
    // The larger part is found first, so that nothing cancels.
    const double larger = std::sqrt(0.5 * (size + std::fabs(z.real())));
    const double smaller = 0.5 * z.imag() / larger;
    return z.real() >= 0.0 ? Complex(larger, smaller) : Complex(smaller, larger);
}

double gamma_function(double x) {
    return exponential(log_gamma(x));
}

/// `w2_cm4` is that of W(K) = w2 / (h K)^exponent with h = 1 cm, as in the report.
double spectral_strength_of(double w2_cm4, double exponent) {
    return w2_cm4 * 1e-8 * power(100.0, exponent);
}

/// The attenuation of sound in a sediment of grain size `phi`, in dB per m and kHz.
double attenuation_of(double phi) {
    if (phi < 0.0) return 0.4556;
    if (phi < 2.6) return 0.4556 + 0.0245 * phi;
    if (phi < 4.5) return 0.1978 + 0.1245 * phi;
    if (phi < 6.0) return 8.0399 + phi * (-2.5228 + 0.20098 * phi);
    return std::max(0.9431 + phi * (-0.2041 + 0.0117 * phi), 0.0601);
}

/// The regressions of the report from gravel of -1 phi on.
SeaBed sediment_of(double phi) {
    SeaBed bed{.spectral_exponent = usual_exponent};
    if (phi < 1.0) {
        bed.density_ratio = 2.3139 + phi * (-0.17057 + 0.007797 * phi);
        bed.speed_ratio = 1.2778 + phi * (-0.056452 + 0.002709 * phi);
    } else if (phi < 5.3) {
        bed.density_ratio = 3.0455 + phi * (-1.1069031 + phi * (0.2290201 - 0.0165406 * phi));
        bed.speed_ratio = 1.3425 + phi * (-0.1382798 + phi * (0.0213937 - 0.0014881 * phi));
    } else {
        bed.density_ratio = 1.1565 - 0.0012973 * phi;
        bed.speed_ratio = 1.0019 - 0.0024324 * phi;
    }
    constexpr double water_m_per_ms = 1.528;  // in the water of the report
    bed.loss = attenuation_of(phi) * bed.speed_ratio * water_m_per_ms * ln_10 / (40.0 * pi);
    const double height = phi < 5.0 ? (2.03846 - 0.26923 * phi) / (1.0 + 0.076923 * phi) : 0.5;
    bed.spectral_strength = spectral_strength_of(0.00207 * height * height, usual_exponent);
    bed.volume_parameter = phi < 5.5 ? 0.002 : 0.001;
    return bed;
}

}  // namespace

SeaBed sea_bed_of_grain_size(double phi) {
    if (phi >= -1.0) return sediment_of(phi);
    constexpr double rock_loss = 0.01374;
    const auto coarse = [](double density, double speed, double loss, double w2_cm4) {
        return SeaBed{density,        speed, loss, spectral_strength_of(w2_cm4, usual_exponent),
                      usual_exponent, 0.002};
    };
    if (phi <= -9.9999) return coarse(2.5, 2.5, rock_loss, 0.20693);
    if (phi < -7.0) {
        const double to_cobble = (phi + 10.0) / 3.0;
        return coarse(2.5, std::lerp(2.5, 1.8, to_cobble), rock_loss,
                      std::lerp(0.01862, 0.016, to_cobble));
    }
    const double to_gravel = (phi + 7.0) / 6.0;
    return coarse(std::lerp(2.5, 2.492, to_gravel), std::lerp(1.8, 1.337, to_gravel),
                  std::lerp(rock_loss, 0.01705, to_gravel), std::lerp(0.016, 0.012937, to_gravel));
}

bool is_sea_bed(const Material& material) {
    return material.grain_phi || material.loss_parameter;
}

SeaBed sea_bed_of(const Material& material, const Water& water) {
    SeaBed bed;
    if (material.grain_phi) {
        bed = sea_bed_of_grain_size(*material.grain_phi);
    } else {
        bed.density_ratio = material.density_kg_m3 / water.density_kg_m3;
        bed.speed_ratio = material.sound_speed_m_s / water.sound_speed_m_s;
        bed.spectral_exponent = usual_exponent;
    }
    bed.loss = material.loss_parameter.value_or(bed.loss);
    bed.volume_parameter = material.volume_parameter.value_or(bed.volume_parameter);
    const double exponent = material.spectral_exponent.value_or(bed.spectral_exponent);
    const double w2_cm4 = material.spectral_strength_cm4.value_or(
        bed.spectral_strength / spectral_strength_of(1.0, bed.spectral_exponent));
    bed.spectral_strength = spectral_strength_of(w2_cm4, exponent);
    bed.spectral_exponent = exponent;
    return bed;
}

SeafloorScattering::SeafloorScattering(const SeaBed& bed, double wavenumber)
    : bed_(bed),
      wavenumber_(wavenumber),
      index2_(squared(std::complex(1.0, bed.loss) / bed.speed_ratio)),
      alpha_(0.5 * bed.spectral_exponent - 1.0) {
    const double strength = bed.spectral_strength;
    const double span = 4.0 - bed.spectral_exponent;
    // Roughness longer than three wavelengths tilts the rest. The slopes are limited as in the
    // report, since the model is one of small slopes.
    slope_ = std::min(0.2, std::sqrt(pi * strength / span * power(wavenumber / 3.0, span)));

    const double inverse = 1.0 / alpha_;
    // The slope grows with frequency without bound. The report's rock has this slope at 2 MHz.
    constexpr double steepest = 3.5;
    shadowing_slope_ = std::min(
        steepest, std::sqrt(power(2.0 * pi * strength, inverse) / (2.0 * (1.0 - alpha_)) *
                            power(wavenumber * wavenumber / alpha_, (1.0 - alpha_) * inverse)));
    const double a =
        power(8.0 * alpha_ * alpha_ * gamma_function(0.5 * inverse + 0.5) /
                  (std::sqrt(pi) * gamma_function(inverse) * gamma_function(0.5 * inverse)),
              2.0 * alpha_);
    const double b = power(a, 0.5 + 0.5 * inverse) * gamma_function(inverse) / (2.0 * alpha_);
    // The structure function of the roughness, at the wavelength.
    const double q = 2.0 * pi * strength * gamma_function(2.0 - alpha_) *
                     power(2.0, 1.0 - 4.0 * alpha_) /
                     (alpha_ * (1.0 - alpha_) * gamma_function(1.0 + alpha_)) *
                     power(wavenumber, 2.0 * (1.0 - alpha_));
    const Complex impedance = bed.density_ratio / root(index2_);
    reflection_ = std::norm((impedance - 1.0) / (impedance + 1.0));
    peak_ = b * q * reflection_ / (8.0 * pi);
    flatness_ = a * q * q;
    power_ = (1.0 + alpha_) / (2.0 * alpha_);

    // The parts join where the Kirchhoff integral is 15 dB below its value at normal incidence.
    constexpr double lowest_rad = 0.02;
    constexpr int steps = 3000;
    const double threshold = kirchhoff(0.5 * pi) / power_of_db(15.0);
    int step = 0;
    const auto angle = [&](int k) { return std::lerp(lowest_rad, 0.5 * pi, double(k) / steps); };
    while (step < steps && kirchhoff(angle(step)) < threshold)
        ++step;
    joint_rad_ = angle(step);
}

Complex SeafloorScattering::vertical_wavenumber(double sine) const {
    return root(index2_ - (1.0 - sine * sine));
}

double SeafloorScattering::kirchhoff(double grazing_rad) const {
    const double cos2 = squared(sincos(grazing_rad).cos);
    const double sin2 = 1.0 - cos2;
    constexpr double min_normal = 1e-300;
    return peak_ /
           power(power(std::max(cos2, min_normal), 2.0 * alpha_) + flatness_ * sin2 * sin2, power_);
}

double SeafloorScattering::perturbation(double grazing_rad) const {
    // Nearer to normal incidence the Kirchhoff integral replaces it.
    const SinCos angle = sincos(std::clamp(grazing_rad, 1e-3, joint_rad_));
    const double rho = bed_.density_ratio;
    const Complex contrast = (squared((rho - 1.0) * angle.cos) + rho * rho - index2_) /
                             squared(rho * angle.sin + vertical_wavenumber(angle.sin));
    // The spectrum has no pole at normal incidence.
    const double horizontal = wavenumber_ * std::max(2.0 * angle.cos, 0.1);
    const double spectrum = bed_.spectral_strength * power(horizontal, -bed_.spectral_exponent);
    return 4.0 * squared(squared(wavenumber_ * angle.sin)) * std::norm(contrast) * spectrum;
}

double SeafloorScattering::composite(double grazing_rad) const {
    // The mean over normally distributed slopes, by Gauss and Hermite's rule of nine points.
    constexpr std::array<double, 5> points{0.0, 1.0232556637891326, 2.07684797867783,
                                           3.2054290028564703, 4.5127458633997835};
    constexpr std::array<double, 5> weights{0.4063492063492064, 0.2440975028949394,
                                            0.04991640676521791, 0.0027891413212317653,
                                            2.2345844007746576e-05};
    double sum = weights[0] * (grazing_rad > 0.0 ? perturbation(grazing_rad) : 0.0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        for (const double tilted :
             {grazing_rad + slope_ * points[i], grazing_rad - slope_ * points[i]})
            sum += weights[i] * (tilted > 0.0 ? perturbation(tilted) : 0.0);
    }
    return sum;
}

double SeafloorScattering::volume(double grazing_rad) const {
    const double sine = sincos(grazing_rad).sin;
    const Complex vertical = vertical_wavenumber(sine);
    const double rho_sine = bed_.density_ratio * sine;
    // |1 - R^2|^2 / |vertical|^2 without a cancellation; R = (rho_sine - vertical) / (their sum).
    const double passed = 16.0 * squared(rho_sine / std::norm(rho_sine + vertical));
    return 5.0 * bed_.loss * bed_.volume_parameter * passed * sine * sine /
           (bed_.speed_ratio * ln_10 * vertical.imag());
}

double SeafloorScattering::share(double grazing_rad) const {
    const double beyond = 80.0 * (sincos(grazing_rad).cos - sincos(joint_rad_).cos);
    return 1.0 / (1.0 + exponential(beyond));
}

double SeafloorScattering::unshadowed_share(double grazing_rad) const {
    const SinCos angle = sincos(grazing_rad);
    // The tangent of the angle over the slope. Above 2 the report has no shadows.
    const double t = angle.sin / std::max(angle.cos * shadowing_slope_, 1e-9);
    if (t > 2.0) return 1.0;
    if (t <= 0.0) return 0.0;
    const double gaussian = exponential(-t * t);
    // erfc(t) by Abramowitz and Stegun 7.1.26, to 1.5e-7.
    const double x = 1.0 / (1.0 + 0.3275911 * t);
    const double beyond =
        gaussian * x *
        (0.254829592 +
         x * (-0.284496736 + x * (1.421413741 + x * (-1.453152027 + x * 1.061405429))));
    const double hidden = (gaussian / std::sqrt(pi) - t * beyond) / (2.0 * t);
    return (1.0 - exponential(-hidden)) / hidden;
}

double SeafloorScattering::diffuse(double grazing_rad) const {
    return unshadowed_share(grazing_rad) *
           ((1.0 - share(grazing_rad)) * composite(grazing_rad) + volume(grazing_rad));
}

double SeafloorScattering::below(double grazing_rad) const {
    return unshadowed_share(grazing_rad) * volume(grazing_rad);
}

double SeafloorScattering::lag_m(double grazing_rad) const {
    const Complex vertical = vertical_wavenumber(sincos(grazing_rad).sin);
    return vertical.real() / (4.0 * wavenumber_ * vertical.imag());
}

double SeafloorScattering::specular(double grazing_rad) const {
    // The report has no Kirchhoff integral below 40 degrees, and no shadows on it. Here it extends
    // down to grazing incidence if the roughness is large.
    return unshadowed_share(grazing_rad) * share(grazing_rad) * kirchhoff(grazing_rad);
}

}  // namespace sonarsim
