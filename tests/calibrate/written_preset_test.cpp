#include "calibrate/written_preset.h"

#include <doctest/doctest.h>

#include "core/error.h"

using namespace sonarsim;

TEST_SUITE("calibrate") {
    TEST_CASE("presets: values are replaced in place, and missing keys are added") {
        const std::string start =
            "# A sonar.\n"
            "kind: imaging\n"
            "azimuth_deg: 60  # sheet\n"
            "instrument:\n"
            "  beam:\n"
            "    width_deg: 0.4  # sheet\n"
            "  receiver:\n"
            "    gamma: 0.5  # rule\n";
        const std::string out =
            with_values(start, "start.yaml",
                        {{"azimuth_deg", "61", "file"},
                         {"instrument.receiver.gamma", "0.6", "fit: 0.5 to 0.7"},
                         {"instrument.receiver.tvg_log", "26", "fit"},
                         {"instrument.pulse.resolution_m", "0.01", "fit"}});
        CHECK(out ==
              "# A sonar.\n"
              "kind: imaging\n"
              "azimuth_deg: 61  # file\n"
              "instrument:\n"
              "  beam:\n"
              "    width_deg: 0.4  # sheet\n"
              "  receiver:\n"
              "    tvg_log: 26  # fit\n"
              "    gamma: 0.6  # fit: 0.5 to 0.7\n"
              "  pulse:\n"
              "    resolution_m: 0.01  # fit\n");
    }

    TEST_CASE("presets: a section in one line is refused, with its line") {
        const std::string start = "kind: imaging\ninstrument:\n  receiver: {gamma: 0.5}\n";
        CHECK_THROWS_WITH_AS(
            with_values(start, "start.yaml", {{"instrument.receiver.gamma", "0.6", "fit"}}),
            doctest::Contains("start.yaml:3: write each key of 'receiver'"), InputError);
    }
}
