#include "format/xtf_reader.h"

#include <doctest/doctest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/random.h"
#include "format/xtf.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

/// A file of two pings of three samples to a side, as sonarsim writes it.
std::string small_xtf() {
    const std::vector<std::uint16_t> first{1, 2, 3, 4, 5, 65535};
    const std::vector<std::uint16_t> second{6, 7, 8, 9, 10, 11};
    XtfPing ping{
        .number = 0, .t_s = 86400.25, .altitude_m = 4, .sound_speed_m_s = 1480, .range_max_m = 30};
    std::string bytes = xtf_header({"sss", 90, 1}) + xtf_record(ping, first);
    ping.t_s = 86401.5;
    return bytes + xtf_record(ping, second);
}

}  // namespace

TEST_SUITE("format") {
    TEST_CASE("xtf reader: what sonarsim writes is read back") {
        const XtfPings xtf = read_xtf(small_xtf(), 10);
        REQUIRE(xtf.pings.size() == 2);
        CHECK(xtf.full_value == 65535.0);
        CHECK(xtf.pings[0].port.samples == std::vector<float>{3, 2, 1});
        CHECK(xtf.pings[0].starboard.samples == std::vector<float>{4, 5, 65535});
        CHECK(xtf.pings[0].t_s == test::approx(86400.25));
        CHECK(xtf.pings[1].t_s == test::approx(86401.5));
        CHECK(xtf.pings[0].port.slant_range_m == 30.0);
        CHECK(xtf.pings[0].sound_speed_m_s == 1480.0);
        CHECK(read_xtf(small_xtf(), 1).pings.size() == 1);
    }

    TEST_CASE("xtf reader: samples of other files, by the published fields") {
        // Each channel has SampleFormat at 74 of its description; a weight of 1 halves the samples.
        std::string bytes = small_xtf();
        const std::int16_t weight = 1;
        std::memcpy(&bytes[1024 + 256 + 58], &weight, sizeof weight);
        CHECK(read_xtf(bytes, 1).pings[0].port.samples == std::vector<float>{1.5F, 1, 0.5F});
        // Records that are no pings are skipped: type 1 is a note.
        bytes = small_xtf();
        bytes[1024 + 2] = 1;
        CHECK(read_xtf(bytes, 10).pings.size() == 1);
    }

    TEST_CASE("xtf reader: damaged files end in a message") {
        CHECK_THROWS_AS(read_xtf("", 1), std::runtime_error);
        CHECK_THROWS_AS(read_xtf("{", 1), std::runtime_error);
        const std::string sound = small_xtf();
        CHECK_THROWS_AS(read_xtf(sound.substr(0, sound.size() - 1), 10), std::runtime_error);
        std::string odd = sound;
        odd[256 + 74] = 1;  // IBM floats
        odd[256 + 6] = 4;
        CHECK_THROWS_AS(read_xtf(odd, 10), std::runtime_error);
        for (std::uint32_t k = 0; k < 20000; ++k) {
            const PhiloxBlock draw = philox({k, 0, 0, 0}, {0x787466U, 0});
            std::string bytes = sound;
            for (int j = 0; j < 3; ++j) {
                const std::uint32_t at =
                    philox({k, 1, static_cast<std::uint32_t>(j), 0}, {0x787466U, 0}).x0;
                bytes[at % bytes.size()] = static_cast<char>(draw.x1 >> (8 * j));
            }
            if (draw.x2 % 8 == 0) bytes.resize(draw.x3 % bytes.size());
            try {
                for (const XtfSidescanPing& ping : read_xtf(bytes, 10).pings)
                    CHECK_FALSE(ping.port.samples.empty());
            } catch (const std::runtime_error&) {
                continue;
            }
        }
    }
}
