#include "assembly/thin_heights.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "format/geotiff.h"
#include "scene/gltf/load.h"
#include "support/draws.h"
#include "support/mapped_floor.h"
#include "support/sanitized.h"
#include "support/temporary_folder.h"
#include "visibility/image_change.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// A map of 30 x 30 m in cells of 10 cm: six random waves of the given length and slope.
struct ThinnedMap {
    TemporaryFolder folder;
    PlacedFile placed;

    ThinnedMap(std::uint32_t draw, double length_m, double slope, bool hole = false) {
        constexpr int n = 300;
        constexpr double cell_m = 0.1;
        Draws draws(draw);
        std::vector<float> heights(static_cast<std::size_t>(n) * n, 0.0F);
        for (int wave = 0; wave < 6; ++wave) {
            const double turn = static_cast<double>(draws.between(0, 6.3F));
            const double phase = static_cast<double>(draws.between(0, 6.3F));
            const double k = 2.0 * pi / length_m;
            for (int row = 0; row < n; ++row) {
                for (int column = 0; column < n; ++column) {
                    const double along = cell_m * (column * std::cos(turn) - row * std::sin(turn));
                    heights[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)] +=
                        static_cast<float>(slope / (2.5 * k) * std::sin(k * along + phase));
                }
            }
        }
        if (hole) heights[n * n / 2] = std::numeric_limits<float>::quiet_NaN();
        placed.file = folder.path / "map.tif";
        placed.z_up = true;
        placed.material = "sand";
        placed.heightmap = HeightmapRule{};
        write_geotiff(placed.file, heights, n, {-15.0, 15.0, cell_m});
    }

    Thinning thinned(const Sonar& sonar) const {
        const Trajectory vehicle{{0.0, above_floor()}};
        ImageReader images;
        return thin_heights(placed, {&sonar, 1}, vehicle, 0.03, images);
    }

    std::vector<double> image(const Sonar& sonar, int every) const {
        PlacedFile file = placed;
        file.heightmap->every = every;
        SceneFiles files;
        Scene scene = load_scene_geometry(file, files);
        scene.materials.front().reflection = 0.2F;
        const std::vector<float> image =
            clean_image(sonar, scene, EngineKind::slices, above_floor());
        return {image.begin(), image.end()};
    }
};

}  // namespace

TEST_SUITE("thin heights") {
    TEST_CASE("images over thinned maps differ from those over all heights by less than the share" *
              doctest::skip(test::sanitized)) {
        // The estimate is the worst of two parts of a view, so that the whole view lies below it or
        // little above.
        int thinned = 0;
        for (const std::uint32_t draw : {1U, 3U}) {
            const ThinnedMap map(draw, 6.0, 0.1);
            const Sonar sonar = imaging(ModelKind::paper);
            const Thinning found = map.thinned(sonar);
            CAPTURE(found.every);
            CAPTURE(found.error);
            CHECK(found.error <= 0.25 * 0.03);
            if (found.every == 1) continue;
            ++thinned;
            CHECK(image_change(map.image(sonar, found.every), map.image(sonar, 1)) < 0.25 * 0.03);
        }
        CHECK(thinned == 2);
    }

    TEST_CASE("rough maps and maps with holes keep all heights") {
        const Sonar sonar = imaging(ModelKind::paper);
        CHECK(ThinnedMap(4, 0.4, 0.4).thinned(sonar).every == 1);
        CHECK(ThinnedMap(4, 6.0, 0.1, true).thinned(sonar).every == 1);
    }

    TEST_CASE("truth keeps all heights") {
        Mission mission;
        CHECK_FALSE(allows_thinning(mission));
        mission.scene.heightmap.emplace();
        mission.sensors.emplace_back();
        CHECK(allows_thinning(mission));
        const auto refused = [&](const auto& change) {
            Mission other = mission;
            change(other);
            return !allows_thinning(other);
        };
        CHECK(refused([](Mission& m) { m.output.labels = {Label::instance}; }));
        CHECK(refused([](Mission& m) { m.scene.heightmap->keep = KeptHeights::all; }));
        CHECK(refused([](Mission& m) { m.scene.scatter.emplace_back(); }));
        CHECK(refused([](Mission& m) { m.sensors[0].kind = SonarKind::profiling; }));
        CHECK(refused([](Mission& m) { m.sensors[0].multipath.method = MultipathMethod::exact; }));
        CHECK(refused(
            [](Mission& m) { m.scene.objects.emplace_back().place_on = ObjectPlace::on_bottom; }));
    }
}
