#include <doctest/doctest.h>

#include <cmath>

#include "core/units.h"
#include "support/approx.h"
#include "support/scenes.h"
#include "visibility/caster.h"
#include "visibility/octree/leaf.h"
#include "visibility/octree/octree_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

// The octree drops surface that it cannot place. Each scene here is one facet, a plate within one
// leaf of half a metre, and triggers one reason. The results do not depend on the unit: all scenes
// are tested in metres and 2^13 times smaller.

namespace {

constexpr double leaf_m = 0.5;

View view_of(double azimuth_deg, double elevation_deg, int beams) {
    return {radians(azimuth_deg), radians(elevation_deg), 0.0, 10.0, 100, beams, 0.03};
}

Samples look(Scene scene, View view, double unit = 1.0, bool literal = false) {
    for (Eigen::Vector3f& p : scene.vertices)
        p *= static_cast<float>(unit);
    view.range_max_m *= unit;
    const Samples samples =
        make_octree_engine(scene, {unit * leaf_m, 512, literal})->visible_surface(view, {});
    return samples;
}

/// A level plate above the sonar, centred at (x, 0).
Scene plate_above(float x, float half_size, float height) {
    Scene scene = test::empty_scene();
    const float h = half_size;
    test::add_quad(scene, {x - h, -h, height}, {x + h, -h, height}, {x + h, h, height},
                   {x - h, h, height}, test::add_material(scene, 0.5F));
    return scene;
}

/// An upright plate 5 m ahead, from y0 to y1.
Scene plate_ahead(float y0, float y1, float half_height = 0.05F) {
    Scene scene = test::empty_scene();
    test::add_quad(scene, {5, y0, -half_height}, {5, y1, -half_height}, {5, y1, half_height},
                   {5, y0, half_height}, test::add_material(scene, 0.5F));
    return scene;
}

}  // namespace

TEST_CASE("octree drops: surface in view about the sensor's axis is counted") {
    for (const double unit : {1.0, 0x1p-13}) {
        // The plate is 5 mm above the sonar and 2 cm wide; at 80 degrees the view begins 0.9 mm off
        // the axis.
        const Samples lost = look(plate_above(0.0F, 0.01F, 0.005F), view_of(60.0, 160.0, 4), unit);
        CHECK(lost.items.empty());
        CHECK(lost.dropped == 1);
        // At 5 degrees it would begin 57 mm off: nothing is lost.
        CHECK(look(plate_above(0.0F, 0.01F, 0.005F), view_of(60.0, 10.0, 4), unit).dropped == 0);
        // More than a ten-thousandth of a metre off the axis, in a range of 10 m, it is visible.
        const Samples seen =
            look(plate_above(0.002F, 0.001F, 0.005F), view_of(60.0, 160.0, 1), unit);
        CHECK(!seen.items.empty());
        CHECK(seen.dropped == 0);
    }
}

TEST_CASE("octree drops: a sliver that reaches into the next beam is counted") {
    // The sonar sees the plate from -0.2 m to y from the angle atan(-0.04) on; to first order in
    // its size, as in the octree, it ends at 0.2 y - 5.3e-6 rad. Half its width is 0.02 rad, and
    // less than 2 / 10,000 of it counts as a sliver.
    for (const double unit : {1.0, 0x1p-13}) {
        const auto at = [&](float y) {
            return look(plate_ahead(-0.2F, y), view_of(60.0, 20.0, 2), unit);
        };
        const Samples clear = at(0.0F);
        CHECK(clear.beam(0).size() == 1);
        CHECK(clear.beam(1).empty());
        CHECK(clear.dropped == 0);
        const Samples sliver = at(3.5e-5F);
        CHECK(sliver.beam(0).size() == 1);
        CHECK(sliver.beam(1).empty());
        CHECK(sliver.dropped == 1);
        const Samples both = at(1e-3F);
        CHECK(both.beam(0).size() == 1);
        CHECK(both.beam(1).size() == 1);
        CHECK(both.dropped == 0);
    }
}

TEST_CASE("octree drops: a sliver that is hidden is none") {
    Scene scene = plate_ahead(-0.2F, 3.5e-5F);
    test::add_quad(scene, {4, -1, -1}, {4, 1, -1}, {4, 1, 1}, {4, -1, 1}, 0);
    const Samples samples = look(scene, view_of(60.0, 20.0, 2));
    CHECK(!samples.items.empty());
    CHECK(samples.dropped == 0);
}

TEST_CASE("octree drops: what the view sees of a plate that spans far more than the view") {
    // A plate of 20 cm, 0.2 mm off the axis and 5 mm above the sonar, spans tan(elevation) = 25 +-
    // 25 * 500. A view of 10 degrees sees 0.17 of that, a share of 7e-6.
    for (const double unit : {1.0, 0x1p-13}) {
        const Samples samples =
            look(plate_above(2e-4F, 0.1F, 0.005F), view_of(60.0, 10.0, 1), unit);
        CHECK(samples.items.empty());
        CHECK(samples.dropped == 1);
    }
}

TEST_CASE("octree: a full turn has a seam behind the sonar, and nothing is lost there") {
    // A plate of 40 x 10 cm with its middle at 180 degrees and on either side of it.
    for (const float middle : {0.0F, 0.05F, -0.05F, 0.19F}) {
        CAPTURE(middle);
        Scene scene = plate_ahead(middle - 0.2F, middle + 0.2F);
        for (Eigen::Vector3f& p : scene.vertices)
            p.x() = -p.x();
        const Samples samples = look(scene, view_of(360.0, 20.0, 4));
        double port = 0.0;
        double starboard = 0.0;
        for (const Sample& sample : samples.beam(3))
            port += static_cast<double>(sample.area_m2);
        for (const Sample& sample : samples.beam(0))
            starboard += static_cast<double>(sample.area_m2);
        CHECK(port == test::approx(0.1 * (0.2 + middle)).epsilon(0.01));
        CHECK(starboard == test::approx(0.1 * (0.2 - middle)).epsilon(0.02));
        CHECK(samples.beam(1).empty());
        CHECK(samples.beam(2).empty());
    }
}

TEST_CASE("octree drops: to the letter, a leaf about the sonar lies in no direction") {
    // Literal leaves are cubes represented by their centre. The corner of the lattice lies (0.382,
    // 0.618, 0.272) leaves before the scene's lowest vertex.
    Scene scene = test::empty_scene();
    const float x = static_cast<float>((0.381966011 - 0.5) * leaf_m);
    const float y = static_cast<float>((0.618033989 - 0.5) * leaf_m);
    const float z = static_cast<float>((0.272019650 - 0.5) * leaf_m);
    test::add_quad(scene, {x, y, z}, {x + 0.05F, y, z}, {x + 0.05F, y + 0.05F, z},
                   {x, y + 0.05F, z}, test::add_material(scene, 0.5F));
    const Samples samples = look(scene, view_of(60.0, 20.0, 2), 1.0, true);
    CHECK(samples.items.empty());
    CHECK(samples.dropped == 1);
}

TEST_CASE("octree drops: nothing where nothing is delicate") {
    const View view{radians(60.0), radians(12.0), 0.5, 10.0, 512, 256, 0.03};
    const Scene scene = test::tank();
    const auto octree = make_octree_engine(scene, {});
    const Samples samples =
        octree->visible_surface(view, {rotation_from_rpy(0.0, 0.2, 0.3), {-2.7, -0.3, 1.5}});
    MESSAGE(samples.dropped << " of " << samples.items.size() << " pieces dropped");
    CHECK(samples.dropped < samples.items.size() / 1000);
}

TEST_CASE("octree leaf: a triangle is not too small for its cube, a touch of one is") {
    Scene scene = test::empty_scene();
    const auto material = test::add_material(scene, 0.5F);
    const auto count = [&](const Cube& cube) {
        const Caster caster(scene);
        std::vector<LeafFacet> facets;
        return LeafMaker(scene, caster).append(cube, std::vector<std::uint32_t>{0}, facets);
    };
    // 1 um by 1 um in a cube of 10 m: 5e-15 of its section, but the only surface there is.
    scene.vertices = {{0.1F, 0.1F, 0.1F}, {0.1F + 1e-6F, 0.1F, 0.1F}, {0.1F, 0.1F + 1e-6F, 0.1F}};
    scene.triangles = {{0, 1, 2}};
    scene.triangle_material = {material};
    scene.triangle_instance = {0};
    CHECK(count({{0, 0, 0}, 10.0}) == 1);
    // An equally small corner of a triangle of 1 m is rounding of the surface in the next cube.
    scene.vertices = {{-1.0F, 0.1F, 0.1F}, {1e-7F, 0.1F, 0.1F}, {-1.0F, 0.6F, 0.1F}};
    CHECK(count({{0, 0, 0}, 10.0}) == 0);
    CHECK(count({{-10, 0, 0}, 10.0}) == 1);
}

TEST_SUITE_END();
