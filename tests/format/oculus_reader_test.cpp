#include "format/oculus_reader.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "core/random.h"
#include "support/approx.h"
#include "support/oculus_message.h"

using namespace sonarsim;
using test::oculus_message;

TEST_SUITE("format") {
    TEST_CASE("oculus reader: both versions, one after the other and among other bytes") {
        const std::vector<std::uint8_t> image{1, 2, 3, 4, 5, 255};
        const std::string log = "SO log " + oculus_message(1, 0, image) + "SO" +
                                oculus_message(2, 0, image) + oculus_message(2, 0, image);
        const std::vector<OculusPing> pings = read_oculus(log, 10);
        REQUIRE(pings.size() == 3);
        for (const OculusPing& ping : pings) {
            CHECK(ping.values == std::vector<float>{1, 2, 3, 4, 5, 255});
            CHECK(ping.bearing_deg[0] == test::approx(-30.0));
            CHECK(ping.bearing_deg[1] == test::approx(15.5));
            CHECK(ping.range_step_m == 0.25);
            CHECK(ping.sound_speed_m_s == 1490.0);
            CHECK(ping.frequency_hz == 2.1e6);
        }
        CHECK(read_oculus(log, 2).size() == 2);
        const std::vector<std::uint8_t> deep{0, 1, 2, 0, 255, 255, 0, 0, 1, 0, 0, 0};
        const OculusPing sixteen = read_oculus(oculus_message(1, 1, deep), 1)[0];
        CHECK(sixteen.values == std::vector<float>{256, 2, 65535, 0, 1, 0});
        CHECK(sixteen.full_value == 65535.0);
    }

    TEST_CASE("oculus reader: damaged messages end in a message") {
        const std::vector<std::uint8_t> image{1, 2, 3, 4, 5, 6};
        const std::string sound = oculus_message(1, 0, image);
        CHECK_THROWS_AS(read_oculus("", 1), std::runtime_error);
        CHECK_THROWS_AS(read_oculus(sound.substr(0, sound.size() - 1), 1), std::runtime_error);
        CHECK_THROWS_AS(read_oculus(oculus_message(1, 2, image), 1), std::runtime_error);
        CHECK_THROWS_AS(read_oculus(oculus_message(1, 1, image), 1), std::runtime_error);
        std::string gains = sound;
        gains[20] = 4;
        CHECK_THROWS_AS(read_oculus(gains, 1), std::runtime_error);
        for (std::uint32_t k = 0; k < 20000; ++k) {
            const PhiloxBlock draw = philox({k, 0, 0, 0}, {0x6f63756cU, 0});
            std::string bytes = sound;
            bytes[draw.x0 % bytes.size()] = static_cast<char>(draw.x1);
            bytes[draw.x2 % bytes.size()] = static_cast<char>(draw.x3);
            try {
                for (const OculusPing& ping : read_oculus(bytes, 5))
                    REQUIRE_FALSE(ping.values.empty());
            } catch (const std::runtime_error&) {
                continue;
            }
        }
    }
}
