#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "dataset/encode_ping.h"
#include "job/run_job.h"
#include "support/small_mission.h"
#include "support/sonars.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

Ping image_of(std::vector<float> pixels) {
    Ping image;
    image.range_bins = 1;
    image.beams = static_cast<int>(pixels.size());
    image.intensity = std::move(pixels);
    return image;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("finite image: the brightest pixel is found, and one that is not finite, anywhere") {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        for (std::size_t at = 0; at < 19; ++at) {
            std::vector<float> pixels(19, 0.25F);
            pixels[at] = 3e38F;
            CHECK(brightest_pixel(image_of(pixels), "fls", 0) == 3e38F);
            for (const float bad : {std::nanf(""), -std::nanf(""), infinity, -infinity}) {
                pixels[at] = bad;
                CHECK_THROWS_WITH_AS(brightest_pixel(image_of(pixels), "fls", 12),
                                     "sensor 'fls', ping at pose 12: 1 of 19 pixels are NaN or "
                                     "infinite, a fault of sonarsim; please report it with the "
                                     "mission",
                                     std::runtime_error);
            }
        }
    }

    TEST_CASE("finite image: a run ends before it writes one that is not") {
        const TemporaryFolder temporary;
        const Mission mission = small_mission(temporary.path / "out");
        Assembly assembly = small_assembly(mission, 1);
        change_paper_model(assembly.sonars[1], [](PaperModel& model) {
            model.pixel_noise.lobe_scale[3] = std::nanf("");
        });
        CHECK_THROWS_WITH_AS(run_job(mission, assembly, {.threads = 1}, {}, {false}),
                             doctest::Contains("sensor 'left', ping at pose 0: 48 of 1536"),
                             std::runtime_error);
        CHECK_FALSE(std::filesystem::exists(temporary.path / "out/left/polar/000000.npy"));
    }
}
