#include "input/scene/heightmap/height_model.h"

#include "input/scene/gltf/load.h"
#include "input/scene/placing/bottom.h"
#include "output/format/geotiff.h"
#include "support/test.h"

namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

struct MapFile {
    TemporaryFolder folder;
    PlacedFile placed;

    MapFile(const std::vector<float>& heights, int columns, const MapPlace& place,
            HeightmapRule rule = {}) {
        placed.file = folder.path / "map.tif";
        placed.z_up = true;
        placed.heightmap = rule;
        write_file(placed.file, geotiff_bytes(heights, columns, place));
    }
    /// Replaces the mark of unknown heights, which is NaN, by another text of three letters.
    void mark(const std::string& text) const {
        std::string bytes = read_file(placed.file, 1'000'000);
        bytes.replace(bytes.rfind(std::string("nan\0", 4)), 3, text);
        write_file(placed.file, bytes);
    }
    Surface surface() const {
        SceneFiles files;
        return surface_of(placed, files);
    }
};

bool has_vertex(const Surface& surface, const Eigen::Vector3d& point) {
    return std::ranges::any_of(surface.vertices, [&](const Eigen::Vector3d& vertex) {
        return (vertex - point).norm() < 1e-9;
    });
}

double upward_area(const Surface& surface) {
    double sum = 0.0;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto c = corners_of(surface, t);
        sum += 0.5 * (c[1] - c[0]).cross(c[2] - c[0]).z();
    }
    return sum;
}

}  // namespace

TEST_CASE("a pixel without a height is a hole of the triangles that need it") {
    std::vector<float> heights(16, 3.0F);
    const auto triangles = [&] { return MapFile(heights, 4, {}).surface().triangles.size(); };
    CHECK(triangles() == 18);
    heights[5] = unknown;
    // Each of the four cells around it keeps the triangle of its other three corners.
    CHECK(triangles() == 18 - 4);
    // A corner of the map: one cell, which keeps the triangle next to the hole.
    heights[5] = 3.0F;
    heights[0] = unknown;
    CHECK(triangles() == 17);
    const MapFile marked({1, 2, 3, -99}, 2, {});
    CHECK(marked.surface().triangles.size() == 2);
    marked.mark("-99");
    CHECK(marked.surface().triangles.size() == 1);
}

TEST_CASE("coordinates of hundreds of kilometres lose nothing") {
    const MapFile map({0.125F, 2, 3, 4}, 2,
                      {.west_m = 500000.03, .north_m = 5600000.07, .cell_m = 0.01});
    SceneFiles files;
    const Scene scene = load_scene_geometry(map.placed, files);
    CHECK((scene.bounds_min - Eigen::Vector3d(500000.035, 5600000.055, 0.125)).norm() < 2e-7);
    CHECK((scene.bounds_max - Eigen::Vector3d(500000.045, 5600000.065, 4)).norm() < 2e-6);
    CHECK(!has_coarse_vertices(scene));
}

TEST_CASE("a window of a heightmap is a part of its surface") {
    std::vector<float> heights;
    for (int i = 0; i < 400; ++i)
        heights.push_back(static_cast<float>((i * 37) % 101));
    const MapPlace place{.west_m = 1000, .north_m = 2000, .cell_m = 0.5};
    const MapFile whole(heights, 20, place);
    const MapFile part(heights, 20, place, {.window = std::array{1003.0, 1993.0, 1005.0, 1995.0}});
    const Bottom all(whole.surface());
    const Surface surface = part.surface();
    const Bottom some(surface);
    CHECK(surface.triangles.size() < 200);
    for (double x = 1003.0; x <= 1005.0; x += 0.125) {
        for (double y = 1993.0; y <= 1995.0; y += 0.125)
            CHECK(some.highest({x, y}) == all.highest({x, y}));
    }
    // A window outside the map leaves all of it.
    const MapFile beside(heights, 20, place, {.window = std::array{0.0, 0.0, 9.0, 9.0}});
    CHECK(beside.surface().triangles.size() == whole.surface().triangles.size());
}

// Cubic convolution is exact for parabolas; where a neighbour is missing the surface goes on
// straight, so that a plane is exact everywhere.
TEST_CASE("cells of a heightmap are divided by cubic interpolation") {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> draw(-1.0F, 1.0F);
    for (int k = 0; k < 20; ++k) {
        const float a = draw(random), b = draw(random), c = k % 2 == 0 ? 0.0F : draw(random);
        const auto height = [&](float x, float y) { return a * x + b * y + c * (x * x + x * y); };
        HeightGrid grid{6, 5, {}};
        for (int row = 0; row < 5; ++row) {
            for (int column = 0; column < 6; ++column)
                grid.values.push_back(height(static_cast<float>(column), static_cast<float>(row)));
        }
        const HeightGrid fine = grid.interpolated(4, 3);
        REQUIRE(fine.values.size() == 21 * 13);
        for (std::size_t at = 0; at < fine.values.size(); ++at) {
            const float x = static_cast<float>(at % 21) / 4.0F;
            const float y = static_cast<float>(at / 21) / 3.0F;
            const bool inside = x >= 1.0F && x <= 4.0F && y >= 1.0F && y <= 3.0F;
            if (inside || c == 0.0F) CHECK(std::fabs(fine.values[at] - height(x, y)) < 1e-5F);
        }
    }
}

TEST_CASE("cell_m makes a heightmap's cells shorter and keeps its heights and holes") {
    std::vector<float> heights(36, 1.0F);
    heights[14] = 3.0F;
    heights[35] = unknown;
    const MapPlace place{.west_m = 0, .north_m = 12, .cell_m = 2};
    const MapFile map(heights, 6, place, {.cell_m = 0.67});
    const Surface surface = map.surface();
    // Three parts to a pixel; in the last cell the other diagonal leaves one small triangle.
    CHECK(surface.triangles.size() == 2 * (15 * 15 - 9) + 1);
    CHECK(has_vertex(surface, {5, 7, 3}));
    CHECK(upward_area(surface) == approx(96.0 + 2.0 / 9.0).epsilon(1e-6));
    CHECK_THROWS_WITH_AS((MapFile(heights, 6, place, {.cell_m = 1e-3}).surface()),
                         doctest::Contains("make cell_m longer"), InputError);
}

TEST_CASE("values that are no heights are refused with their place") {
    const float infinite = std::numeric_limits<float>::infinity();
    const std::pair<std::vector<float>, const char*> faulty[] = {
        {{1, 2, 3, -9999},
         "row 1, column 1: -9999 looks like the mark of an unknown height; mark it in the file: "
         "gdal_translate -a_nodata -9999"},
        {{1, 2, 3, -3.402823e38F}, "row 1, column 1"},
        {{1, 2, 3, infinite}, "inf looks"},
        {{unknown, unknown, unknown, unknown}, "no three neighbours with known heights"},
        {{1, 2}, "2 x 1 pixels, and a surface needs 2 x 2"}};
    for (const auto& map : faulty)
        CHECK_THROWS_WITH_AS(MapFile(map.first, 2, {}).surface(), doctest::Contains(map.second),
                             InputError);
    const MapFile deep({1, 2, 3, -9999}, 2, {});
    deep.mark("-99");
    CHECK_NOTHROW(deep.surface());
}
