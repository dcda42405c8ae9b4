#include "compare/figures/edges.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "calibrate/made_pings.h"
#include "compare/compare.h"
#include "core/normal_pair.h"
#include "core/random.h"
#include "support/approx.h"
#include "support/sanitized.h"

using namespace sonarsim;

namespace {

/// The speckle of a bin of window `number`: powers of mean 1. Neighbours across the step share half
/// of the amplitude if `is_shared`; K of shape 2 if `is_k`.
struct DrawnSpeckle {
    bool is_shared = false;
    bool is_k = false;

    double at(std::uint32_t number, int i, int j) const {
        const auto draw_of = [&](int column) {
            return philox(
                {number, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(column + 1), 0},
                {0x65646765U, 0});
        };
        const PhiloxBlock draw = draw_of(j);
        const NormalPair own = normal_pair(draw.x0);
        const NormalPair next = normal_pair(draw_of(j + 1).x0);
        const float share = is_shared ? 1.0F : 0.0F;
        const float re = own.first + share * next.first;
        const float im = own.second + share * next.second;
        double value = 0.5 / (1.0 + share) * (re * re + im * im);
        if (is_k)
            value *= -0.5 * (natural_log(unit_float(draw.x1)) + natural_log(unit_float(draw.x2)));
        return value;
    }
};

/// The median width over windows of 32 x 16 bins in which a step from 0.02 to 1 has this response,
/// with its middle drawn within 2 bins and its slant within 0.2.
double median_width(const std::function<double(double)>& step, const DrawnSpeckle* speckle,
                    std::uint32_t first, std::uint32_t count) {
    std::vector<double> widths;
    for (std::uint32_t k = first; k < first + count; ++k) {
        test::Draws draws(k);
        const double middle = draws.between(-2.0, 2.0);
        const double slant = draws.between(-0.2, 0.2);
        StepWindow window{{}, 32, 16};
        for (int i = 0; i < 32; ++i) {
            for (int j = 0; j < 16; ++j) {
                const double mean = 0.02 + 0.98 * step(i - 15.5 - middle - slant * (j - 7.5));
                window.power.push_back(
                    static_cast<float>(speckle ? mean * speckle->at(k, i, j) : mean));
            }
        }
        const double width = width_of_step(window);
        if (std::isfinite(width)) widths.push_back(width);
    }
    CHECK(widths.size() > 0.9 * count);
    std::ranges::sort(widths);
    return widths[widths.size() / 2];
}

/// The integral of a Gaussian of unit width.
double gaussian_step(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

/// Patches of a flat bottom 1 m below, at bearings between two.
void add_wedge(double from_deg, double to_deg, Samples& out) {
    constexpr double length = 0.02, below = 1.0, step_deg = 0.25;
    for (double x = 2.5; x < 7.5; x += length) {
        for (double at = from_deg + 0.5 * step_deg; at < to_deg; at += step_deg) {
            const auto [sine, cosine] = sincos(radians(at));
            const double across = x * radians(step_deg);
            const Eigen::Vector3d u(cosine, sine, 0.0), v(-sine, cosine, 0.0);
            out.items.push_back(
                {.position = (x * u - below * Eigen::Vector3d::UnitZ()).cast<float>(),
                 .edge_u = (0.5 * length * u).cast<float>(),
                 .edge_v = (0.5 * across * v).cast<float>(),
                 .normal = Eigen::Vector3f(0, 0, 1),
                 .height_m = static_cast<float>(below),
                 .area_m2 = static_cast<float>(length * across),
                 .material = 0,
                 .instance = 0});
        }
    }
}

}  // namespace

TEST_SUITE("compare") {
    TEST_CASE("edges: the width of a Gaussian's step, and speckle of any law does not change it") {
        // Phi reaches 0.1 and 0.9 at -+1.28155: the width is 2.5631 sigma. One window's width
        // varies by a third or less of it where bins are independent, by a half where speckle is K
        // or shared; the median of 300 by 1.25 / sqrt(300) of that, 2.4 and 3.6 %. Four of these.
        const DrawnSpeckle plain, shared{.is_shared = true}, k{.is_k = true};
        for (std::uint32_t draw = 0; draw < 3; ++draw) {
            const double sigma = test::Draws(9000 + draw).between(0.8, 2.8);
            CAPTURE(sigma);
            const auto step = [&](double x) { return gaussian_step(x / sigma); };
            const double width = 2.56310 * sigma;
            CHECK(median_width(step, nullptr, 0, 20) == test::approx(width).epsilon(0.01));
            CHECK(median_width(step, &plain, 300 * draw, 300) == test::approx(width).epsilon(0.10));
            CHECK(median_width(step, &shared, 300 * draw, 300) ==
                  test::approx(width).epsilon(0.15));
            CHECK(median_width(step, &k, 300 * draw, 300) == test::approx(width).epsilon(0.15));
        }
    }

    TEST_CASE("edges: the step of a beam's pattern") {
        // The integral of sinc^2(x / b), a uniform array's pattern, reaches 10 and 90 % at
        // -+0.5349 b: 1.0697 b. The fitted shape is Gaussian; its weights find that width to 12 %.
        std::vector<double> integral(1, 0.0);
        constexpr int steps = 4000;  // from -40 to 40
        for (int i = 0; i < steps; ++i) {
            const double amplitude = sinc(0.02 * (i + 0.5) - 40.0);
            integral.push_back(integral.back() + 0.02 * amplitude * amplitude);
        }
        for (std::uint32_t draw = 0; draw < 3; ++draw) {
            const double beam = test::Draws(9100 + draw).between(2.0, 5.0);
            CAPTURE(beam);
            const auto step = [&](double x) {
                const double at = std::clamp((x / beam + 40.0) / 0.02, 0.0, steps - 1.0);
                return integral[static_cast<std::size_t>(at)] / integral.back();
            };
            const DrawnSpeckle plain;
            CHECK(median_width(step, &plain, 300 * draw, 300) ==
                  test::approx(1.0697 * beam).epsilon(0.2));
        }
    }

    TEST_CASE("edges: a bright square has four of them, speckle and thin lines have none") {
        constexpr int ranges = 192, beams = 96;
        const DrawnSpeckle speckle;
        const auto image_of = [&](const std::function<bool(int, int)>& is_bright) {
            std::vector<float> power;
            for (int i = 0; i < ranges; ++i) {
                for (int j = 0; j < beams; ++j)
                    power.push_back(
                        static_cast<float>((is_bright(i, j) ? 1.0 : 0.01) * speckle.at(7, i, j)));
            }
            return power;
        };
        const EdgeSearch search{{32, 16}, {0, ranges}, 0.0F};
        const auto square =
            image_of([](int i, int j) { return i >= 50 && i < 130 && j >= 21 && j < 69; });
        const std::vector<Edge> by_range =
            edges_of({square, ranges, beams}, search, StepAlong::range);
        // Strips of 16 beams that lie in the square, 32 to 47 and 48 to 63, have both edges; those
        // that lie in it partly may have them.
        CHECK(by_range.size() >= 4);
        for (const Edge& edge : by_range) {
            CHECK(std::min(std::abs(edge.range - 50), std::abs(edge.range - 130)) <= 2);
            CHECK(edge.width < 1.5);
        }
        const std::vector<Edge> by_beam =
            edges_of({square, ranges, beams}, search, StepAlong::bearing);
        // The same of strips of 32 ranges: 64 to 95 and 96 to 127.
        CHECK(by_beam.size() >= 4);
        for (const Edge& edge : by_beam)
            CHECK(std::min(std::abs(edge.beam - 21), std::abs(edge.beam - 69)) <= 2);
        // Clipped regions say nothing.
        CHECK(edges_of({square, ranges, beams}, {{32, 16}, {0, ranges}, 0.5F}, StepAlong::range)
                  .empty());
        const auto all = image_of([](int, int) { return true; });
        const auto line = image_of([](int i, int j) { return i / 3 == 25 || j / 2 == 22; });
        for (const StepAlong along : {StepAlong::range, StepAlong::bearing}) {
            CHECK(edges_of({all, ranges, beams}, search, along).empty());
            CHECK(edges_of({line, ranges, beams}, search, along).empty());
        }
    }

    TEST_CASE("edges: sets of two beam widths differ in their edges, and of one do not" *
              doctest::skip(test::sanitized)) {
        // Two wedges of bottom with water between them. The wider beam has the wider edges. With 12
        // pings each width is known to 0.1 to 0.2 degrees; with 6, two of five draws differ too
        // little.
        Samples wedges;
        add_wedge(-17.0, -4.0, wedges);
        add_wedge(5.0, 16.0, wedges);
        SonarConfig narrow = test::plain_imaging();
        SonarConfig wide = narrow;
        narrow.instrument.beam.width_deg = 1.0;
        wide.instrument.beam.width_deg = 1.6;
        const auto figure_between = [&](const SonarConfig& a, const SonarConfig& b) {
            const Comparison one = compare_recordings(test::made_recording(a, 12, 1, wedges),
                                                      test::made_recording(b, 12, 2, wedges));
            const auto found =
                std::ranges::find(one.figures, "edges: width, degrees", &ComparedFigure::name);
            REQUIRE(found != one.figures.end());
            return *found;
        };
        const ComparedFigure same = figure_between(narrow, narrow);
        CHECK(same.agrees);
        CHECK_FALSE(same.differs);
        const ComparedFigure other = figure_between(narrow, wide);
        CHECK(other.differs);
        CHECK_FALSE(other.agrees);
        MESSAGE("widths: ", other.estimate.real, " +- ", other.real_half, ", ",
                other.estimate.simulated, " +- ", other.simulated_half);
        CHECK(other.estimate.simulated / other.estimate.real == test::approx(1.6).epsilon(0.25));
    }
}
