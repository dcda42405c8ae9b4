#include "simulate/calibrated/equation/sediment.h"

#include "core/decibel.h"
#include "support/calibrated.h"

namespace {

constexpr double sounder_hz = 38e3;
constexpr double bed_phi = 6.0;

/// Looks down from the origin, with bins of 2 cm and a pulse of one.
Sonar bed_sounder(bool below_bottom, double frequency_hz = sounder_hz) {
    SonarConfig config = bare_sonar(default_sonar(SonarKind::echosounder), frequency_hz);
    config.opening_deg = 14.0;
    set_range(config, 8.0, 14.0, 300);
    config.instrument.beam.width_deg = 7.0;
    config.instrument.below_bottom = below_bottom;
    return make_sonar(config, {0.005});
}

double bed_wavenumber() {
    return 2.0 * pi * sounder_hz / WaterConfig{}.sound_speed_m_s;
}

}  // namespace

TEST_CASE("sea bed: own numbers replace those of the grain size") {
    const SeaBed sand = sea_bed_of_grain_size(1.5);
    Material material{.name = "bed", .density_kg_m3 = 1845.0, .sound_speed_m_s = 1767.0};
    material.loss_parameter = sand.loss;
    material.spectral_strength_cm4 = sand.spectral_strength * 1e8 / std::pow(100.0, 3.25);
    material.volume_parameter = sand.volume_parameter;
    const Water water{1000.0, 1500.0};
    SeaBed own = sea_bed_of(material, water);
    CHECK(own.density_ratio == approx(1.845));
    CHECK(own.speed_ratio == approx(1.178));
    CHECK(own.spectral_strength == approx(sand.spectral_strength));
    CHECK(own.spectral_exponent == 3.25);

    material.grain_phi = 1.5;
    material.volume_parameter = 0.01;
    own = sea_bed_of(material, water);
    CHECK(own.density_ratio == sand.density_ratio);
    CHECK(own.volume_parameter == 0.01);
    // Another exponent turns the spectrum about 1 / cm.
    material.spectral_exponent = 3.0;
    own = sea_bed_of(material, water);
    CHECK(own.spectral_strength * std::pow(100.0, -3.0) ==
          approx(sand.spectral_strength * std::pow(100.0, -3.25)));
}

// Sound is attenuated by 8.686 k loss dB per m on its way down and up.
TEST_CASE("sediment: at normal incidence the tail decays by the attenuation of the sediment") {
    for (const double phi : {1.5, 4.0, 6.0, 8.0}) {
        CAPTURE(phi);
        const SeaBed bed = sea_bed_of_grain_size(phi);
        const SeafloorScattering scattering(bed, bed_wavenumber());
        const double attenuation_db = 20.0 / ln_10 * bed_wavenumber() * bed.loss;
        const double decay_db = 10.0 / ln_10 / scattering.lag_m(0.5 * pi);
        CHECK(decay_db == approx(2.0 * attenuation_db).epsilon(1e-4));
    }
}

TEST_CASE("sediment: surface and volume add up to the bed, as surface and as a target") {
    const Scene scene = bed_scene({.name = "bed", .grain_phi = bed_phi}, 20.0F, -10.0);
    const auto model = calibrated_model_of(bed_sounder(true)).prepared_for(scene);
    const std::vector<float>& whole = model->scattering.materials[0].diffuse;
    const std::vector<float>& target = model->sediment->surface.materials[0].diffuse;
    CHECK(target != whole);
    for (std::size_t k = 0; k < whole.size(); ++k)
        CHECK(target[k] + model->sediment->volume.sea_beds[k] == approx(whole[k]).epsilon(1e-6));
}

// The whole beam of 7 degrees sees the bottom within 10 m and 10 / cos(7 degrees) = 10.08 m;
// the tail behind it is exponential. The pulse's own side lobes end two bins behind.
TEST_CASE("sediment: an echosounder has the same echo, with a tail of that slope") {
    const Scene scene = bed_scene({.name = "bed", .grain_phi = bed_phi}, 20.0F, -10.0);
    const std::vector<float> whole = expected_image(bed_sounder(false), scene, EngineKind::rays);
    const std::vector<float> divided = expected_image(bed_sounder(true), scene, EngineKind::rays);
    const SeafloorScattering bed(sea_bed_of_grain_size(bed_phi), bed_wavenumber());
    CHECK(total(divided) == approx(total(whole)).epsilon(0.01));
    const auto row_at = [&](double range_m) { return static_cast<int>((range_m - 8.0) / 0.02); };
    CHECK(whole[row_at(10.4)] < 1e-3F * divided[row_at(10.4)]);
    const double fall_db = db_of_power(divided[row_at(10.4)] / divided[row_at(11.4)]);
    CHECK(fall_db == approx(10.0 / ln_10 / bed.lag_m(0.5 * pi)).epsilon(0.02));
}

// At 1.2 MHz sand swallows all sound within a millimetre.
TEST_CASE("sediment: what lies within a part of a bin changes no bit") {
    const Scene scene = bed_scene({.name = "bed", .grain_phi = 1.5}, 20.0F, -10.0);
    CHECK(expected_image(bed_sounder(true, 1.2e6), scene, EngineKind::rays) ==
          expected_image(bed_sounder(false, 1.2e6), scene, EngineKind::rays));
}

TEST_CASE("bottom: Lambert's rule away from normal incidence, facets near it") {
    const Backscatter sand = backscatter(-27.0, 0.1, std::tan(radians(10.0)));
    // At 30 degrees of grazing the facets are gone.
    CHECK(std::fabs(sand.at(0.5F) / (std::pow(10.0, -2.7) * 0.25) - 1.0) < 1e-4);
    // Facets reflect what Lambert's rule leaves.
    const double s2 = std::tan(radians(10.0)) * std::tan(radians(10.0));
    const double mu = std::pow(10.0, -2.7);
    CHECK(std::fabs(sand.at(1.0F) / (mu + 0.1 * (1.0 - pi * mu) / (8.0 * pi * s2)) - 1.0) < 1e-5);
    CHECK(backscatter(-4.0, 0.9, 0.1).facet == 0.0F);
    // Roughness moves reflected sound from facets to Lambert's rule, pi mu of it, and loses none.
    Material steel{.name = "steel", .reflection = 0.88F, .lambert_db = -300, .slope_rms_deg = 4.0};
    steel.roughness_mm = 0.3;
    const Backscatter rough = scattering_of({&steel, 1}, 1.2e6, Water()).materials[0];
    const double facets = rough.facet * 8.0 * pi * std::pow(std::tan(radians(4.0)), 2.0);
    CHECK(facets + pi * rough.lambert == approx(0.88).epsilon(1e-4));
    CHECK(rough.mirrored * 0.88 == approx(facets).epsilon(1e-4));
}

TEST_CASE("bottom: exp_neg is e^-x") {
    for (float x = 0.0F; x < 40.0F; x += 0.037F)
        CHECK(std::fabs(exp_neg(x) / std::exp(-static_cast<double>(x)) - 1.0) < 1e-5);
}

TEST_CASE("bottom: both ways along one direction are one, and facets send on what they meet") {
    const double slope = std::tan(radians(4.0));
    const Backscatter rock = backscatter(-27.0, 0.4, slope);
    for (const float sine : {0.1F, 0.6F, 0.99F})
        CHECK(std::fabs(rock.between(sine, sine, sine) / rock.at(sine) - 1.0F) < 1e-5F);

    // Facets meet the part v . n of the sound and send on R of it, over all directions.
    const Backscatter facets = backscatter(-300.0, 0.4, slope);
    const double in = radians(60.0);  // grazing angle
    constexpr int steps = 400;
    const double sent = integral(0.0, 0.5 * pi, steps, [&](double elevation) {
        return std::cos(elevation) * integral(0.0, 2.0 * pi, 4 * steps, [&](double azimuth) {
                   const Eigen::Vector3d sum =
                       direction_of(0.0, in) + direction_of(azimuth, elevation);
                   const float half = static_cast<float>(sum.z() / sum.norm());
                   return static_cast<double>(
                       facets.between(static_cast<float>(std::sin(in)),
                                      static_cast<float>(std::sin(elevation)), half));
               });
    });
    CHECK(std::fabs(sent / (0.4 * std::sin(in)) - 1.0) < 0.01);
}
