#include "simulate/calibrated/reverberation.h"

#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double bin_m = 0.05;
constexpr double water_speed_m_s = 1500.0;

Reverberation tail_of(double share_db, double time_s) {
    ReceiverConfig receiver;
    receiver.reverberation_db = share_db;
    receiver.reverberation_s = time_s;
    return {receiver, bin_m, water_speed_m_s};
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("reverberation: a tail has its share of the energy, and falls by 60 dB in T60") {
        // sum of r_k over k behind one echo of power 1 is share (1 - d) (1 + d + d^2 ...) = share.
        constexpr double time_s = 0.02;  // 300 bins of 67 us
        EchoGrid grid(2000, 1);
        grid.column(0)[2 * 10] = 1.0F;
        add_reverberation(tail_of(-20.0, time_s), PowerForm::power, {1, 2}, grid);
        double energy = 0.0;
        for (int row = 11; row < 2000; ++row)
            energy += static_cast<double>(grid.column(0)[2 * row]);
        CHECK(std::fabs(energy / 0.01 - 1.0) < 1e-3);
        const auto at = [&](int row) { return static_cast<double>(grid.column(0)[2 * row]); };
        CHECK(std::fabs(at(11 + 300) / at(11) / 1e-6 - 1.0) < 1e-3);
        CHECK(grid.column(0)[2 * 9] == 0.0F);
        CHECK(grid.column(0)[2 * 10] == 1.0F);  // nothing in the bin of the echo
    }

    TEST_CASE("reverberation: amplitudes of a tail have its power and are drawn for each ping") {
        std::array<std::vector<double>, 2> powers;
        for (const std::uint32_t ping : {0U, 1U}) {
            EchoGrid grid(64, 400);
            for (int c = 0; c < grid.columns(); ++c)
                grid.column(c)[0] = 1.0F;
            add_reverberation(tail_of(-10.0, 0.05), PowerForm::amplitude, {ping, 7}, grid);
            for (int c = 0; c < grid.columns(); ++c) {
                for (int row = 1; row < 64; ++row) {
                    const double re = grid.column(c)[2 * row];
                    const double im = grid.column(c)[2 * row + 1];
                    powers[ping].push_back(re * re + im * im);
                }
            }
        }
        const double d = std::pow(10.0, -6.0 * 2.0 * bin_m / water_speed_m_s / 0.05);
        const double expected = 0.1 * (1.0 - std::pow(d, 63.0)) / 63.0;
        // 25,200 exponential powers: 4.5 standard errors, which their decay raises a little.
        CHECK(std::fabs(mean(powers[0]) / expected - 1.0) < 4.5 * 1.2 / std::sqrt(25200.0));
        CHECK(powers[0] != powers[1]);
    }

    TEST_CASE("reverberation: without a time there is none") {
        EchoGrid grid(8, 1);
        grid.column(0)[0] = 1.0F;
        add_reverberation(tail_of(-10.0, 0.0), PowerForm::power, {1, 2}, grid);
        CHECK(grid.occupied() == 1);
    }
}
