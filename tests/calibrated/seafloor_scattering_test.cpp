#include "simulate/calibrated/equation/seafloor_scattering.h"

#include "core/decibel.h"
#include "simulate/calibrated/equation/bottom.h"
#include "support/draws.h"

namespace {

Material grain_size_material(double phi) {
    return {.name = "bed", .grain_phi = phi};
}

Backscatter scattering_at(const Material& material, double frequency_hz,
                          const Water& water = {1000.0, 1500.0}) {
    return scattering_of({&material, 1}, frequency_hz, water).materials[0];
}

double db_at(const Backscatter& bed, double grazing_deg) {
    return db_of_power(bed.at(static_cast<float>(std::sin(radians(grazing_deg)))));
}

constexpr std::array<double, 9> grazing_deg{5, 10, 20, 30, 45, 60, 75, 85, 90};

/// The shadowing of the report in dB, Eq. 43 to 45, of a bed by its grain size, at 1,500 m/s.
double shadowing_db(double phi, double frequency_hz, double angle_deg) {
    const double alpha = 0.5 * 3.25 - 1.0;
    const double k_per_cm = 2.0 * pi * frequency_hz / 150000.0;
    const double w2_cm4 =
        sea_bed_of_grain_size(phi).spectral_strength / (1e-8 * std::pow(100.0, 3.25));
    const double slope =
        std::sqrt(std::pow(2.0 * pi * w2_cm4, 1.0 / alpha) / (2.0 * (1.0 - alpha)) *
                  std::pow(k_per_cm * k_per_cm / alpha, (1.0 - alpha) / alpha));
    const double t = std::tan(radians(angle_deg)) / slope;
    if (t > 2.0) return 0.0;
    const double q = (std::exp(-t * t) / std::sqrt(pi) - t * std::erfc(t)) / (4.0 * t);
    return db_of_power((1.0 - std::exp(-2.0 * q)) / (2.0 * q));
}

/// Backscattering strength in dB by an independent program for the same report, without shadowing.
struct Curve {
    double phi;
    std::array<double, 9> strength_db;
};
constexpr std::array<Curve, 9> at_100_khz{
    {{-9.99, {-20.6, -19.1, -17.4, -16.4, -14.6, -13.4, -12.8, -13.0, -13.0}},
     {-7.0, {-22.4, -20.9, -19.2, -18.1, -16.1, -13.9, -13.1, -13.2, -13.2}},
     {-1.0, {-24.7, -23.3, -21.5, -20.3, -17.6, -15.0, -13.4, -13.3, -13.3}},
     {0.5, {-28.7, -26.9, -24.8, -23.7, -20.1, -16.7, -12.2, -10.4, -10.3}},
     {1.5, {-32.9, -29.5, -25.1, -22.8, -21.3, -19.2, -13.6, -9.7, -9.3}},
     {2.5, {-39.5, -34.6, -28.2, -24.5, -23.5, -22.1, -17.3, -11.0, -9.9}},
     {3.5, {-43.6, -34.9, -26.8, -25.6, -24.5, -23.4, -21.0, -12.9, -10.1}},
     {5.5, {-41.3, -35.6, -31.7, -29.9, -28.3, -27.3, -26.3, -20.4, -9.7}},
     {8.0, {-42.2, -36.1, -31.9, -30.0, -28.4, -27.4, -26.5, -20.9, -10.4}}}};
constexpr std::array<Curve, 9> at_400_khz{
    {{-9.99, {-16.1, -14.6, -13.2, -13.2, -15.2, -18.0, -18.2, -18.4, -18.4}},
     {-7.0, {-17.8, -16.4, -14.9, -14.6, -15.9, -17.5, -18.5, -18.8, -18.8}},
     {-1.0, {-20.2, -18.8, -17.1, -16.6, -16.5, -17.7, -18.8, -19.1, -19.2}},
     {0.5, {-24.1, -22.6, -20.8, -19.7, -17.5, -16.5, -16.5, -16.7, -16.8}},
     {1.5, {-28.1, -26.6, -24.5, -22.8, -19.8, -17.6, -16.1, -15.9, -15.9}},
     {2.5, {-34.2, -32.2, -28.0, -24.2, -22.6, -20.5, -17.6, -16.4, -16.3}},
     {3.5, {-39.1, -33.6, -26.5, -25.3, -24.1, -22.7, -19.7, -16.8, -16.5}},
     {5.5, {-41.2, -35.6, -31.7, -29.9, -28.2, -27.2, -25.8, -19.5, -16.6}},
     {8.0, {-42.2, -36.1, -31.9, -30.0, -28.3, -27.3, -26.0, -20.0, -17.2}}}};

void check_curves(const std::array<Curve, 9>& curves, double frequency_hz) {
    for (const Curve& curve : curves) {
        const Backscatter bed = scattering_at(grain_size_material(curve.phi), frequency_hz);
        for (std::size_t i = 0; i < grazing_deg.size(); ++i) {
            CAPTURE_ALL(curve.phi, grazing_deg[i]);
            const double expected =
                curve.strength_db[i] + shadowing_db(curve.phi, frequency_hz, grazing_deg[i]);
            CHECK(std::fabs(db_at(bed, grazing_deg[i]) - expected) < 0.1);
        }
    }
}

/// The structure function <(h(0) - h(1 m))^2> of a surface with the spectrum W = w K^-g, the
/// integral of 2 W (1 - cos(K u)) d^2K. At u it is u^(g - 2) times as large.
double structure_function_at_1_m(const SeaBed& bed) {
    const double g = bed.spectral_exponent;
    static constexpr double low = -9.0;  // both are logarithms of x
    static constexpr double high = 7.0;
    double sum = integral(low, high, 40000, [&](double log_x) {
        const double x = std::exp(log_x);
        return (1.0 - std::cyl_bessel_j(0.0, x)) * std::pow(x, 2.0 - g);
    });
    // Below the lowest x the integrand is x^(3 - g) / 4, above the highest its mean is x^(1 - g).
    sum += std::exp(low * (4.0 - g)) / (4.0 * (4.0 - g)) + std::exp(high * (2.0 - g)) / (g - 2.0);
    return 4.0 * pi * bed.spectral_strength * sum;
}

double reflection_of(const SeaBed& bed) {
    const double impedance = bed.density_ratio * bed.speed_ratio;
    return std::pow((impedance - 1.0) / (impedance + 1.0), 2.0);
}

/// The integral over all directions of a function of the sine and the grazing angle.
template <class Function>
double over_directions(const Function& specular) {
    return integral(0.0, 0.5 * pi, 15700, [&](double theta) {
        return specular(static_cast<float>(std::cos(theta)), 0.5 * pi - theta) * 2.0 * pi *
               std::sin(theta);
    });
}

/// A sea bed with numbers within the limits of the CSV.
Material random_bed(Uniform& random) {
    const auto by_decades = [&](double low, double high) {
        return std::pow(10.0, random.between(low, high));
    };
    Material material = grain_size_material(random.between(-10.0, 9.0));
    if (random.between(0.0, 1.0) < 0.3) return material;
    material.grain_phi.reset();
    material.density_kg_m3 = by_decades(-9.0, 9.0);
    material.sound_speed_m_s = by_decades(-9.0, 9.0);
    material.loss_parameter = by_decades(-6.0, 0.0);
    material.spectral_strength_cm4 = by_decades(-9.0, 1.0);
    material.spectral_exponent = random.between(2.4, 3.9);
    material.volume_parameter = random.between(0.0, 1.0);
    return material;
}

}  // namespace

TEST_CASE("sea bed: the strengths of nine sediments at 100 and 400 kHz") {
    check_curves(at_100_khz, 1e5);
    check_curves(at_400_khz, 4e5);
}

TEST_CASE("sea bed: sediments agree with the table of the report from 10 degrees on") {
    // APL-UW TR 9407, section IV, table 3, in water of 1,528 m/s; see docs/calibrated.md.
    struct Row {
        double phi, frequency_hz;
        std::array<double, 7> strength_db;
    };
    constexpr std::array<double, 7> angles_deg{10, 20, 40, 60, 70, 80, 90};
    for (const Row& row : {Row{6.0, 3e4, {-35.7, -31.8, -28.8, -27.4, -27.0, -26.3, -3.6}},
                           Row{3.5, 3e4, {-35.2, -27.1, -24.9, -23.7, -23.1, -20.2, -3.8}},
                           Row{1.5, 1e4, {-38.8, -30.9, -24.4, -22.6, -20.4, -13.2, 2.6}},
                           Row{-1.0, 3e4, {-28.1, -22.1, -18.9, -16.5, -13.7, -9.9, -7.8}}}) {
        const Backscatter bed =
            scattering_at(grain_size_material(row.phi), row.frequency_hz, {1000.0, 1528.0});
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            CAPTURE_ALL(row.phi, row.frequency_hz, angles_deg[i]);
            CHECK(std::fabs(db_at(bed, angles_deg[i]) - row.strength_db[i]) < 1.7);
        }
    }
}

TEST_CASE("sea bed: at normal incidence the Kirchhoff integral of the spectrum") {
    // sigma = R k^2 / (2 pi) integral of exp(-2 k^2 D(u)) u du, D the structure function. With
    // D = s^2 u^2, s the RMS slope, it is R / (8 pi s^2), that of facets.
    for (const double exponent : {2.8, 3.25, 3.7}) {
        SeaBed bed = sea_bed_of_grain_size(1.5);
        bed.spectral_strength *= std::pow(100.0, exponent - bed.spectral_exponent);
        bed.spectral_exponent = exponent;
        const double k = 2.0 * pi * 1e5 / 1500.0;
        const double at_1_m = structure_function_at_1_m(bed);
        const double sum = integral(-20.0, 0.0, 20000, [&](double log_u) {
            const double u = std::exp(log_u);
            return std::exp(-2.0 * k * k * at_1_m * std::pow(u, exponent - 2.0)) * u * u;
        });
        const double expected = reflection_of(bed) * k * k / (2.0 * pi) * sum;
        CAPTURE(exponent);
        const double found = SeafloorScattering(bed, k).specular(0.5 * pi);
        CHECK(std::fabs(db_of_power(found / expected)) < 0.1);
    }
}

TEST_CASE("sea bed: the Kirchhoff part sends back a quarter of what is reflected") {
    // Any small roughness does. The report's formula, which joins two limits, keeps it within
    // 1.5 dB, and the table keeps the formula.
    const auto by_table = [](const SeafloorScattering& formula) {
        const Backscatter bed = backscatter(formula);
        return over_directions(
            [&](float sine, double) { return AngularTable::value(bed.specular.data(), sine); });
    };
    for (const double phi : {2.5, 5.5, 8.0}) {
        for (const double frequency_hz : {1e4, 1e5, 4e5}) {
            const SeaBed bed = sea_bed_of_grain_size(phi);
            const SeafloorScattering formula(bed, 2.0 * pi * frequency_hz / 1500.0);
            const double by_formula =
                over_directions([&](float, double grazing) { return formula.specular(grazing); });
            CAPTURE_ALL(phi, frequency_hz);
            CHECK(std::fabs(by_table(formula) / by_formula - 1.0) < 0.01);
            if (frequency_hz > 2e4)
                CHECK(std::fabs(db_of_power(by_formula / (0.25 * reflection_of(bed)))) < 1.5);
        }
    }
    // The peak of the smoothest is far narrower than an entry of the table.
    Material smooth = grain_size_material(5.5);
    for (const double w2_cm4 : {1e-3, 1e-5, 1e-7, 1e-9}) {
        for (const double exponent : {2.5, 3.25, 3.8}) {
            for (const double frequency_hz : {1e3, 1e4, 1e5, 1e6}) {
                smooth.spectral_strength_cm4 = w2_cm4;
                smooth.spectral_exponent = exponent;
                const SeafloorScattering formula(sea_bed_of(smooth, {1000.0, 1500.0}),
                                                 2.0 * pi * frequency_hz / 1500.0);
                CAPTURE_ALL(w2_cm4, exponent, frequency_hz);
                CHECK(by_table(formula) < 1.15 * 0.25 * formula.reflection());
                CHECK(by_table(formula) > 0.25 * 0.25 * formula.reflection());
            }
        }
    }
}

TEST_CASE("sea bed: without roughness only the volume scatters") {
    // At normal incidence 5 sigma2 ratio^2 (1 - R)^2 / ln 10, whatever the small loss is.
    SeaBed bed = sea_bed_of_grain_size(5.5);
    bed.spectral_strength *= 1e-16;
    const double k = 2.0 * pi * 2e5 / 1500.0;
    const double expected = 5.0 * bed.volume_parameter * std::pow(bed.speed_ratio, 2.0) *
                            std::pow(1.0 - reflection_of(bed), 2.0) / std::log(10.0);
    for (const double loss : {1e-3, 1e-2}) {
        bed.loss = loss;
        CHECK(std::fabs(SeafloorScattering(bed, k).diffuse(0.5 * pi) / expected - 1.0) < 1e-3);
    }
    bed.volume_parameter = 0.0;
    CHECK(SeafloorScattering(bed, k).diffuse(0.5) < 1e-12);
}

TEST_CASE("sea bed: both ways along one direction are one, and sender and receiver change") {
    Uniform random(3);
    const auto sine = [&] { return random.single(0.0, 1.0); };
    for (int k = 0; k < 30; ++k) {
        const Backscatter bed = scattering_at(random_bed(random), 3e5);
        for (int i = 0; i < 30; ++i) {
            const float in = sine();
            const float out = sine();
            const float half = sine();
            CHECK(bed.between(in, out, half) == bed.between(out, in, half));
            CHECK(std::fabs(bed.between(in, in, in) - bed.at(in)) <= 1e-5F * bed.at(in));
        }
    }
}

TEST_CASE("sea bed: no legal numbers give a strength that is not finite") {
    Uniform random(5);
    for (int k = 0; k < 300; ++k) {
        const Material material = random_bed(random);
        const Backscatter bed = scattering_at(material, std::pow(10.0, random.between(3.0, 7.5)));
        CAPTURE(k);
        for (int i = 0; i <= 90; i += 3) {
            const float sigma = bed.at(static_cast<float>(std::sin(radians(i))));
            CHECK(std::isfinite(sigma));
            CHECK(sigma >= 0.0F);
        }
    }
}
