#include "calibrate/calibrate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "calibrate/delivered_values.h"
#include "calibrate/made_pings.h"
#include "calibrate/usable.h"
#include "core/error.h"
#include "support/sanitized.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// A start that is wrong in everything that the pings tell.
SonarConfig wrong_start() {
    SonarConfig start = plain_imaging();
    InstrumentConfig& instrument = start.instrument;
    instrument.receiver.gamma = 0.8;
    instrument.receiver.tvg_log = 40.0;
    instrument.receiver.full_scale_db = -60.0;
    instrument.beam.width_deg = 1.3;
    instrument.beam.side_lobe_db = -20.0;
    return start;
}

std::map<std::string, double> numbers_of(const InstrumentConfig& instrument) {
    return {{"receiver.gamma", instrument.receiver.gamma},
            {"receiver.dynamic_range_db", instrument.receiver.dynamic_range_db},
            {"receiver.tvg_log", instrument.receiver.tvg_log},
            {"receiver.full_scale_db", *instrument.receiver.full_scale_db},
            {"pulse.resolution_m", instrument.pulse.resolution_m},
            {"receiver.offset", instrument.receiver.offset},
            {"receiver.common_mode_db", instrument.receiver.common_mode_db},
            {"beam.width_deg", instrument.beam.width_deg},
            {"beam.side_lobe_db", instrument.beam.side_lobe_db}};
}

/// The count of the estimates of each key that hold the true number.
struct Recovered {
    std::map<std::string, int> estimates, held;
    int figures = 0, agree_of_start = 0, agree_held_out = 0;

    void add(std::uint32_t draw, const Samples& bottom) {
        const SonarConfig truth = drawn_instrument(draw);
        const Recording pings = made_recording(truth, 20, draw + 1, bottom);
        SonarConfig start = wrong_start();
        start.instrument.receiver.samples = truth.instrument.receiver.samples;
        const Calibration found = calibrate(pings, start, {}, {});
        const std::map<std::string, double> numbers = numbers_of(truth.instrument);
        for (const KeyEstimate& e : found.estimates) {
            const auto at = numbers.find(e.key);
            const bool is_log = truth.instrument.receiver.companding == Companding::log;
            if (at == numbers.end() && e.key != "receiver.companding") continue;
            ++estimates[e.key];
            const bool holds =
                e.word.empty() ? e.number.holds(at->second) : (e.word == "log") == is_log;
            held[e.key] += holds ? 1 : 0;
        }
        for (const JudgedFigure& figure : found.figures) {
            ++figures;
            agree_of_start += figure.start.agrees() ? 1 : 0;
            agree_held_out += figure.held_out.agrees() ? 1 : 0;
        }
    }
};

/// A photograph: a smooth landscape with a little noise.
Recording photograph() {
    Recording out = made_recording(plain_imaging(), 2, 1, {});
    Draws draws(99);
    for (RecordedPing& ping : out.pings) {
        for (int i = 0; i < ping.ranges; ++i) {
            for (int j = 0; j < ping.beams; ++j) {
                const double light = 120.0 + 60.0 * std::sin(0.05 * i) * std::cos(0.08 * j);
                ping.values[static_cast<std::size_t>(i * ping.beams + j)] =
                    static_cast<float>(std::floor(light + draws.between(-2.0, 2.0)));
            }
        }
    }
    return out;
}

Recording with_all_values(float value) {
    Recording out = made_recording(plain_imaging(), 2, 1, {});
    for (RecordedPing& ping : out.pings)
        ping.values.assign(ping.values.size(), value);
    return out;
}

}  // namespace

TEST_SUITE("calibrate") {
    TEST_CASE("closed loop: an instrument is found in its own pings" *
              doctest::skip(test::sanitized)) {
        const Samples bottom = made_bottom(3.0, 5.0);
        Recovered recovered;
        for (const std::uint32_t draw : {0U, 1U})
            recovered.add(draw, bottom);
        // The draws are fixed: nothing is left to chance.
        for (const auto& of_key : recovered.estimates) {
            CAPTURE(of_key.first);
            CHECK(recovered.held[of_key.first] == of_key.second);
        }
        CHECK(recovered.estimates.size() >= 6);
        CHECK(recovered.agree_held_out > 0.9 * recovered.figures);
        CHECK(recovered.agree_of_start < 0.7 * recovered.figures);
    }

    TEST_CASE("closed loop: 200 instruments, each number within its interval in 90 % of them" *
              doctest::skip()) {
        const Samples bottom = made_bottom(3.0, 5.0);
        Recovered recovered;
        for (std::uint32_t draw = 1000; draw < 1200; ++draw)
            recovered.add(draw, bottom);
        for (const auto& of_key : recovered.estimates) {
            const int held = recovered.held[of_key.first];
            MESSAGE(of_key.first, ": ", held, " of ", of_key.second);
            CHECK(held >= 0.9 * of_key.second);
        }
        MESSAGE("figures: ", recovered.figures, ", of the start ", recovered.agree_of_start,
                ", held out ", recovered.agree_held_out);
    }

    TEST_CASE("calibrate: offset and bits of the values that the sonar delivers" *
              doctest::skip(test::sanitized)) {
        SonarConfig truth = plain_imaging();
        ReceiverConfig& receiver = truth.instrument.receiver;
        receiver.offset = 0.03;
        receiver.bits = 12;
        receiver.full_scale_db = -62.0;
        const Recording pings = made_recording(truth, 6, 5, {});
        std::map<std::string, Bounded> found;
        for (const KeyEstimate& e : calibrate(pings, wrong_start(), {}, {}).estimates)
            found[e.key] = e.number;
        CHECK(found["receiver.bits"].value == 12.0);
        CHECK(found["receiver.offset"].holds(0.03));
        CHECK(found["receiver.offset"].low > 0.01);
        CHECK(found["receiver.gamma"].holds(receiver.gamma));
        // 4,095 times 16 is the largest value of 12 bits in 16; halves are no steps.
        Recording wide = pings;
        for (RecordedPing& ping : wide.pings) {
            for (float& value : ping.values)
                value *= 16.0F;
        }
        CHECK(bits_of(wide.pings, 65520.0) == 12);
        CHECK_FALSE(bits_of(wide.pings, 65535.0).has_value());
        wide.pings.front().values.front() = 0.5F;
        CHECK_FALSE(bits_of(wide.pings, 65520.0).has_value());
    }

    TEST_CASE("calibrate: the preset has the absorption and the start of the gain of the fit" *
              doctest::skip(test::sanitized)) {
        const SonarConfig truth = drawn_instrument(0);
        const Recording pings = made_recording(truth, 20, 1, made_bottom(3.0, 5.0));
        SonarConfig start = wrong_start();
        start.instrument.receiver.samples = truth.instrument.receiver.samples;
        start.instrument.receiver.tvg_absorption = false;
        start.instrument.receiver.tvg_from_m = 0.5;
        const Calibration found = calibrate(pings, start, {}, {});
        std::map<std::string, std::string> written;
        for (const PresetValue& value : found.preset)
            written[value.key] = value.value;
        // Noise is found, so the law of the gain is that of the fit, not of the start.
        REQUIRE(written.contains("instrument.receiver.tvg_log"));
        CHECK(written["instrument.receiver.tvg_absorption"] == "true");
        const bool found_from = std::ranges::any_of(
            found.estimates, [](const KeyEstimate& e) { return e.key == "receiver.tvg_from_m"; });
        CHECK((written["instrument.receiver.tvg_from_m"] == "0") == !found_from);
    }

    TEST_CASE("calibrate: echoes straight ahead that stay are no noise of all elements" *
              doctest::skip(test::sanitized)) {
        // Speckle of the scene is the same in every ping; below it the noise is what changes.
        SonarConfig truth = plain_imaging();
        truth.instrument.speckle.mode = SpeckleMode::scene;
        const Recording pings = made_recording(truth, 6, 41, made_bottom(3.0, 5.0));
        for (const KeyEstimate& e : calibrate(pings, wrong_start(), {}, {}).estimates)
            CHECK(e.key != "receiver.common_mode_db");
    }

    TEST_CASE("calibrate: pings that tell nothing are refused, with the reason") {
        const SonarConfig start = plain_imaging();
        const auto refused = [&](const Recording& recording, const char* why) {
            CAPTURE(why);
            std::string message;
            try {
                calibrate(recording, start, {}, {});
            } catch (const InputError& error) {
                message = error.what();
            }
            CHECK(message.find(why) != std::string::npos);
        };
        refused(photograph(), "photograph");
        refused(with_all_values(0.0F), "empty");
        refused(with_all_values(255.0F), "every value is the same");
        Recording saturated = made_recording(start, 2, 1, {});
        for (float& value : saturated.pings.front().values)
            value = 255.0F;
        refused(saturated, "saturated");
        Recording one = made_recording(start, 1, 1, {});
        refused(one, "1 ping");
        Recording soundings = made_recording(start, 2, 1, {});
        soundings.kind = RecordedKind::soundings;
        refused(soundings, "another kind");
    }

    TEST_CASE("calibrate: the parts follow each other, and each ping is in one of them") {
        Recording pings;
        for (int k = 0; k < 7; ++k)
            pings.pings.push_back({.time_s = static_cast<double>(k), .values = {}});
        const SplitRecording forward = split(pings, 0.5, false);
        CHECK(forward.fitted.pings.size() == 4);
        CHECK(forward.judged.pings.size() == 3);
        CHECK(forward.judged.pings.front().time_s == 4.0);
        const SplitRecording back = split(pings, 0.3, true);
        CHECK(back.judged.pings.size() == 2);
        CHECK(back.judged.pings.front().time_s == 0.0);
        CHECK(back.fitted.pings.front().time_s == 2.0);
        CHECK(split(pings, 0.01, false).judged.pings.size() == 1);
        CHECK(split(pings, 0.99, false).fitted.pings.size() == 1);
    }
}
