#include <set>

#include "calibrated/preset_fixtures.h"
#include "simulate/calibrated/speckle/scatterers.h"
#include "support/draws.h"
#include "support/statistics.h"

namespace {

/// The correlation of the powers of an aperture in uniform incoherent sound with those of the same
/// aperture, moved by the share `moved` of its length and looking aside by `turned`, sine L /
/// lambda: the square (Siegert's relation) of the ambiguity function of its weight,
///
///     integral of w(x + s/2) w*(x - s/2) exp(2 pi i x t) dx / integral of |w|^2 dx
double power_correlation(const LineArray& array, double moved, double turned) {
    const auto overlap = [&](double moved_by, double turned_by) {
        return integral(-1.0, 1.0, 300, [&](double x) {
            return array.weight(x + 0.5 * moved_by) * std::conj(array.weight(x - 0.5 * moved_by)) *
                   std::polar(1.0, 2.0 * pi * x * turned_by);
        });
    };
    return std::norm(overlap(moved, turned) / overlap(0.0, 0.0));
}

/// The same of two ranges: a pulse's band has the taper of an array.
double power_correlation_of_pulse(const PulseConfig& pulse, double apart_m) {
    constexpr double unit = 1e-3;
    const LineArray band = line_array(unit, pulse.side_lobe_db);
    return power_correlation(band, 0.0, apart_m / pulse.resolution_m * unit * band.wavelengths);
}

/// 20 degrees of a preset's fan with its beams, and bins of half its resolution at `range_m`.
struct Patch {
    Sonar sonar;
    Samples surface;
    std::vector<float> expected;
    double range_m, half_m;

    static constexpr int bins = 240;
    static constexpr double fan_deg = 20.0;

    Patch(const std::string& preset, double range, double resolution_m, int beams,
          const std::string& keys = "")
        : sonar(preset_sonar(
              preset, "    azimuth_deg: 20\n    azimuth_bins: " + std::to_string(beams) +
                          "\n    range_bins: 240\n    range_min_m: " +
                          std::to_string(range - 60.0 * resolution_m) + "\n    range_max_m: " +
                          std::to_string(range + 60.0 * resolution_m) + "\n" + keys)),
          range_m(range),
          half_m(66.0 * resolution_m) {
        surface = visible_from({});
        expected = quiet_image(sonar, surface, false);
    }

    /// A plane of rock that sound meets at 30 degrees, straight ahead and all over the patch.
    Samples visible_from(const Pose& pose) const {
        const double c = std::cos(radians(30.0));
        return patches({range_m, 0.0, 0.0}, {c, 0.0, std::sin(radians(30.0))}, {0.0, 1.0, 0.0},
                       1.1 * half_m / c, 0.2 * range_m, 0.004 * range_m, pose);
    }

    double wavelength_m() const { return calibrated_model_of(sonar).wavelength_m; }
    int beams() const { return sonar.settings.view.beams; }
    double beam_sine(int j) const {
        const double share = (2.0 * j + 1.0) / beams() - 1.0;
        const double half = radians(0.5 * fan_deg);
        return sonar.config.instrument.beam.spread == BeamSpacing::equal_sine
                   ? share * std::sin(half)
                   : std::sin(share * half);
    }

    /// Powers by their expectation of the inner part: beams from `first` on, `count` of them.
    std::vector<double> normalised(const std::vector<float>& image, int first, int count,
                                   int beam_step = 1, int bin_step = 1, int row = 20) const {
        std::vector<double> out;
        for (int i = row; i < row + bins - 44; i += bin_step) {
            for (int j = first; j < first + count; j += beam_step) {
                const std::size_t at = static_cast<std::size_t>(i) * beams() + j;
                out.push_back(image[at] / expected[at]);
            }
        }
        return out;
    }
};

/// Bins of the DIDSON hold the larger of two samples, which are not Rayleigh distributed.
constexpr const char* one_sample = "    instrument: {usual_water: none, receiver: {samples: 1}}\n";

}  // namespace

TEST_CASE("speckle of three presets: Rayleigh, correlated as beam and pulse have it") {
    // An aperture with errors of phase whose beams are even in sine, a wide one whose beams are
    // half a width apart, a narrow one whose beams are a width apart.
    const Patch presets[] = {{"oculus_m1200d_2100khz", 1.2, 0.0025, 85},
                             {"gemini_720is", 3.0, 0.008, 43},
                             {"didson_1800khz", 5.0, 0.02, 66, one_sample}};
    for (const Patch& patch : presets) {
        CAPTURE(patch.sonar.config.instrument.frequency_hz);
        const LineArray array = array_of(patch.sonar);
        const PulseConfig& pulse = patch.sonar.config.instrument.pulse;
        const double width = radians(patch.sonar.config.instrument.beam.width_deg);
        const int outer = patch.beams() / 8;
        const int inner = patch.beams() - 2 * outer;
        const double spacing =
            patch.beam_sine(patch.beams() / 2 + 1) - patch.beam_sine(patch.beams() / 2);
        const int apart = static_cast<int>(std::ceil(2.0 * width / spacing));
        const std::vector<float> image = quiet_image(patch.sonar, patch.surface, true);

        // Places two widths of beam and pulse apart are independent. Three tests at 1 % in all.
        const std::vector<double> powers = patch.normalised(image, outer, inner, apart, 4);
        CHECK(ks_p_value(powers, [](double x) { return 1.0 - std::exp(-x); }) >
              1.0 - std::pow(0.99, 1.0 / 3.0));

        // A correlation over n independent places is off by about 1 / sqrt(n); with neighbours
        // there are some 4 times as many that count.
        const double tolerance = 2.0 / std::sqrt(static_cast<double>(powers.size()));
        const std::vector<double> here = patch.normalised(image, outer, inner);
        for (const int lag : {1, 2, 3}) {
            CAPTURE(lag);
            const auto off = [&](const std::vector<double>& there, double closed) {
                return std::fabs(correlation(here, there) - closed);
            };
            CHECK(off(patch.normalised(image, outer + lag, inner),
                      power_correlation(array, 0.0, lag * spacing * array.wavelengths)) <
                  tolerance);
            const double apart_m = lag * patch.sonar.settings.view.bin_m();
            CHECK(off(patch.normalised(image, outer, inner, 1, 1, 20 + lag),
                      power_correlation_of_pulse(pulse, apart_m)) < tolerance);
        }
    }
}

TEST_CASE("speckle decorrelates with sway, yaw and surge as the aperture and the pulse say") {
    // Moved by (x, y), the way to a scatterer at azimuth a and back is shorter by 2 (x cos a + y
    // sin a): within a beam as if the aperture were moved by 2 (y - x tan a). The scatterer is seen
    // under another angle, by (y cos a - x sin a) / r less, and aside by a yaw; and sooner.
    const Patch patch("didson_1800khz", 5.0, 0.02, 66, one_sample);
    const LineArray array = array_of(patch.sonar);
    const PulseConfig& pulse = patch.sonar.config.instrument.pulse;
    constexpr int outer = 10;
    const int inner = patch.beams() - 2 * outer;
    // The correlation of one seed is off by about 0.02: the mean of twelve has the closed form.
    constexpr std::uint32_t seeds = 12;
    std::vector<std::vector<double>> here;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        here.push_back(patch.normalised(quiet_image(patch.sonar, patch.surface, true, {}, seed),
                                        outer, inner));
    }
    struct Motion {
        double x_m, y_m, yaw_deg;
    };
    for (const Motion& motion :
         {Motion{0.0, 0.010, 0.0}, Motion{0.0, 0.025, 0.0}, Motion{0.0, 0.0, 0.1},
          Motion{0.0, 0.0, 0.2}, Motion{0.005, 0.0, 0.0}, Motion{0.010, 0.0, 0.0},
          Motion{0.004, 0.012, 0.1}}) {
        CAPTURE_ALL(motion.x_m, motion.y_m, motion.yaw_deg);
        const Pose pose{rotation_from_rpy(0.0, 0.0, radians(motion.yaw_deg)),
                        {motion.x_m, motion.y_m, 0.0}};
        double left = 0.0;
        for (int j = outer; j < outer + inner; ++j) {
            const double sine = patch.beam_sine(j);
            const double cosine = std::sqrt(1.0 - sine * sine);
            const double aperture_m = array.wavelengths * patch.wavelength_m();
            const double moved = 2.0 * (motion.y_m - motion.x_m * sine / cosine) / aperture_m;
            const double angle =
                radians(motion.yaw_deg) + (motion.y_m * cosine - motion.x_m * sine) / patch.range_m;
            left += power_correlation(array, moved, angle * cosine * array.wavelengths) *
                    power_correlation_of_pulse(pulse, motion.x_m * cosine + motion.y_m * sine) /
                    inner;
        }
        const Samples moved = patch.visible_from(pose);
        double found = 0.0;
        for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
            const std::vector<float> second = quiet_image(patch.sonar, moved, true, pose, seed);
            found += correlation(here[seed - 1], patch.normalised(second, outer, inner)) / seeds;
        }
        CHECK(std::fabs(found - left) < 0.02);
    }
}

// Given their places, amplitudes of scatterers are Gaussian, so the contrast of speckle is
// sqrt(1 + 2 v), v the variance of the power that a resolution cell holds over its square.
TEST_CASE("scatterers: the contrast of speckle is 1.00 to 1.03 at all ranges") {
    constexpr double resolution_m = 0.015;
    const double width = radians(0.6);
    const ScattererCells cells = scatterer_cells(resolution_m, width, 0.3, 1e-3);
    Uniform random(7);
    for (const double range : {0.4, 0.7, 1.1, 1.6, 2.3, 3.3, 5.0, 9.0, 20.0}) {
        CAPTURE(range);
        const double across_m = width * range;
        const double half_m = 3.0 * std::max(across_m, resolution_m);
        const Samples ground = patches({range, 0.0, -0.15 * range}, {1.0, 0.0, 0.0},
                                       {0.0, 1.0, 0.0}, half_m, half_m, 0.25 * half_m, {});
        std::vector<double> powers;
        for (std::uint32_t seed = 1; seed <= 400; ++seed) {
            const auto turn = random.single(0.0, pi);
            const auto metres = [&] { return random.between(0.0, 1.0); };
            SonarInScene sonar{Eigen::AngleAxisf(turn, Eigen::Vector3f::UnitZ()).toRotationMatrix(),
                               {metres(), metres(), metres()}};
            Scatterers block;
            double power = 0.0;
            find_scatterers(ground.items, ViewShape::fan, cells, sonar, {seed, 1}, block,
                            [&](const Scatterers& found) {
                                const PatchBlock& p = found.pieces;
                                for (int k = 0; k < p.count; ++k) {
                                    const double x = (p.x[k] - range) / resolution_m;
                                    const double y = p.y[k] / across_m;
                                    // Half of the power at half a resolution cell.
                                    power += p.area_m2[k] * std::exp2(-4.0 * (x * x + y * y));
                                }
                            });
            powers.push_back(power);
        }
        const double expected = pi / (4.0 * std::log(2.0)) * resolution_m * across_m;
        CHECK(std::fabs(mean(powers) - expected) < 4.0 * standard_error(powers) + 0.02 * expected);
        const double v = std::pow(deviation(powers) / mean(powers), 2.0);
        CHECK(std::sqrt(1.0 + 2.0 * v) < 1.03);
    }
}

TEST_CASE("scatterers: floors at 0 and slopes of 45 degrees keep theirs as the sonar moves") {
    const ScattererCells cells = scatterer_cells(0.02, radians(0.5), 0.3, 5e-3);
    const auto names_from = [&](double slope, double lift_m) {
        const Pose pose{rotation_from_rpy(0.0, 0.26, 0.05), {-3.0, 0.1, 2.0 + lift_m}};
        const Samples surface = patches({0.0, 0.0, 0.0}, {std::cos(slope), 0.0, std::sin(slope)},
                                        {0.0, 1.0, 0.0}, 1.0, 1.0, 0.1, pose);
        const SonarInScene sonar{pose.rotation.toRotationMatrix().cast<float>(), pose.translation};
        std::set<std::array<std::int32_t, 3>> names;
        Scatterers block;
        find_scatterers(
            surface.items, ViewShape::fan, cells, sonar, {1, 1}, block,
            [&](const Scatterers& found) {
                for (int k = 0; k < found.pieces.count; ++k)
                    names.insert({found.cell[0][k], found.cell[1][k], found.cell[2][k]});
            });
        return names;
    };
    for (const double slope : {0.0, 0.25 * pi, 0.5 * pi}) {
        const auto names = names_from(slope, 0.0);
        REQUIRE(names.size() > 1000);
        const auto lost = std::ranges::count_if(
            names_from(slope, 2e-5), [&](const auto& name) { return !names.contains(name); });
        CHECK(static_cast<double>(lost) < 0.01 * static_cast<double>(names.size()));
    }
}
