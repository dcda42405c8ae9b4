#include "format/sonar_log.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/random.h"
#include "core/units.h"
#include "format/kmall_soundings.h"
#include "format/made_ek_logs.h"
#include "format/made_logs.h"
#include "format/message_of_log.h"
#include "support/approx.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("format") {
    TEST_CASE("kmall: drawn water columns, with phases and blocks of any length") {
        for (std::uint32_t draw = 0; draw < 12; ++draw) {
            const auto drawn = [&](std::uint32_t k, std::uint32_t count) {
                return static_cast<int>(philox({draw, k, 0, 0}, {77, 0}).x0 % count);
            };
            std::vector<MadeBeam> beams(3);
            std::size_t ranges = 1;
            for (std::uint32_t j = 0; j < 3; ++j) {
                beams[j] = {-40.0 + 30.0 * j, drawn(j, 4), {}};
                for (int i = 0; i < 1 + drawn(10 + j, 9); ++i)
                    beams[j].levels.push_back(
                        drawn(20 + 10 * j + static_cast<std::uint32_t>(i), 256) - 128);
                ranges = std::max(
                    ranges, static_cast<std::size_t>(beams[j].first) + beams[j].levels.size());
            }
            const int phase = drawn(5, 3);
            const int more = 4 * drawn(6, 3);
            const std::string file =
                kmall_datagram("#IIP", 1, "text") + kmall_water(1, beams, phase, 0, more) +
                kmall_water(1, beams, phase, 1, more) + kmall_water(2, beams, phase, 0, more);
            const SonarLog log = read_sonar_log(file, 10);
            REQUIRE(log.pings.size() == 2);  // the second fan is left out
            CHECK(log.kind == LoggedKind::imaging);
            CHECK(log.range_step_s == test::approx(1.0 / 3000.0));
            CHECK(log.frequency_hz == 3e5);
            CHECK(log.bearing_rad[0] == test::approx(radians(-40.0)));
            CHECK(log.pings[1].t_s == test::approx(2.5));
            const LoggedPing& ping = log.pings[0];
            REQUIRE(static_cast<std::size_t>(ping.ranges) == ranges);
            for (std::size_t j = 0; j < 3; ++j) {
                for (std::size_t i = 0; i < ranges; ++i) {
                    const auto k = static_cast<std::ptrdiff_t>(i) - beams[j].first;
                    const bool is_in =
                        k >= 0 && k < static_cast<std::ptrdiff_t>(beams[j].levels.size());
                    const int level = is_in ? beams[j].levels[static_cast<std::size_t>(k)] : -128;
                    CHECK(ping.values[3 * i + j] == static_cast<float>(level + 128));
                }
            }
        }
        CHECK(message_of_log(kmall_datagram("#IIP", 1, "text")).find("no water column") !=
              std::string::npos);
        // Two samples would make 120,002 values.
        CHECK(message_of_log(kmall_water(1, {{-10.0, 60000, {1}}, {10.0, 60000, {1}}}))
                  .find("begin far beyond") != std::string::npos);
    }

    TEST_CASE("kmall: drawn soundings, with blocks of any length") {
        for (std::uint32_t draw = 0; draw < 12; ++draw) {
            const auto drawn = [&](std::uint32_t k, double low, double high) {
                const PhiloxBlock block = philox({draw, k, 0, 0}, {78, 0});
                return low + (high - low) * unit_float(block.x0);
            };
            const std::vector<MadeSounding> made{
                {drawn(1, 5, 50), drawn(2, -50, 0), drawn(3, 0.01, 0.1), drawn(4, -60, 0)},
                {.below_m = 9.0, .two_way_s = 0.02, .type = 1},
                {.below_m = 9.0, .two_way_s = 0.02, .type = 2},
                {.below_m = 9.0, .two_way_s = 0.02, .method = 0},
                {drawn(5, 5, 50), drawn(6, 0, 50), drawn(7, 0.01, 0.1), -300.0, 0, 2}};
            const int more = 4 * static_cast<int>(drawn(8, 0, 3));
            const std::string file =
                kmall_datagram("#IIP", 1, "text") + kmall_water(1, {{0.0, 0, {0}}}) +
                kmall_soundings(1, made, 0, more) + kmall_soundings(1, made, 1, more) +
                kmall_soundings(2, made, 0, more) + kmall_soundings(3, made, 0, more);
            const std::vector<LoggedSoundings> pings = read_kmall_soundings(file, 2);
            REQUIRE(pings.size() == 2);  // the second fan is left out
            CHECK(pings[1].t_s == test::approx(2.5));
            CHECK(pings[0].sound_speed_m_s == 1500.0);
            CHECK(pings[0].frequency_hz == test::approx(3e5));
            REQUIRE(pings[0].beams.size() == 2);  // normal detections alone
            // The transmitter is 1 m below the reference point.
            CHECK(std::tan(radians(pings[0].beams[0].angle_deg)) ==
                  test::approx(made[0].across_m / (made[0].below_m - 1.0)).epsilon(1e-5));
            CHECK(pings[0].beams[0].two_way_s == test::approx(made[0].two_way_s));
            CHECK(pings[0].beams[0].intensity == test::approx(200.0 + made[0].level_db));
            CHECK(pings[0].beams[1].angle_deg > 0.0);
            CHECK(pings[0].beams[1].intensity == 0.0);
        }
        const auto fault_of = [](const std::string& bytes) -> std::string {
            try {
                read_kmall_soundings(bytes, 9);
            } catch (const std::runtime_error& fault) {
                return fault.what();
            }
            return "accepted";
        };
        CHECK(fault_of(kmall_water(1, {{0.0, 0, {0}}})).find("no soundings") != std::string::npos);
        CHECK(fault_of(all_datagram('I', 1, 7, "x")).find("no .kmall") != std::string::npos);
        const std::string file = kmall_soundings(1, {{10.0, 1.0, 0.02, -20.0}});
        for (std::size_t length = 8; length < file.size(); ++length)
            CHECK(fault_of(file.substr(0, length)).find("cut off") != std::string::npos);
        CHECK(fault_of(kmall_soundings(1, {{10.0, 1.0, -0.02, -20.0}})).find("impossible") !=
              std::string::npos);
    }

    TEST_CASE("aris: frames in the order of samples and beams") {
        const SonarLog log = read_sonar_log(aris_file(3, 5), 2);
        REQUIRE(log.pings.size() == 2);
        CHECK(log.pings[1].beams == 48);
        CHECK(log.pings[1].values[2 * 48 + 7] == 2 * 48 + 7 + 1);
        CHECK(log.pings[1].t_s == test::approx(4.0));
        CHECK(log.range_step_s == test::approx(8e-6));
        CHECK(log.first_range_s == test::approx(1004e-6));
        CHECK(message_of_log(aris_file(1, 5, 0)).find("not in the order") != std::string::npos);
    }

    TEST_CASE("all: beams of a ping in several datagrams, of the first head") {
        const std::vector<MadeBeam> port = {{40.0, 1, {-128, -127, 127}}, {20.0, 0, {0}}};
        const std::vector<MadeBeam> starboard = {{-30.5, 2, {5, 6}}};
        const std::string file = all_datagram('I', 1, 7, "install") + all_water(1, port, 3) +
                                 all_water(1, port, 3, 8) + all_water(1, starboard, 3) +
                                 all_water(2, port, 3) + all_water(3, port, 3) +
                                 all_water(3, starboard, 3);
        const SonarLog log = read_sonar_log(file, 10);
        REQUIRE(log.pings.size() == 2);  // the second lacks a datagram
        CHECK(log.kind == LoggedKind::imaging);
        CHECK(log.sound_speed_m_s == test::approx(1485.0));
        CHECK(log.range_step_s == test::approx(1.0 / 15000.0));
        CHECK(log.frequency_hz == 293e3);
        CHECK(log.bearing_rad[2] == test::approx(radians(-30.5)));
        // 12,714 days from 1970-01-01 to 2004-10-23.
        CHECK(log.pings[0].t_s == test::approx(12714.0 * 86400.0 + 1.0));
        CHECK(log.pings[1].values ==
              std::vector<float>{0, 128, 0, 0, 0, 0, 1, 0, 133, 255, 0, 134});
        const auto in_order = [&](bool big_endian) {
            return all_datagram('I', 1, 7, "install", big_endian) +
                   all_water(1, port, 3, 7, big_endian) + all_water(1, starboard, 3, 7, big_endian);
        };
        const SonarLog little = read_sonar_log(in_order(false), 10);
        const SonarLog big = read_sonar_log(in_order(true), 10);
        CHECK(big.pings[0].values == little.pings[0].values);
        CHECK(big.pings[0].t_s == little.pings[0].t_s);
        CHECK(big.bearing_rad == little.bearing_rad);
        CHECK(big.range_step_s == little.range_step_s);
        CHECK(big.sound_speed_m_s == little.sound_speed_m_s);
        CHECK(big.frequency_hz == little.frequency_hz);
        CHECK(message_of_log(all_datagram('I', 1, 7, "install")).find("no water column") !=
              std::string::npos);
        CHECK(message_of_log(file + "more").find("no datagram") != std::string::npos);
    }

    TEST_CASE("didson: frames of versions 3 and 4, with both delays") {
        for (const int version : {3, 4}) {
            const SonarLog log = read_sonar_log(didson_file(version, 3, 5), 2);
            REQUIRE(log.pings.size() == 2);
            CHECK(log.pings[1].beams == 48);
            CHECK(log.pings[1].values[2 * 48 + 7] == 2 * 48 + 7 + 1);
            CHECK(log.pings[1].t_s == test::approx(86401.25));
            CHECK(log.range_step_s == test::approx(2e-5));
            // Four periods of 0.572 ms and half a sample.
            CHECK(log.first_range_s == test::approx(4 * 0.572e-3 + 1e-5));
            CHECK(log.decibels->range_db == 90.0);
            CHECK(read_sonar_log(didson_file(version, 1, 5, 18), 2).first_range_s ==
                  test::approx(4 * 0.512e-3 + 1e-5));
        }
        CHECK(message_of_log(didson_file(3, 1, 5, 100, 4) + didson_file(3, 1, 5).substr(512, 90))
                  .find("cut off within a frame") != std::string::npos);
        CHECK(message_of_log(didson_file(2, 1, 5)).find("version 2") != std::string::npos);
        const std::string next = didson_file(3, 1, 5, 100, 6).substr(512);
        CHECK(message_of_log(didson_file(3, 1, 5) + next).find("split the file") !=
              std::string::npos);
    }

    TEST_CASE("ping360: both messages among other bytes; a wrong sum is no message") {
        std::string broken = ping360_message(300, {7, 7, 7}, false);
        broken[20] ^= 1;
        const std::string log_file = std::string("PingViewer sensor log BR\0\1", 26) +
                                     ping360_message(100, {1, 2, 255}, false) + broken +
                                     "10:00:00.123" + ping360_message(101, {4, 5, 6}, true) +
                                     ping360_message(102, {}, false);
        const SonarLog log = read_sonar_log(log_file, 10);
        REQUIRE(log.pings.size() == 2);
        CHECK(log.kind == LoggedKind::scanning);
        CHECK(log.pings[0].values == std::vector<float>{1, 2, 255});
        CHECK(log.pings[0].bearing_rad == test::approx(-0.5 * pi));
        CHECK(log.pings[1].values == std::vector<float>{4, 5, 6});
        CHECK(log.range_step_s == test::approx(2e-5));  // 800 steps of 25 ns
        CHECK(log.frequency_hz == 750e3);
        CHECK(message_of_log(ping360_message(1, {1, 2}, false) + ping360_message(1, {1}, false))
                  .find("split the file") != std::string::npos);
        CHECK(message_of_log("no sonar at all").find("no pings of a Ping360") != std::string::npos);
    }

    TEST_CASE("logs: a file that is cut or changed anywhere is read or refused, never more") {
        const std::string files[] = {
            kmall_water(1, {{-10.0, 1, {1, 2, 3}}, {10.0, 0, {4, 5}}}, 1) +
                kmall_water(2, {{-10.0, 1, {1, 2, 3}}, {10.0, 0, {4, 5}}}, 1),
            simrad_datagram("CON0", "config") + ek60_ping(38000, {1, 2}) + ek60_ping(38000, {3, 4}),
            aris_file(2, 2),
            all_water(1, {{-10.0, 1, {1, 2, 3}}}, 2) + all_water(1, {{10.0, 0, {4, 5}}}, 2),
            ek80_head() + ek80_parameter("A", "Frequency=\"38000\"") + ek80_ping("A", 1, 2, "abcd"),
            ek80_head() + ek80_parameter("A", "Frequency=\"38000\"") +
                ek80_ping("A", 8 + 256, 1, "abcdefgh"),
            ek80_head() + ek80_parameter("A", "FrequencyEnd=\"900\" PulseDuration=\"1E-3\"", 1) +
                ek80_ping("A", 8 + 256, 1, "abcdefgh"),
            all_water(1, {{-10.0, 1, {1, 2, 3}}}, 1, 7, true),
            didson_file(3, 2, 2),
            ping360_message(1, {1, 2, 3}, false) + ping360_message(2, {3, 4, 5}, true)};
        std::size_t refused = 0;
        for (const std::string& file : files) {
            for (std::size_t length = 0; length < file.size(); length += 1 + length / 200)
                refused += message_of_log(file.substr(0, length)) != "accepted" ? 1 : 0;
            for (std::uint32_t k = 0; k < 300; ++k) {
                std::string changed = file;
                const PhiloxBlock draw = philox({k, 0, 0, 0}, {9, 0});
                changed[draw.x0 % file.size()] = static_cast<char>(draw.x1);
                message_of_log(changed);
            }
        }
        CHECK(refused > 200);
    }
}
