#include "compare/compare.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compare/drawn_recording.h"
#include "compare/exchange.h"
#include "compare/plot.h"
#include "compare/report.h"
#include "compare/student.h"
#include "core/error.h"
#include "support/approx.h"
#include "support/sanitized.h"

using namespace sonarsim;
using sonarsim::test::drawn_recording;
using sonarsim::test::DrawnLaw;

namespace {

const ComparedFigure& figure_of(const Comparison& comparison, const std::string& name) {
    const auto found = std::ranges::find(comparison.figures, name, &ComparedFigure::name);
    REQUIRE(found != comparison.figures.end());
    return *found;
}

}  // namespace

TEST_SUITE("compare") {
    TEST_CASE("compare: two draws of one law are the same in 95 of 100 pairs" *
              doctest::skip(test::sanitized)) {
        // Each pair is called different with a probability of at most 5 %; 4 or more of 10 are so
        // with a probability of 0.001, the significance of this test.
        int different = 0;
        for (std::uint32_t k = 0; k < 10; ++k) {
            const DrawnLaw law{.is_k = k % 2 == 0, .beam_mixture = 0.5F};
            const Comparison one =
                compare_recordings(drawn_recording(2 * k, law), drawn_recording(2 * k + 1, law));
            different += one.is_same() ? 0 : 1;
        }
        CHECK(different < 4);
    }

    TEST_CASE("compare: the error of a level is that of independent cells") {
        // The mean of n exponential powers has the standard deviation 1/sqrt(n) of itself, 4.34 dB
        // of its logarithm: 6 pings of 128 x 64 give 4.343 / sqrt(49152) = 0.0196 dB, the
        // difference sqrt(2) of it. The bootstrap draws 300 times: its own error is 4 %, and that
        // of a variance over 64 places 9 %; five of these are 0.5.
        const Comparison one = compare_recordings(drawn_recording(1, {}), drawn_recording(2, {}));
        const Estimate& level = figure_of(one, "image: level, dB").estimate;
        CHECK(std::fabs(level.difference_error / 0.0277 - 1.0) < 0.5);
        CHECK(std::fabs(level.simulated - level.real) < 5 * 0.0277);
        CHECK(level.real == test::approx(-20.0).epsilon(0.01));
    }

    TEST_CASE("compare: a change of one decibel is found and named") {
        const Comparison one =
            compare_recordings(drawn_recording(1, {}), drawn_recording(2, {.level_db = -19.0}));
        CHECK_FALSE(one.is_same());
        const ComparedFigure& level = figure_of(one, "image: level, dB");
        CHECK(level.differs);
        CHECK(level.estimate.simulated - level.estimate.real == test::approx(1.0).epsilon(0.15));
        REQUIRE(one.first_change >= 0);
        CHECK(one.figures[static_cast<std::size_t>(one.first_change)].name.find("level") !=
              std::string::npos);
        for (const char* other : {"image: Weibull shape", "image: correlation over 1 beams"})
            CHECK_FALSE(figure_of(one, other).differs);
    }

    TEST_CASE("compare: another law of amplitudes is found with its shape") {
        const Comparison one =
            compare_recordings(drawn_recording(1, {}), drawn_recording(2, {.is_k = true}));
        // K with shape 2 has the inverse 1/2. The fit of the trend takes about 0.02 of either, and
        // the median over 32 patches varies by 0.02.
        const ComparedFigure& shape = figure_of(one, "image: inverse K shape");
        CHECK(shape.differs);
        CHECK(std::fabs(shape.estimate.real) < 0.05);
        CHECK(std::fabs(shape.estimate.simulated - 0.5) < 0.1);
        CHECK(one.histograms[0].jensen_shannon > 3.0 * one.histograms[0].chance_jensen_shannon);
        CHECK_FALSE(figure_of(one, "image: level, dB").agrees == false);
    }

    TEST_CASE("compare: a correlation of beams is found") {
        const Comparison one =
            compare_recordings(drawn_recording(1, {}), drawn_recording(2, {.beam_mixture = 0.5F}));
        const ComparedFigure& figure = figure_of(one, "image: correlation over 1 beams");
        CHECK(figure.differs);
        CHECK_FALSE(figure.agrees);
        // Complex amplitudes have the correlation 0.5 / 1.25 = 0.4; that of Rayleigh amplitudes is
        // 0.92 times its square to within 0.01.
        CHECK(std::fabs(figure.estimate.simulated - 0.92 * 0.16) < 0.03);
        CHECK_FALSE(figure_of(one, "image: correlation over 1 ranges").differs);
    }

    TEST_CASE("compare: the same input gives the same result, and itself is the same") {
        const Recording recording = drawn_recording(3, {});
        const Comparison one = compare_recordings(recording, recording);
        CHECK(one.is_same());
        CHECK(one.agreeing == one.figures.size());
        CHECK(one.histograms[0].jensen_shannon == 0.0);
        CHECK(comparison_json(one).dump() ==
              comparison_json(compare_recordings(recording, recording)).dump());
        CHECK(comparison_text(one).find("Same: no figure differs") != std::string::npos);
        CHECK(comparison_svg(one).ends_with("</svg>\n"));
    }

    TEST_CASE("compare: exchange keeps its level where a few places make all of a difference") {
        // One of 40 places has a value 1,000 times the others'. Its exchange gives the same size,
        // so such a figure never differs, whatever its standard error.
        Measured real{"a", Reduce::mean, Tolerance::tenth, 0.5, {}};
        Measured simulated = real;
        for (int place = 0; place < 40; ++place) {
            real.cells.push_back({place, 0, place == 7 ? 1000.0F : 1.0F, 1.0F});
            simulated.cells.push_back({place, 0, 1.0F, 1.0F});
        }
        CHECK(exchange_p({{&real, &simulated, 1e-3}}, 1).front() == 1.0);
        // A difference of 1 at each place is never reached: 2^-39 of the exchanges have it.
        for (Cell& cell : real.cells)
            cell.value = 2.0F;
        CHECK(exchange_p({{&real, &simulated, 0.1}}, 1).front() == test::approx(1.0 / 500.0));
    }

    TEST_CASE("compare: images of one value differ from those of another") {
        const auto constant = [](float value) {
            Recording out = drawn_recording(1, {});
            for (RecordedPing& ping : out.pings)
                std::ranges::fill(ping.values, value);
            return out;
        };
        CHECK(compare_recordings(constant(9.0F), constant(9.0F)).is_same());
        CHECK_FALSE(compare_recordings(constant(9.0F), constant(90.0F)).is_same());
    }

    TEST_CASE("compare: recordings that cannot be compared are refused") {
        Recording other = drawn_recording(1, {});
        other.kind = RecordedKind::echosounder;
        CHECK_THROWS_AS(compare_recordings(drawn_recording(1, {}), other), InputError);
        Recording far = drawn_recording(1, {});
        far.first_range_m = 100.0;
        CHECK_THROWS_AS(compare_recordings(drawn_recording(1, {}), far), InputError);
        Recording tiny = drawn_recording(1, {});
        tiny.bearing_rad = {0.0};
        tiny.pings = {{.ranges = 2, .beams = 1, .values = {1, 2}}};
        CHECK_THROWS_AS(compare_recordings(tiny, tiny), InputError);
    }

    TEST_CASE("compare: soundings of another roughness and level") {
        // Ranges of a flat bottom 10 m below with a relative error of 0.1 or 0.2 %.
        const auto soundings = [](std::uint32_t number, double spread, float intensity,
                                  double full_value = 1.0) {
            Recording recording;
            recording.kind = RecordedKind::soundings;
            recording.law.kind = RecordedLaw::Kind::power;
            recording.law.full_value = full_value;
            for (std::uint32_t k = 0; k < 160; ++k) {
                RecordedSoundings& ping = recording.soundings.emplace_back();
                for (std::uint32_t i = 0; i < 120; ++i) {
                    const double angle = -1.0 + 2.0 * i / 119.0;
                    const PhiloxBlock draw = philox({number, k, i, 0}, {0x736f756eU, 0});
                    const double range = 10.0 / sincos(angle).cos;
                    const NormalPair noise = normal_pair(draw.x0);
                    ping.angle_rad.push_back(static_cast<float>(angle));
                    ping.range_m.push_back(
                        static_cast<float>(range * (1.0 + spread * noise.first)));
                    ping.intensity.push_back(intensity * -natural_log(unit_float(draw.x1)));
                }
            }
            return recording;
        };
        CHECK(compare_recordings(soundings(1, 1e-3, 1.0F), soundings(2, 1e-3, 1.0F)).is_same());
        const Comparison one =
            compare_recordings(soundings(1, 1e-3, 1.0F), soundings(2, 2e-3, 2.0F));
        const ComparedFigure& spread = figure_of(one, "10 to 20 degrees: spread of ranges, %");
        CHECK(spread.differs);
        // The mean of a root of 7 degrees of freedom is 0.965 of the root of the mean.
        CHECK(std::fabs(spread.estimate.real - 0.1) < 0.01);
        CHECK(std::fabs(spread.estimate.simulated - 0.2) < 0.02);
        CHECK(figure_of(one, "10 to 20 degrees: level, dB").estimate.simulated ==
              test::approx(3.01).epsilon(0.1));
        // Without a largest value a factor of all powers is none.
        const Comparison relative =
            compare_recordings(soundings(1, 1e-3, 1.0F, 0.0), soundings(2, 1e-3, 2.0F));
        CHECK(relative.has_relative_levels);
        CHECK(relative.is_same());
    }

    TEST_CASE("student: tails as in tables") {
        CHECK(student_tails(12.706, 1) == test::approx(0.05).epsilon(0.001));
        CHECK(student_tails(2.228, 10) == test::approx(0.05).epsilon(0.001));
        CHECK(student_tails(3.169, 10) == test::approx(0.01).epsilon(0.001));
        CHECK(student_tails(0, 5) == test::approx(1.0).epsilon(0.001));
        CHECK(student_95(30) == test::approx(2.0423).epsilon(0.0005));
    }
}
