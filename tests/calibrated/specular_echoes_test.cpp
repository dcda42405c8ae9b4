#include "simulate/calibrated/equation/specular_echoes.h"

#include "core/decibel.h"
#include "simulate/calibrated/signal/directivity.h"
#include "support/bounces.h"
#include "support/calibrated.h"
#include "support/patches.h"

namespace {

/// A bare sonar that hears all multipath.
SonarConfig with_mirrors(const SonarConfig& kept, double frequency_hz = 3e5) {
    SonarConfig config = bare_sonar(kept, frequency_hz);
    config.multipath.method = MultipathMethod::exact;
    return config;
}

double loss_per_m(const Sonar& sonar) {
    return 0.2 * std::log(10.0) * calibrated_model_of(sonar).absorption_db_per_m;
}

}  // namespace

TEST_CASE("specular echoes: a mirror that shows a piece where it is doubles its echo") {
    // Once out by the mirror and back without, once the other way round. The mirror meets the
    // second surface in the piece itself and takes its reflection, 0.4 of rock.
    SonarConfig imaging = with_mirrors(small_imaging());
    imaging.instrument.beam.elevation_width_deg = 8.0;
    SonarConfig sidescan = with_mirrors(default_sonar(SonarKind::sidescan));
    sidescan.elevation_deg = 4.0;
    set_range(sidescan, sidescan.range_min_m, 10.0, 200);
    SonarConfig echosounder = with_mirrors(default_sonar(SonarKind::echosounder));
    echosounder.opening_deg = 50.0;
    set_range(echosounder, echosounder.range_min_m, 20.0, 400);
    const Eigen::Vector3f ahead(3.0F, 0.3F, 0.2F);
    const Eigen::Vector3f beside(2.0F, 2.5F, 0.01F);
    const Eigen::Vector3f below(8.0F, 0.3F, -0.2F);
    for (const auto& [config, place] :
         {std::pair{imaging, ahead}, {sidescan, beside}, {echosounder, below}}) {
        const Sonar sonar = make_sonar(config, {0.03});
        const Eigen::Vector3f direction = place.normalized();
        const Eigen::Vector3f across = direction.unitOrthogonal();
        TracedPing traced;
        Sample piece = patch_of(place, across, {0.0F, 1e-4F, 0.0F}, {0.0F, 0.0F, 1e-4F});
        piece.height_m = 0.8F * place.norm();
        piece.area_m2 = 1e-4F;
        traced.samples.items = {piece};
        BouncePath& bounce = traced.bounces.emplace_back();
        bounce.sample = 0;
        bounce.point = place;
        bounce.normal = -0.8F * direction + 0.6F * across;
        bounce.material = 0;
        const auto image_of = [&](const Terms& terms) {
            return image_of_traced(calibrated_model_of(sonar), sonar.settings.view, traced, terms);
        };
        const auto one = image_of(direct_echoes_alone);
        const auto two = image_of(multipath_alone);
        REQUIRE(total(one) > 0.0);
        float worst = 0.0F;
        for (std::size_t i = 0; i < one.size(); ++i)
            worst = std::max(worst, std::fabs(two[i] - 2.0F * 0.4F * one[i]));
        CHECK(worst <= 1e-4F * std::ranges::max(one));
    }
}

TEST_CASE("specular echoes: a plate over a floor that is a mirror has the level of its image") {
    // The sonar is 1 m above a smooth floor that sends back nothing: a plate's image is at -2 -
    // z. With the plate at r and its image at s, sound comes back by either way round with R mu
    // (v_r . n) (v_s . n) dA / (r^2 s^2) e^(-loss (r + s) / 2), direct sound with
    // mu (v_r . n)^2 dA / r^4 e^(-loss r). A ceiling scatters the mirrored sound back as well.
    // A disc has its pattern at r times that at s, or twice that at r.
    constexpr double reflection = 0.36;
    SonarConfig fan = with_mirrors(small_imaging());
    fan.elevation_deg = 110.0;
    SonarConfig disc = with_mirrors(default_sonar(SonarKind::echosounder));
    disc.opening_deg = 110.0;
    disc.instrument.beam.width_deg = 60.0;
    for (const auto& [config, ceiling] : {std::pair{fan, false}, {fan, true}, {disc, false}}) {
        Sonar sonar = make_sonar(config, {0.005});
        sonar.T_vehicle_sensor = Pose{};
        const double loss = loss_per_m(sonar);
        const double scale = config.kind == SonarKind::imaging ? 0.0 : piston_scale(radians(60.0));
        const auto pattern = [&](double y, double z, double range) {
            return std::pow(piston_pattern(scale * std::hypot(y, z) / range), 2.0);
        };
        Scene scene = empty_scene();
        const std::uint32_t smooth = add_material(scene, static_cast<float>(reflection));
        const std::uint32_t rough = add_material(scene, 0.0F);
        scene.materials[smooth].lambert_db = -300.0;
        for (Material& material : scene.materials)
            material.slope_rms_deg = 0.0;
        add_floor(scene, 8.0F, -1.0F, smooth);
        if (ceiling)
            add_rectangle(scene, {3, -0.5, 1}, {4, 0.5, 1}, rough);
        else
            add_rectangle(scene, {4, -0.5, -0.5}, {4, 0.5, 0.5}, rough);
        double direct = 0.0;
        double specular = 0.0;
        constexpr int steps = 100;
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; j < steps; ++j) {
                const double y = (i + 0.5) / steps - 0.5;
                const double t = (j + 0.5) / steps - 0.5;
                const double x = ceiling ? 3.5 + t : 4.0;
                const double z = ceiling ? 1.0 : t;
                const double below = -2.0 - z;
                const double r = std::sqrt(x * x + y * y + z * z);
                const double s = std::sqrt(x * x + y * y + below * below);
                const double sine_r = (ceiling ? z : x) / r;
                const double sine_s = (ceiling ? -below : x) / s;
                const double echo_r = sine_r * pattern(y, z, r) / (r * r);
                const double echo_s = sine_s * pattern(y, below, s) / (s * s);
                direct += echo_r * echo_r * std::exp(-loss * r);
                specular += 2.0 * reflection * echo_r * echo_s * std::exp(-0.5 * loss * (r + s));
            }
        }
        const auto energy = [&](const Terms& terms) {
            return total(expected_image(sonar, scene, EngineKind::rays, {}, terms));
        };
        const double level = db_of_power(energy(multipath_alone) / energy(direct_echoes_alone));
        CHECK(std::fabs(level - db_of_power(specular / direct)) < 0.1);
    }
}

TEST_CASE("specular echoes: multipath darkens no bin, and has its mean whatever the speckle") {
    const Scene scene = tank();
    const auto engine = make_rays_engine(scene);
    SonarConfig config = with_mirrors(small_imaging());
    config.elevation_deg = 40.0;
    config.multipath.method = MultipathMethod::cluster;
    // Four bins: the spline that stands for a pulse of one swings below 0.
    config.instrument.pulse.resolution_m = 0.15;
    for (const Pose& pose : tank_poses()) {
        config.instrument.speckle.mode = SpeckleMode::none;
        const Sonar sonar = make_sonar(config, {0.03});
        const TracedPing traced = trace(sonar, scene, *engine, pose, 0);
        REQUIRE(std::ranges::count(traced.bounces, true, &BouncePath::scattered) > 0);
        const auto image_of = [&](const Sonar& of, const Terms& terms, std::uint32_t ping) {
            return form_image(traced, of.settings, scene, {1, ping}, terms).intensity;
        };
        const auto without = image_of(sonar, direct_echoes_alone, 0);
        const auto alone = image_of(sonar, multipath_alone, 0);
        const auto with = image_of(sonar, without_random_terms, 0);
        // The filter of powers swings below 0 next to a glint, by some thousandths of it.
        float max_lost = 0.0F;
        for (std::size_t k = 0; k < with.size(); ++k)
            max_lost = std::max(max_lost, without[k] - with[k]);
        CHECK(max_lost < 1e-2F * *std::ranges::max_element(alone));
        CHECK(std::fabs(total(with) / (total(without) + total(alone)) - 1.0) < 1e-3);
        CHECK(total(alone) > 0.02 * total(without));

        for (const SpeckleMode mode : {SpeckleMode::scene, SpeckleMode::ping}) {
            config.instrument.speckle.mode = mode;
            const Sonar speckled = make_sonar(config, {0.03});
            Terms terms = multipath_alone;
            terms.random = 1;  // speckle
            double mean = 0.0;
            constexpr int pings = 12;
            for (std::uint32_t ping = 0; ping < pings; ++ping)
                mean += total(image_of(speckled, terms, ping)) / pings;
            CHECK(std::fabs(mean / total(alone) - 1.0) < 0.1);
            CHECK(image_of(speckled, terms, 3) == image_of(speckled, terms, 3));
        }
    }
}

// A sonar h over the bottom and d below the surface sees the bottom at s_i = h + 2 i (h + d),
// with the share q^i of the power left, q = 0.25 * 0.9. Echo k is out over way i and back over
// way k - i, for all i. A narrow view sees the area s^2 w of the longer way s, so that the
// energy of echo k by that of the first is
//
//     h^2 q^k e^-(loss (s_k - h)) sum over i + j = k of min(s_i, s_j)^2 / (s_i^2 s_j^2)
//
// Paths end at the second surface: there is no third echo.
TEST_CASE("second bottom echo: range and level of an echosounder's") {
    constexpr double over_bottom_m = 8.0;
    constexpr double below_surface_m = 2.0;
    // A rough flat bottom that reflects 0.25 of the power, below water whose surface reflects 0.9.
    Scene scene = floor_scene(100.0F, 0.0F, 0.25F, 4);
    scene.materials[0].slope_rms_deg = 0.0;
    scene.water_surface = {over_bottom_m + below_surface_m, 0.9F};
    SonarConfig config = with_mirrors(default_sonar(SonarKind::echosounder), 3.8e4);
    config.opening_deg = 4.0;
    set_range(config, 1.0, 36.0, 700);
    config.instrument.beam.width_deg = 100.0;  // far wider than the view
    config.instrument.pulse.resolution_m = 0.1;
    const Sonar sonar = make_sonar(config, {0.002});
    const Ping ping = look(sonar, scene, {.translation = {0.0, 0.0, over_bottom_m}}, {.seed = 1},
                           without_random_terms);
    const double loss = loss_per_m(sonar);
    const double bin_m = sonar.settings.view.bin_m();
    const auto s = [](int i) {
        return over_bottom_m + 2.0 * i * (over_bottom_m + below_surface_m);
    };
    const auto predicted = [&](int k) {
        double sum = 0.0;
        for (int i = 0; i <= k; ++i) {
            const double longer = std::max(s(i), s(k - i));
            sum += 1.0 / (longer * longer);
        }
        const double range_m = 0.5 * (s(0) + s(k));
        return sum * over_bottom_m * over_bottom_m * std::pow(0.25 * 0.9, k) *
               std::exp(-loss * (range_m - over_bottom_m));
    };
    const auto energy = [&](int k) {
        const double range_m = 0.5 * (s(0) + s(k));
        double sum = 0.0;
        for (int i = 0; i < ping.range_bins; ++i)
            if (std::fabs(1.0 + bin_m * (i + 0.5) - range_m) < 1.0) sum += ping.at(i, 0);
        return sum;
    };
    CHECK(std::fabs(db_of_power(energy(1) / energy(0) / predicted(1))) < 0.15);
    CHECK(energy(2) < 1e-3 * predicted(2) * energy(0));
}
