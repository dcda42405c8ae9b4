#include "core/elementary.h"
#include "simulate/calibrated/speckle/speckle.h"
#include "support/draws.h"
#include "support/statistics.h"

namespace {

constexpr PhiloxKey key{11, 22};
constexpr double sand_db = 1.2;  // an octave's deviation, as the header has it
constexpr double rest_db = 0.6;

/// The factors in dB on a level bed of sand (first) and of another material (second) at places, m.
Eigen::ArrayX2d decibels(const std::vector<Eigen::Vector2d>& places) {
    std::vector<Material> materials(2);
    materials[0].grain_phi = 1.5;
    const Texture texture(materials, 1.0);
    Uniform draws(3);
    Eigen::ArrayX2d out(std::ssize(places), 2);
    PatchBlock pieces;
    for (Eigen::Index n = 0; n < out.rows(); ++n) {
        SonarInScene sonar;
        sonar.sensor = {draws.between(-20.0, 20.0), draws.between(-20.0, 20.0), 5.0};
        PatchBlock::Array<float> power{};
        pieces.count = 2;
        for (std::uint32_t k = 0; k < 2; ++k) {
            pieces.x[k] = static_cast<float>(places[n].x() - sonar.sensor.x());
            pieces.y[k] = static_cast<float>(places[n].y() - sonar.sensor.y());
            pieces.z[k] = -5.0F;
            pieces.material[k] = k;
            power[k] = 1.0F;
        }
        texture.apply({}, pieces, sonar, {}, key, power);
        for (const int k : {0, 1})
            out(n, k) = 10.0 * std::log10(static_cast<double>(power[k]));
    }
    return out;
}

std::vector<Eigen::Vector2d> drawn_places(std::size_t count) {
    Uniform draws(7);
    std::vector<Eigen::Vector2d> out(count);
    for (Eigen::Vector2d& place : out)
        place = {draws.between(-500.0, 500.0), draws.between(-500.0, 500.0)};
    return out;
}

/// The variance of the difference of two places d metres apart over that of an octave: an octave
/// of waves in all directions has 2 (1 - J0(2 pi d / wavelength)) of its variance.
double structure(double d) {
    return integral(0.0, Texture::octaves, 4000, [&](double octave) {
        const double wavelength = 1.6 * std::exp2(octave);
        return 2.0 * (1.0 - std::cyl_bessel_j(0.0, 2.0 * pi * d / wavelength));
    });
}

}  // namespace

TEST_CASE("texture: factors have the mean 1 and the deviation of its octaves") {
    const Eigen::ArrayX2d found = decibels(drawn_places(60000));
    for (const int of : {0, 1}) {
        const double octave_db = of == 0 ? sand_db : rest_db;
        const std::vector<double> values(found.col(of).begin(), found.col(of).end());
        const Eigen::ArrayXd factors = (0.1 * std::log(10.0) * found.col(of)).exp();
        CAPTURE(of);
        // 60,000 places: standard errors are 0.2 % and 0.3 %. The longest waves are few.
        CHECK(std::fabs(factors.mean() - 1.0) < 0.02);
        CHECK(deviation(values) ==
              approx(octave_db * std::sqrt(1.0 * Texture::octaves)).epsilon(0.03));
    }
}

TEST_CASE("texture: each octave of wavelength from 1.6 m up has the same variance") {
    const std::vector<Eigen::Vector2d> places = drawn_places(20000);
    Uniform draws(5);
    const Eigen::ArrayX2d here = decibels(places);
    for (const double d : {0.4, 1.6, 3.2, 12.0, 40.0}) {
        std::vector<Eigen::Vector2d> moved = places;
        for (Eigen::Vector2d& place : moved) {
            const SinCos angle = sincos(draws.between(0.0, 2.0 * pi));
            place += d * Eigen::Vector2d(angle.cos, angle.sin);
        }
        const double variance = (decibels(moved) - here).col(0).square().mean();
        CAPTURE(d);
        // Lines between texels take a little of the shortest waves.
        CHECK(std::fabs(std::sqrt(variance / structure(d)) / sand_db - 1.0) < 0.1);
    }
}

TEST_CASE("texture: nobody sees the square of the short waves repeat") {
    const std::vector<Eigen::Vector2d> places = drawn_places(20000);
    std::vector<Eigen::Vector2d> moved = places;
    for (Eigen::Vector2d& place : moved)
        place.x() += Texture::fine.edge_m();
    const Eigen::ArrayXd here = decibels(places).col(0);
    const Eigen::ArrayXd there = decibels(moved).col(0);
    // Squares side by side have 0.7.
    CHECK((here * there).sum() / here.square().sum() < 0.5);
}

TEST_CASE("texture: a place has the same factor from everywhere") {
    std::vector<Eigen::Vector2d> twice;
    for (const Eigen::Vector2d& place : drawn_places(4000))
        twice.insert(twice.end(), {place, place});
    const Eigen::ArrayX2d found = decibels(twice);
    for (Eigen::Index k = 0; k < found.rows(); k += 2)
        CHECK(std::fabs(found(k, 0) - found(k + 1, 0)) <= 0.02);
}
