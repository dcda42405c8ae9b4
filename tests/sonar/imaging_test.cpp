#include "simulate/reference/reference.h"
#include "support/sonars.h"

namespace {

/// sum |image - expected| / sum expected over the bins where expected(i, j) >= 0.
template <class Expected>
double relative_l1(const Ping& ping, Expected expected) {
    double difference = 0.0;
    double total = 0.0;
    for (int i = 0; i < ping.range_bins; ++i) {
        for (int j = 0; j < ping.beams; ++j) {
            const double truth = expected(i, j);
            if (truth < 0.0) continue;
            difference += std::fabs(ping.at(i, j) - truth);
            total += truth;
        }
    }
    REQUIRE(total > 0.0);
    return difference / total;
}

/// The lobe of the noise over the beams of a sonar.
std::vector<float> lobe_of(const SonarConfig& config) {
    const Sonar sonar = make_sonar(config, {});
    return dynamic_cast<const PaperModel&>(*sonar.settings.model).pixel_noise.lobe_scale;
}

}  // namespace

TEST_CASE("a floor below the sonar: I = R H / r in every bin, from the right bin on") {
    // Height H over a plane, pitched down by p. On the plane v . n = H / r, and the area of a
    // beam's strip is rho drho dphi = r dr dphi, so that the mean over a bin is
    // R int (H / r) r dr / int r dr = R H / r_mid exactly.
    constexpr float R = 0.6F;
    constexpr double H = 2.0;
    constexpr double pitch_deg = 25.0;
    const Sonar sonar = noise_free(small_imaging());
    const Ping ping = look(sonar, floor_scene(100.0F, 0.0F, R), pitched(pitch_deg, {0.0, 0.0, H}));

    // Straight ahead the field of view reaches the floor from H / sin(p + 6) to H / sin(p - 6).
    const int middle = ping.beams / 2;
    const int first_bin = bin_at(sonar, H / std::sin(radians(pitch_deg + 6.0)));
    const int last_bin = bin_at(sonar, H / std::sin(radians(pitch_deg - 6.0)));
    // Half a beam off straight ahead moves the start by less than 0.03 %, 1 mm of a 37 mm bin.
    CHECK(ping.at(first_bin - 1, middle) == 0.0F);
    CHECK(ping.at(first_bin, middle) > 0.0F);
    CHECK(ping.at(last_bin, middle) > 0.0F);
    CHECK(ping.at(last_bin + 1, middle) == 0.0F);

    CHECK(relative_l1(ping, [&](int i, int j) {
              const bool inside = i > first_bin && i < last_bin && j > 24 && j < 40;
              return inside ? R * H / bin_centre(sonar, i) : -1.0;
          }) < 3e-3);
    // Wherever the whole image is occupied, whichever beam.
    CHECK(relative_l1(ping, [&](int i, int j) {
              return ping.at(i, j) > 0.0F ? R * H / bin_centre(sonar, i) : -1.0;
          }) < 0.01);
}

TEST_CASE("a sphere agrees with its closed form") {
    // Centre on the boresight at distance D, radius a. At slant range r the incidence is the same
    // all round the ring: with cos alpha = (D^2 + a^2 - r^2) / (2 D a),
    // v . n = (D cos alpha - a) / r. It falls to 0 at the horizon, r = sqrt(D^2 - a^2).
    constexpr float R = 0.9F;
    constexpr double D = 4.0;
    constexpr double a = 0.403;
    SonarConfig config = small_imaging();
    config.azimuth_deg = 20.0;
    config.elevation_deg = 20.0;
    set_range(config, 3.5, 4.1, 60);
    const Sonar sonar = noise_free(config, 0.01);
    const Ping ping = look(sonar, sphere_scene({D, 0, 0}, a, R, 512));
    const int first_bin = bin_at(sonar, D - a);
    const int last_bin = bin_at(sonar, std::sqrt(D * D - a * a));
    CHECK(relative_l1(ping, [&](int i, int j) {
              const bool inside = i >= first_bin && i < last_bin - 1 && ping.at(i, j) > 0.0F;
              if (!inside) return -1.0;
              const double r = bin_centre(sonar, i);
              return R * ((D * D + a * a - r * r) / (2.0 * a) - a) / r;
          }) < 0.01);
    for (int j = 0; j < ping.beams; ++j) {
        CHECK(ping.at(first_bin - 1, j) == 0.0F);
        // At the horizon the surface runs along the ray; a bin more or less is the sampling's.
        CHECK(ping.at(last_bin + 2, j) == 0.0F);
    }
}

TEST_CASE("noise is a function of seed, sensor and ping; without it the seed does not matter") {
    const Scene scene = tank();
    const Pose pose = pitched(12.0, {-3.0, 0.0, 1.5});
    const auto engine = make_rays_engine(scene);
    const auto image = [&](const Sonar& sonar, const PingKey& key) {
        return render_ping(sonar, scene, *engine, pose, key).intensity;
    };
    const Sonar clean = noise_free(small_imaging());
    CHECK(image(clean, {1, 5}) == image(clean, {2, 6}));

    SonarConfig config = small_imaging();
    config.noise = {0.05, 0.02, 0.1, 0.2, true};
    const Sonar noisy = make_sonar(config, {});
    const std::vector<float> first = image(noisy, {0, 5});
    CHECK(first == image(noisy, {0, 5}));
    CHECK(first != image(noisy, {1, 5}));
    CHECK(first != image(noisy, {0, 6}));
    config.name = "another";
    CHECK(first != image(make_sonar(config, {}), {0, 5}));
}

TEST_CASE("the lobe of the noise is 1.5 along the boresight, an eighth of the view wide (Eq. 10)") {
    SonarConfig config;
    config.azimuth_bins = 9;
    CHECK(lobe_of(config)[4] == 1.5F);
    CHECK(std::fabs(lobe_of(config)[5] - 1.0 - 0.5 * std::exp(-0.5 * 64.0 / 81.0)) < 1e-6);
}
