#include "format/oculus_reader.h"

#include <doctest/doctest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/random.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

template <class T>
void place(std::string& bytes, std::size_t at, T value) {
    std::memcpy(&bytes[at], &value, sizeof value);
}

/// A message of 3 ranges and 2 beams. Version 2 has 36 bytes more in its fire message, and attitude
/// and spare fields.
std::string oculus_message(int version, int size, const std::vector<std::uint8_t>& image) {
    const std::size_t fire = version == 2 ? 89 : 53;
    const std::size_t more = version == 2 ? 24 : 0;  // heading, pitch and roll
    const std::size_t time = version == 2 ? 8 : 4;
    const std::size_t spare = version == 2 ? 16 : 0;
    std::string bytes(fire + 69 - 4 + more + time + spare + 4, '\0');
    place<std::uint16_t>(bytes, 0, 0x4f53);
    place<std::uint16_t>(bytes, 6, 0x23);
    place<std::uint16_t>(bytes, 8, static_cast<std::uint16_t>(version));
    place<double>(bytes, fire + 8, 2.1e6);
    place<double>(bytes, fire + 32 + more, 1490.0);
    const std::size_t value_size = fire + 40 + more + time;
    place<std::uint8_t>(bytes, value_size, static_cast<std::uint8_t>(size));
    place<double>(bytes, value_size + 1, 0.25);
    place<std::uint16_t>(bytes, value_size + 9, 3);
    place<std::uint16_t>(bytes, value_size + 11, 2);
    const std::size_t end = value_size + 13 + spare;
    place<std::int16_t>(bytes, end + 12, -3000);
    place<std::int16_t>(bytes, end + 14, 1550);
    place<std::uint32_t>(bytes, end, static_cast<std::uint32_t>(bytes.size()));
    place<std::uint32_t>(bytes, end + 4, static_cast<std::uint32_t>(image.size()));
    bytes.append(image.begin(), image.end());
    place<std::uint32_t>(bytes, 10, static_cast<std::uint32_t>(bytes.size() - 16));
    return bytes;
}

}  // namespace

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
