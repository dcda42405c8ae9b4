#include "recording/read_recording.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/elementary.h"
#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "core/units.h"
#include "format/made_logs.h"
#include "format/npy.h"
#include "format/png.h"
#include "format/png_file.h"
#include "format/xtf.h"
#include "recording/arrays.h"
#include "recording/law.h"
#include "support/approx.h"
#include "support/oculus_message.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// recording.yaml of two pings of 3 ranges and 4 beams in one array, and of any further keys.
std::string recording_text(const std::string& more) {
    return "kind: imaging\nfiles: pings.npy\nlaw: {kind: gamma, exponent: 0.5}\n"
           "sound_speed_m_s: 1490\nfirst_range_m: 0.5\nrange_step_m: 0.1\nrate_hz: 5\n" +
           more;
}

std::vector<float> counted(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t k = 0; k < count; ++k)
        values[k] = static_cast<float>(k);
    return values;
}

/// float32 [pings, ranges, beams] with counted values.
std::string pings_npy(std::size_t pings, std::size_t ranges, std::size_t beams) {
    const std::vector<float> values = counted(pings * ranges * beams);
    return npy_header({"<f4", {pings, ranges, beams}}) +
           std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

std::string message_of(const std::filesystem::path& path) {
    try {
        load_recording(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_SUITE("recording") {
    TEST_CASE("recording: an array of pings with bearings even in sine") {
        const TemporaryFolder folder;
        write_file(folder.path / "pings.npy", pings_npy(2, 3, 4));
        write_file(folder.path / "recording.yaml",
                   recording_text("bearing_first_deg: -30\nbearing_last_deg: 30\nspread: sine\n"
                                  "frequency_hz: 2.1e6\naltitude_m: 0.5\npitch_deg: 20\n"));
        const Recording recording = load_recording(folder.path);
        REQUIRE(recording.pings.size() == 2);
        CHECK(recording.pings[1].time_s == 0.2);
        CHECK(recording.pings[1].values[4 * 2 + 3] == 23.0F);
        // sin(-30 degrees) = -1/2; steps of 1/3: -1/2, -1/6, 1/6, 1/2.
        CHECK(std::fabs(sincos(recording.bearing_rad[1]).sin + 1.0 / 6.0) < 1e-12);
        CHECK(recording.frequency_hz == 2.1e6);
        CHECK(std::fabs(*recording.pitch_rad - pi / 9.0) < 1e-12);
        CHECK(load_recording(folder.path / "recording.yaml", {"", 1}).pings.size() == 1);
    }

    TEST_CASE(
        "recording: a side-scan row is port from the largest range to nadir, then starboard") {
        const TemporaryFolder folder;
        write_file(folder.path / "rows.npy", npy_bytes(counted(12), 2, 6));
        write_file(
            folder.path / "recording.yaml",
            "kind: sidescan\nfiles: rows.npy\nlaw: {kind: amplitude, full_value: 0}\n"
            "sound_speed_m_s: 1500\nfirst_range_m: 0.1\nrange_step_m: 0.2\ntimes_s: [1, 3]\n");
        const Recording recording = load_recording(folder.path);
        REQUIRE(recording.pings.size() == 2);
        CHECK(recording.pings[0].beams == 2);
        // The row 0 1 2 | 3 4 5: port is 2, 1, 0 from nadir on, starboard 3, 4, 5.
        CHECK(recording.pings[0].values == std::vector<float>{2, 3, 1, 4, 0, 5});
        CHECK(recording.pings[1].time_s == 3.0);
    }

    TEST_CASE("recording: XTF files of a side-scan") {
        const TemporaryFolder folder;
        const std::vector<std::uint16_t> row{1, 2, 3, 4, 5, 6};
        XtfPing ping;
        ping.range_max_m = 30.0;
        ping.sound_speed_m_s = 1480.0;
        ping.t_s = 10.0;
        const std::string one = xtf_header({}) + xtf_record(ping, row);
        ping.range_max_m = 60.0;
        write_file(folder.path / "a.xtf", one);
        write_file(folder.path / "b.xtf", one + xtf_record(ping, row));
        const std::string yaml = "kind: sidescan\nlaw: {kind: power, full_value: 65535}\nxtf: ";
        write_file(folder.path / "recording.yaml", yaml + "[a.xtf, a.xtf]\n");
        const Recording recording = load_recording(folder.path);
        REQUIRE(recording.pings.size() == 2);
        CHECK(recording.pings[1].values == std::vector<float>{3, 4, 2, 5, 1, 6});
        CHECK(recording.sound_speed_m_s == 1480.0);
        CHECK(recording.range_step_m == 10.0);
        CHECK(recording.first_range_m == 5.0);
        write_file(folder.path / "recording.yaml", yaml + "b.xtf\n");
        CHECK(message_of(folder.path).find("split the file") != std::string::npos);
        write_file(folder.path / "recording.yaml", yaml + "recording.yaml\n");
        CHECK(message_of(folder.path).find("is no XTF file") != std::string::npos);
    }

    TEST_CASE("recording: the full value follows the size of the samples unless it is given") {
        const TemporaryFolder folder;
        const auto full_value = [&](const std::string& yaml) {
            write_file(folder.path / "recording.yaml", yaml + "\n");
            return load_recording(folder.path).law.full_value;
        };
        XtfPing ping;
        ping.range_max_m = 30.0;
        ping.sound_speed_m_s = 1500.0;
        const std::vector<std::uint16_t> row{1, 2, 3, 4, 5, 6};
        std::string xtf = xtf_header({}) + xtf_record(ping, row);
        write_file(folder.path / "a.xtf", xtf);
        const std::string of_xtf = "kind: sidescan\nxtf: a.xtf\nlaw: {kind: amplitude";
        CHECK(full_value(of_xtf + "}") == 65535.0);
        CHECK(full_value(of_xtf + ", full_value: auto}") == 65535.0);
        CHECK(full_value(of_xtf + ", full_value: 255}") == 255.0);
        CHECK(full_value(of_xtf + ", full_value: 0}") == 0.0);
        // A weight of 1 halves the samples of the first side, and of 2 quarters those of the other.
        const std::size_t channel = 1024 + 256;
        xtf[channel + 58] = 1;
        xtf[channel + 64 + 6 + 58] = 2;
        write_file(folder.path / "a.xtf", xtf);
        CHECK(full_value(of_xtf + "}") == 32767.5);
        const std::string of_oculus =
            "kind: imaging\noculus: a.oculus\nrate_hz: 1\nlaw: {kind: gamma";
        write_file(folder.path / "a.oculus",
                   test::oculus_message(1, 1, std::vector<std::uint8_t>(12, 9)));
        CHECK(full_value(of_oculus + "}") == 65535.0);
        CHECK(full_value(of_oculus + ", full_value: 4095}") == 4095.0);
        write_file(folder.path / "a.oculus",
                   test::oculus_message(2, 0, std::vector<std::uint8_t>(6, 9)));
        CHECK(full_value(of_oculus + "}") == 255.0);
    }

    TEST_CASE("recording: XTF files of a multibeam's soundings") {
        const TemporaryFolder folder;
        // The beam without a travel time found no bottom.
        const std::string ping =
            xtf_multibeam({{0.02, -60.0, 3.0}, {0.0, -20.0, 9.0}, {0.01, 30.0, 4.0}}, 1500.0);
        write_file(folder.path / "a.xtf", xtf_header({}) + ping + ping);
        const std::string yaml = "kind: soundings\nlaw: {kind: amplitude, full_value: 0}\n";
        write_file(folder.path / "recording.yaml", yaml + "xtf: a.xtf\n");
        const Recording recording = load_recording(folder.path);
        REQUIRE(recording.soundings.size() == 2);
        const RecordedSoundings& own = recording.soundings[1];
        CHECK(own.time_s == test::approx(86403.25));
        CHECK(own.range_m == std::vector<float>{15.0F, 7.5F});
        CHECK(own.angle_rad[0] == test::approx(-pi / 3.0));
        CHECK(own.intensity == std::vector<float>{3.0F, 4.0F});
        CHECK(recording.sound_speed_m_s == 1500.0);
        write_file(folder.path / "recording.yaml", yaml + "xtf: a.xtf\nsound_speed_m_s: 1600\n");
        CHECK(load_recording(folder.path).soundings[0].range_m[1] == 8.0F);
        write_file(folder.path / "a.xtf",
                   xtf_header({}) + xtf_multibeam({{0.1, 200.0, 1.0}}, 1500.0));
        CHECK(message_of(folder.path).find("impossible numbers") != std::string::npos);
        write_file(folder.path / "a.xtf", xtf_header({}) + xtf_multibeam({{0.1, 20.0, 1.0}}, 0.0));
        write_file(folder.path / "recording.yaml", yaml + "xtf: a.xtf\n");
        CHECK(message_of(folder.path).find("add `sound_speed_m_s`") != std::string::npos);
        write_file(folder.path / "recording.yaml", yaml);
        CHECK(message_of(folder.path).find("section `soundings`, `xtf` or `logs`") !=
              std::string::npos);
    }

    TEST_CASE("recording: logs of sonars, with what their formats do not say") {
        const TemporaryFolder folder;
        const auto yaml = [&](const std::string& text) {
            write_file(folder.path / "recording.yaml", text);
        };
        const auto refused = [&](const std::string& text, const std::string& why) {
            yaml(text);
            const std::string message = message_of(folder.path);
            INFO(message);
            CHECK(message.find(why) != std::string::npos);
        };
        write_file(folder.path / "a.kmall",
                   kmall_water(5, {{30.0, 0, {0, -128}}, {-30.0, 0, {126, 127}}}));
        yaml("kind: imaging\nlogs: [a.kmall, a.kmall]\n");
        const Recording water = load_recording(folder.path);
        REQUIRE(water.pings.size() == 2);
        CHECK(water.range_step_m == test::approx(0.25));  // 1500 m/s at 3 kHz, two ways
        CHECK(water.bearing_rad[0] == test::approx(pi / 6.0));
        // 127 steps are the largest value; 1 less is half a decibel.
        CHECK(power_of(water.law, water.pings[0].values[3]) == test::approx(1.0));
        CHECK(power_of(water.law, water.pings[0].values[1]) == test::approx(std::pow(10.0, -0.05)));
        refused("kind: imaging\nlogs: a.kmall\nlaw: {kind: power}\n", "leave `law` out");
        refused("kind: echosounder\nlogs: a.kmall\n", "pings of the kind imaging");
        write_file(folder.path / "m.kmall", kmall_soundings(5, {{11.0, -10.0, 0.02, -20.0}}));
        yaml("kind: soundings\nlogs: [m.kmall, m.kmall]\n");
        const Recording bottom = load_recording(folder.path);
        REQUIRE(bottom.soundings.size() == 2);
        CHECK(bottom.soundings[0].range_m[0] == test::approx(15.0));
        CHECK(bottom.soundings[0].angle_rad[0] == test::approx(-pi / 4.0));  // to port
        CHECK(power_of(bottom.law, bottom.soundings[0].intensity[0]) == test::approx(0.01));
        refused("kind: soundings\nlogs: m.kmall\nlaw: {kind: power}\n", "leave `law` out");
        refused("kind: soundings\nlogs: a.kmall\n", "no soundings");
        write_file(folder.path / "b.aris", aris_file(2, 4));
        const std::string lens = "kind: imaging\nlogs: b.aris\n";
        refused(lens, "add `law`");
        refused(lens + "law: {kind: amplitude}\n", "add `bearing_first_deg`");
        yaml(lens + "law: {kind: amplitude}\nbearing_first_deg: 14\nbearing_last_deg: -14\n");
        const Recording lenses = load_recording(folder.path);
        CHECK(lenses.pings.size() == 2);
        CHECK(lenses.first_range_m == test::approx(0.5 * 1450.0 * 1004e-6));
        write_file(folder.path / "d.ddf", didson_file(3, 2, 4));
        const std::string old = "kind: imaging\nlogs: d.ddf\n";
        refused(old, "add `sound_speed_m_s`");
        refused(old + "sound_speed_m_s: 1500\n", "add `bearing_first_deg`");
        yaml(old + "sound_speed_m_s: 1500\nbearing_first_deg: 14\nbearing_last_deg: -14\n");
        const Recording didson = load_recording(folder.path);
        CHECK(didson.range_step_m == test::approx(0.015));
        CHECK(power_of(didson.law, 127.5) == test::approx(std::pow(10.0, -4.5)));
        // Another window begins at another range.
        write_file(folder.path / "far.ddf", didson_file(3, 2, 4, 100, 10));
        refused(
            "kind: imaging\nlogs: [d.ddf, far.ddf]\nsound_speed_m_s: 1500\n"
            "bearing_first_deg: 14\nbearing_last_deg: -14\n",
            "has another first range than the first file");
        write_file(folder.path / "c.log",
                   ping360_message(100, {1, 2, 3}, false) + ping360_message(101, {1, 2, 3}, false));
        const std::string head = "kind: scanning\nlogs: c.log\nlaw: {kind: amplitude}\n";
        refused(head, "add `sound_speed_m_s`");
        yaml(head + "sound_speed_m_s: 1500\nrate_hz: 4\nhead_first_deg: 90\n");
        const Recording scan = load_recording(folder.path);
        CHECK(scan.range_step_m == test::approx(0.015));
        CHECK(std::fabs(scan.pings[0].bearing_rad) < 1e-12);
        CHECK(scan.pings[1].time_s == 0.25);
        refused(recording_text("logs: c.log\n"), "one of `files`");
    }

    TEST_CASE("recording: soundings leave out what a beam did not find") {
        const TemporaryFolder folder;
        std::vector<float> range = counted(6);
        range[4] = std::nanf("");
        write_file(folder.path / "r.npy", npy_bytes(range, 2, 3));
        write_file(folder.path / "a.npy", npy_bytes(counted(6), 2, 3));
        write_file(
            folder.path / "recording.yaml",
            "kind: soundings\nsoundings: {range_m: r.npy, angle_rad: a.npy, intensity: a.npy}\n"
            "law: {kind: power, full_value: 0}\nsound_speed_m_s: 1500\nrate_hz: 20\n");
        const Recording recording = load_recording(folder.path);
        REQUIRE(recording.soundings.size() == 2);
        CHECK(recording.soundings[0].range_m.size() == 3);
        CHECK(recording.soundings[1].angle_rad == std::vector<float>{3, 5});
    }

    TEST_CASE("recording: PNG files with every filter of the format, 8 and 16 bits") {
        // Rows of one value are, by the filters none, left, up, mean and Paeth in turn:
        // all 9; 9 0 0; 0 0 0; 9 - 4 = 5, then 9 - (9 + 9) / 2 = 0; Paeth of 9 is 9 - 9 = 0.
        const unsigned char filtered[] = {0, 9, 9, 9, 1, 9, 0, 0, 2, 0,
                                          0, 0, 3, 5, 0, 0, 4, 0, 0, 0};
        std::string packed(compressBound(sizeof filtered), '\0');
        uLongf length = packed.size();
        REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &length, filtered,
                         sizeof filtered) == Z_OK);
        packed.resize(length);
        const RecordedArray array =
            read_array(png_file({3, 5, 8, PngColours::grey}, packed), "a.png");
        CHECK(array.shape == std::vector<std::size_t>{5, 3});
        CHECK(array.values == std::vector<double>(15, 9.0));
        const std::vector<std::uint16_t> deep{1, 256, 65535, 0};
        CHECK(read_array(png_bytes(deep, 2, 2), "b.png").values ==
              std::vector<double>{1, 256, 65535, 0});
        const std::vector<std::uint8_t> colours(12);
        CHECK_THROWS_AS(read_array(png_bytes(colours, 2, 2, 3), "c.png"), InputError);
        CHECK_THROWS_AS(read_array(png_file({3, 5, 8, PngColours::table}, packed, "abc"), "d.png"),
                        InputError);
    }

    TEST_CASE("recording: a fault is named with its place and cure") {
        const TemporaryFolder folder;
        write_file(folder.path / "pings.npy", pings_npy(2, 3, 4));
        const auto faulty = [&](const std::string& text, const std::string& wanted) {
            write_file(folder.path / "recording.yaml", text);
            const std::string message = message_of(folder.path);
            INFO(message);
            CHECK(message.find(wanted) != std::string::npos);
        };
        CHECK(message_of(folder.path).find("neither recording.yaml") != std::string::npos);
        faulty("kind: imagin\n", "did you mean 'imaging'");
        faulty(recording_text("bearing_fist_deg: 3\n"), "recording.yaml:8:1: unknown key");
        faulty(recording_text("bearings_deg: [1, 2, 3]\n"), "3 bearings for 4 beams");
        faulty(recording_text("times_s: [1]\n"), "1 times for 2 pings");
        faulty("kind: soundings\nfiles: a.npy\nlaw: {kind: power}\nsound_speed_m_s: 1500\n",
               "has the section `soundings`");
        faulty(
            "kind: echosounder\nfiles: pings.npy\nlaw: {kind: power}\nsound_speed_m_s: 1500\n"
            "first_range_m: 0\nrange_step_m: 1\n",
            "needs [ping, range]");
        faulty(recording_text("") + "law: {kind: power}\n", "law");
        write_file(folder.path / "pings.npy", "no array");
        faulty(recording_text(""), "is no .npy file");
        std::vector<float> negative(12, -1.0F);
        write_file(folder.path / "pings.npy", npy_bytes(negative, 3, 4));
        faulty(recording_text(""), "negative or not finite");
    }

    TEST_CASE("recording: a law undone gives the power of the echo") {
        // 255 (A / A_max)^0.5 = 127.5 is A = A_max / 4, a power of 1/16.
        CHECK(power_of({.kind = RecordedLaw::Kind::gamma}, 127.5) == test::approx(1.0 / 16.0));
        const RecordedLaw db{.kind = RecordedLaw::Kind::decibel, .range_db = 60};
        CHECK(power_of(db, 255) == test::approx(1.0));
        CHECK(power_of(db, 0) == test::approx(1e-6));
        const RecordedLaw lowered{
            .kind = RecordedLaw::Kind::decibel, .range_db = 80, .full_value = 100, .offset = 0.1};
        CHECK(largest_value(lowered) == test::approx(90.0));
        CHECK(power_of(lowered, 90) == test::approx(1.0));
        CHECK(power_of(lowered, 40) == test::approx(1e-4));
        const RecordedLaw raised{
            .kind = RecordedLaw::Kind::amplitude, .full_value = 100, .offset = 0.1};
        CHECK(power_of(raised, 40) == test::approx(0.25));
        CHECK(power_of(raised, 0) == 0.0);
        const std::vector<float> values{0, 255, 127.5F, 70000};
        const std::vector<float> powers = powers_of({.kind = RecordedLaw::Kind::gamma}, values);
        CHECK(powers[1] == 1.0F);
        CHECK(powers[2] == test::approx(1.0 / 16.0));
    }
}
