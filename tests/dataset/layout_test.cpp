#include "output/dataset/layout.h"

#include "output/dataset/encode_ping.h"
#include "output/dataset/metadata.h"
#include "support/small_mission.h"
#include "support/sonars.h"

namespace {

Ping image_of(std::vector<float> pixels) {
    Ping image;
    image.range_bins = 1;
    image.beams = static_cast<int>(pixels.size());
    image.intensity = std::move(pixels);
    return image;
}

}  // namespace

TEST_CASE("layout: files bear the pose's index in six digits, or as many as it takes") {
    const Mission mission = small_mission("out");
    const Layout layout =
        make_layout(mission, make_writers(mission, small_assembly(mission, 1)), 1);
    CHECK(layout.file({7, 0}, {"polar", ".npy"}) == "out/front/polar/000007.npy");
    CHECK(layout.file({7, 1}, {"fan", ".png"}) == "out/left/fan/000007.png");
    CHECK(layout.file({999'999, 1}, {"meta", ".json"}) == "out/left/meta/999999.json");
    CHECK(make_layout(mission, {}, 1'000'000).number(7) == "000007");
    CHECK(make_layout(mission, {}, 1'000'001).number(7) == "0000007");
    CHECK(make_layout(mission, {}, 0).number(0) == "000000");
}

// Mounts, poses and the edges of bins: cli/test_data_reader.py.
TEST_CASE("metadata: the apex of a fan, and the numbers of a ping") {
    const Mission mission = small_mission("out");
    const Assembly assembly = small_assembly(mission, 7);
    const Layout layout = make_layout(mission, make_writers(mission, assembly), 7);
    const Json json = Json::parse(json_text(describe_dataset(mission, assembly, layout)));
    CHECK(json.at("complete") == false);
    CHECK(json.at("seed").get<std::uint64_t>() == 18446744073709551615U);
    // The apex of a 60 degree fan: the middle of the lower edge.
    const Json& fan = json.at("sensors")[1].at("fan");
    CHECK(fan.at("apex_px")[0] == 0.5 * fan.at("width_px").get<double>());
    CHECK(fan.at("apex_px")[1].get<double>() == approx(fan.at("height_px").get<double>()));
    const TracedPing traced;
    const Ping ping;
    const FinishedPing finished{{3, 0}, assembly.sonars[0], traced, ping, Json(), 13};
    const Json described = Json::parse(json_text(describe_ping(mission, assembly, finished)));
    CHECK(described.at("time_s") == approx(0.3));
    CHECK(described.at("clipped_pixels") == 13);
}

TEST_CASE("metadata: numbers are the shortest that read back, names may be any bytes") {
    CHECK(json_text({{"x", 0.1}}) == "{\n \"x\": 0.1\n}\n");
    CHECK(json_text({{"x", 1.0 / 3.0}}) == "{\n \"x\": 0.3333333333333333\n}\n");
    CHECK(json_text({{"x", "a\xff"}}) == "{\n \"x\": \"a\xef\xbf\xbd\"\n}\n");
}

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

TEST_CASE_FIXTURE(MissionInFolder, "finite image: a run ends before it writes one that is not") {
    Assembly assembly = small_assembly(mission, 1);
    change_paper_model(assembly.sonars[1],
                       [](PaperModel& model) { model.pixel_noise.lobe_scale[3] = std::nanf(""); });
    CHECK_THROWS_WITH_AS(run_job(mission, assembly, {.threads = 1}, {}, {false}),
                         doctest::Contains("sensor 'left', ping at pose 0: 48 of 1536"),
                         std::runtime_error);
    CHECK_FALSE(std::filesystem::exists(out / "left/polar/000000.npy"));
}
