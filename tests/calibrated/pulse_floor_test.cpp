#include "calibrated/pulse_floor.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "calibrated/decibel.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

constexpr int floor_rows = 203;

std::vector<double> floor_powers(const EchoGrid& grid, PowerForm form) {
    std::vector<double> out;
    for (int row = 0; row < grid.rows(); ++row) {
        const double re = grid.column(0)[2 * row];
        const double im = grid.column(0)[2 * row + 1];
        out.push_back(form == PowerForm::power ? re : re * re + im * im);
    }
    return out;
}

}  // namespace

TEST_SUITE("calibrated") {
    // A pulse of 40 bins of range, c T / 2, whose far side lobes have a hundredth of its energy:
    // an echo of the power 9 in bin 100 leaves 0.09 / 81 in each of the bins 60 to 140.
    TEST_CASE("pulse floor: it is even, as long as the pulse, and has its share of the energy") {
        constexpr double bin_m = 0.025;
        const PulseFloor floor = pulse_floor(
            {.duration_s = 2.0 * 40.0 * bin_m / 1500.0, .floor_db = -20.0}, bin_m, 1500.0);
        REQUIRE(floor.reach == 40);
        EchoGrid grid(floor_rows, 1);
        grid.column(0)[2 * 100] = 9.0F;
        add_pulse_floor(floor, PowerForm::power, 1.0F, {1, 2}, nullptr, grid);
        const std::vector<double> found = floor_powers(grid, PowerForm::power);
        for (int row = 0; row < floor_rows; ++row) {
            CAPTURE(row);
            const double even = row < 60 || row > 140 ? 0.0 : 0.09 / 81.0;
            CHECK(found[row] == test::approx(row == 100 ? 9.0 + even : even).epsilon(1e-5));
        }
    }

    // The mean of 81 exponential powers of 200 draws is known to 0.8 %; this is 4 sigma.
    TEST_CASE("pulse floor: amplitudes have its power as their mean") {
        const PulseFloor floor{.reach = 40, .share = 0.01F / 81.0F};
        double sum = 0.0;
        for (std::uint32_t draw = 0; draw < 200; ++draw) {
            EchoGrid grid(floor_rows, 1);
            EchoGrid coherent(floor_rows, 1);
            coherent.column(0)[2 * 100 + 1] = 3.0F;
            add_pulse_floor(floor, PowerForm::amplitude, 1.0F, {draw, 2}, &coherent, grid);
            for (const double power : floor_powers(grid, PowerForm::amplitude))
                sum += power / 200.0;
        }
        CHECK(sum == test::approx(0.09).epsilon(0.032));
    }

    TEST_CASE("pulse floor: none without a code or a level") {
        CHECK(pulse_floor({.duration_s = 0.0, .floor_db = -20.0}, 0.1, 1500.0).share == 0.0F);
        CHECK(pulse_floor({.duration_s = 1e-3}, 0.1, 1500.0).share == 0.0F);
    }
}
