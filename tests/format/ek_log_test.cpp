#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <vector>

#include "core/elementary.h"
#include "core/units.h"
#include "format/ek80_pulse.h"
#include "format/made_ek_logs.h"
#include "format/message_of_log.h"
#include "format/sonar_log.h"
#include "support/approx.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("format") {
    TEST_CASE("ek80: sweeps are compressed to where and how strong their echo is") {
        // Sampled at 600 kHz, filtered about 60 kHz, and one of 3 and then one of 2 samples is
        // kept: one each 10 us. The echo is 0.01 of the sweep, delayed by 300 samples, 50 of those
        // kept.
        constexpr double rate_hz = 6e5, start_hz = 45e3, end_hz = 75e3, length_s = 1e-3;
        std::vector<double> taps;
        for (int k = 0; k < 16; ++k) {
            const SinCos turn = sincos(2.0 * pi * 60e3 * k / rate_hz);
            const double window = 0.5 - 0.5 * sincos(2.0 * pi * (k + 0.5) / 16.0).cos;
            taps.insert(taps.end(), {window * turn.cos, window * turn.sin});
        }
        std::vector<double> echo(1500);
        for (std::size_t k = 300; k < 900; ++k) {
            const double t = static_cast<double>(k - 300) / rate_hz;
            const double phase = start_hz * t + 0.5 * (end_hz - start_hz) / length_s * t * t;
            const double edge = std::min(t, length_s - t) / (0.05 * length_s);
            echo[k] = 0.01 * sincos(2.0 * pi * phase).cos *
                      (edge < 1.0 ? 0.5 - 0.5 * sincos(pi * edge).cos : 1.0);
        }
        MadeBytes samples;
        for (std::size_t i = 0; i < echo.size(); i += 6) {
            double real = 0.0, imaginary = 0.0;
            for (std::size_t k = 0; k < std::min<std::size_t>(16, i + 1); ++k) {
                real += taps[2 * k] * echo[i - k];
                imaginary += taps[2 * k + 1] * echo[i - k];
            }
            samples.f32(real).f32(imaginary);
        }
        const std::string settings =
            "FrequencyStart=\"45000\" FrequencyEnd=\"75000\" PulseDuration=\"1E-3\" Slope=\"0.05\"";
        const std::string head = ek80_filter("B", 1, 3, taps) + ek80_filter("B", 2, 2, {1.0, 0.0}) +
                                 ek80_parameter("B", settings, 1, "1.0E-05");
        const std::string ping = ek80_ping("B", 8 + 256, 250, samples.text);
        const SonarLog log = read_sonar_log(ek80_head() + head + ping, 10);
        const std::vector<float>& level = log.pings[0].values;
        const auto peak = std::max_element(level.begin(), level.end()) - level.begin();
        CHECK(peak == 50);
        // One sector at 5,400 ohms: (0.01 / (2 sqrt 2))^2 (5475 / 5400)^2 / 75 W.
        const double watts = 1e-4 / 8.0 * std::pow(5475.0 / 5400.0, 2.0) / 75.0;
        CHECK(level[50] == test::approx(200.0 + 10.0 * std::log10(watts)).epsilon(1e-5));
        // The main lobe of a flat spectrum of 30 kHz falls to half at 0.443 / 30 kHz, 14.8 us: a
        // sample is above that, two are below; its side lobes are 13 dB lower, a little less so
        // where filter and slope taper the spectrum.
        CHECK(level[50] - level[51] < 3.0);
        CHECK(level[50] - level[52] > 3.0);
        for (std::size_t k = 0; k < level.size(); ++k) {
            if (k < 46 || k > 54) CHECK(level[50] - level[k] > 12.0);
        }
        CHECK(message_of_log(ek80_head() + ek80_parameter("B", settings, 1, "1.0E-05") + ping)
                  .find("without their filters") != std::string::npos);
        // A channel that is not read needs none.
        MadeBytes power;
        power.add(std::int16_t{-256});
        CHECK(read_sonar_log(ek80_head() + ek80_parameter("A", "Frequency=\"38000\"") +
                                 ek80_ping("A", 1, 1, power.text) +
                                 ek80_parameter("B", settings, 1, "1.0E-05") + ping,
                             10, 38000.0)
                  .pings.size() == 1);
    }

    TEST_CASE("ek80: sweeps and filters with impossible numbers are refused") {
        MadeBytes samples;
        samples.f32(1.0).f32(0.0);
        const std::string ping = ek80_ping("B", 8 + 256, 1, samples.text);
        const std::string head = ek80_head() + ek80_filter("B", 1, 1, {1.0, 0.0});
        const std::string settings =
            "FrequencyStart=\"45000\" FrequencyEnd=\"75000\" PulseDuration=\"1E-3\" Slope=\"0.05\"";
        const auto is_refused = [&](const std::string& file, const char* reason) {
            return message_of_log(file + ping).find(reason) != std::string::npos;
        };
        const std::string usual = ek80_parameter("B", settings, 1, "1.0E-05");
        CHECK(message_of_log(head + usual + ping) == "accepted");
        CHECK(is_refused(ek80_head() + ek80_filter("B", 1, 0, {1.0, 0.0}) + usual,
                         "filter (FIL1 datagram) with impossible numbers"));
        CHECK(is_refused(head + ek80_parameter("B", "PulseDuration=\"1E-3\" Slope=\"0.9\"", 1),
                         "sweep with impossible numbers"));
        std::string filters;
        for (int stage = 2; stage < 10; ++stage)
            filters += ek80_filter("B", stage, 1, {1.0, 0.0});
        CHECK(is_refused(head + filters + usual, "more than 8 filters"));
        // Frequencies over the shortest of durations are no overflow.
        const char* shortest =
            "FrequencyStart=\"1\" FrequencyEnd=\"9E7\" PulseDuration=\"1E-305\" Slope=\"0\"";
        CHECK(message_of_log(head + ek80_parameter("B", shortest, 1, "1E-305") + ping) ==
              "accepted");
        // Each of these sweeps has 99,100 samples or more: the limit is 2^24.
        std::string sweeps = head;
        for (int k = 0; k < 170; ++k)
            sweeps += ek80_parameter("B",
                                     "FrequencyStart=\"1\" FrequencyEnd=\"9\" Slope=\"0\" "
                                     "PulseDuration=\"0.99" +
                                         std::to_string(k + 100) + "\"",
                                     1, "1.0E-05") +
                      ping;
        CHECK(message_of_log(sweeps).find("too often") != std::string::npos);
    }

    TEST_CASE("ek80: filters that would take minutes are refused") {
        // Pulses of 1e5 samples in a ping of 120,000: 1.2e10 products.
        constexpr int count = 120000;
        const std::string file =
            ek80_head() + ek80_filter("B", 1, 1, {1.0, 0.0}) +
            ek80_parameter("B",
                           "FrequencyStart=\"1\" FrequencyEnd=\"9\" Slope=\"0\" "
                           "PulseDuration=\"1\"",
                           1, "1.0E-05") +
            ek80_ping("B", 4 + 256, count, std::string(4 * count, '\x11'));
        CHECK(message_of_log(file).find("too long for its samples") != std::string::npos);
        // A sweep of 1e5 samples and 4,096 taps: 4e8 products more.
        const EkSweep sweep{1.0, 9.0, 1.0, 0.0, 1e-5};
        const EkFilter filter{1, std::vector<std::complex<float>>(4096)};
        std::size_t products = 9'900'000'000;
        CHECK_THROWS_AS(filtered_sweep(sweep, {filter}, products), std::runtime_error);
    }

    TEST_CASE("ek60: power of one of two channels") {
        const std::string file =
            simrad_datagram("CON0", std::string(40, 'x')) + ek60_ping(38000, {0, -256, -12800}) +
            ek60_ping(120000, {1, 2, 3, 4}) + simrad_datagram("NME0", "$GPGGA") +
            ek60_ping(38000, {9, 9, 9}, false) + ek60_ping(38000, {-1, -2, -3});
        const SonarLog log = read_sonar_log(file, 10, 38000.0);
        REQUIRE(log.pings.size() == 2);
        CHECK(log.kind == LoggedKind::echosounder);
        CHECK(log.pings[0].t_s == test::approx(10.0));
        // 256 steps are a factor of 2: 3.0103 dB.
        CHECK(log.pings[0].values[0] == test::approx(200.0));
        CHECK(log.pings[0].values[1] == test::approx(200.0 - 3.0103).epsilon(1e-6));
        CHECK(log.pings[0].values[2] == test::approx(200.0 - 150.515).epsilon(1e-5));
        CHECK(log.first_range_s == test::approx(4e-4));
        CHECK(log.sound_speed_m_s == 1480.0);
        CHECK(message_of_log(file).find("38000, 120000 Hz; choose") != std::string::npos);
        CHECK(message_of_log(file, 50000.0).find("choose") != std::string::npos);
    }

    TEST_CASE("ek80: power and complex samples of channels by their last parameters") {
        MadeBytes power;
        for (const int step : {0, -256, -12800})
            power.add(static_cast<std::int16_t>(step));
        MadeBytes sectors;  // two samples of two sectors, whose means are 3 + 4i and 0
        for (const double part : {2.0, 4.0, 4.0, 4.0, 1.0, 1.0, -1.0, -1.0})
            sectors.f32(part);
        const std::string file = ek80_head() + ek80_parameter("A", "Frequency=\"38000\"") +
                                 ek80_ping("A", 1, 3, power.text) +
                                 ek80_ping("A", 2, 3, power.text) +
                                 ek80_parameter("B", "Frequency=\"70000\"") +
                                 ek80_ping("B", 8 + 2 * 256, 2, sectors.text);
        const SonarLog narrow = read_sonar_log(file, 10, 38000.0);
        REQUIRE(narrow.pings.size() == 1);  // the second one has angles alone
        CHECK(narrow.kind == LoggedKind::echosounder);
        CHECK(narrow.pings[0].t_s == test::approx(10.0));
        CHECK(narrow.sound_speed_m_s == 1480.5);
        CHECK(narrow.first_range_s == test::approx(4e-4));
        CHECK(narrow.pings[0].values[1] == test::approx(200.0 - 3.0103).epsilon(1e-6));
        // Two sectors of a mean amplitude of 5 at 5,400 ohms, which B's receiver has by default:
        // 2 (5 / (2 sqrt 2))^2 (5475 / 5400)^2 / 75 W.
        const double watts = 2.0 * 25.0 / 8.0 * std::pow(5475.0 / 5400.0, 2.0) / 75.0;
        const SonarLog wide = read_sonar_log(file, 10, 70000.0);
        CHECK(wide.pings[0].values[0] ==
              test::approx(200.0 + 10.0 * std::log10(watts)).epsilon(1e-6));
        CHECK(wide.pings[0].values[1] == 0.0F);
        // A's receiver has 1,000 ohms.
        const SonarLog own =
            read_sonar_log(ek80_head() + ek80_parameter("A", "Frequency=\"38000\"") +
                               ek80_ping("A", 8 + 2 * 256, 2, sectors.text),
                           10);
        CHECK(own.pings[0].values[0] - wide.pings[0].values[0] ==
              test::approx(20.0 * std::log10(1.075 / (5475.0 / 5400.0))).epsilon(1e-3));
        CHECK(message_of_log(file).find("38000, 70000 Hz; choose") != std::string::npos);
        // The same samples in floats of 16 bits: 2, 4, 4, 4 and 1, 1, -1, -1.
        MadeBytes halves;
        for (const int bits : {0x4000, 0x4400, 0x4400, 0x4400, 0x3c00, 0x3c00, 0xbc00, 0xbc00})
            halves.u16(bits);
        const SonarLog half =
            read_sonar_log(ek80_head() + ek80_parameter("A", "Frequency=\"38000\"") +
                               ek80_ping("A", 4 + 2 * 256, 2, halves.text),
                           10);
        CHECK(half.pings[0].values == own.pings[0].values);
        CHECK(message_of_log(ek80_head() + ek80_ping("A", 1, 3, power.text))
                  .find("without its parameters") != std::string::npos);
        CHECK(message_of_log(ek80_head()).find("no power or complex") != std::string::npos);
    }
}
