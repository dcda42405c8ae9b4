#include "validation/reference.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/units.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "validation/image_error.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

View small_view() {
    return {radians(40.0), radians(20.0), 0.5, 8.0, 100, 20, 0.03};
}

}  // namespace

TEST_SUITE_BEGIN("validation");

TEST_CASE("the reference of a floor is its closed form, R H / r_mid") {
    // Derived in tests/sonar/imaging_test.cpp.
    constexpr float R = 0.7F;
    constexpr double H = 1.5;
    Scene scene = empty_scene();
    add_floor(scene, 100.0F, 0.0F, add_material(scene, R));
    const Caster caster(scene);
    const View view = small_view();
    const Pose pose{rotation_from_rpy(0.0, radians(30.0), 0.0), {0.0, 0.0, H}};
    const Reference reference = cast_reference(caster, scene, view, pose, {0.0005, 64.0});
    CHECK(reference.moved < 0.0005);
    CHECK(reference.rays_per_bin >= 64.0);
    const int first = static_cast<int>((H / std::sin(radians(40.0)) - 0.5) / view.bin_m()) + 2;
    const int last = static_cast<int>((H / std::sin(radians(20.0)) - 0.5) / view.bin_m()) - 2;
    for (int i = first; i <= last; ++i) {
        const double r = view.range_min_m + (i + 0.5) * view.bin_m();
        CHECK(reference.intensity[i * 20 + 10] == doctest::Approx(R * H / r).epsilon(2e-3));
    }
}

TEST_CASE("where two surfaces share a bin the reference weighs them by area" *
          doctest::skip(test::sanitized)) {
    // Two walls face on at the same distance, split at elevation 0: R = 0.2 below, 0.8 above. In
    // every bin the areas are equal, so the mean is 0.5 D / r.
    Scene scene = empty_scene();
    add_quad(scene, {4, -9, -9}, {4, 9, -9}, {4, 9, 0}, {4, -9, 0}, add_material(scene, 0.2F));
    add_quad(scene, {4, -9, 0}, {4, 9, 0}, {4, 9, 9}, {4, -9, 9}, add_material(scene, 0.8F));
    const Caster caster(scene);
    View view = small_view();
    view.range_bins = 200;
    const Reference reference = cast_reference(caster, scene, view, Pose{}, {0.0005, 64.0});
    for (int j = 0; j < view.beams; ++j) {
        const int i = static_cast<int>((4.0 / std::cos(radians(-20.0 + 2.0 * (j + 0.5))) - 0.5) /
                                       view.bin_m()) +
                      1;
        const double r = view.range_min_m + (i + 0.5) * view.bin_m();
        CHECK(reference.intensity[i * 20 + j] == doctest::Approx(0.5 * 4.0 / r).epsilon(5e-3));
    }
}

TEST_CASE("image errors by hand") {
    const std::vector<float> truth{1.0F, 1.0F, 0.0F, 0.0F};
    const std::vector<float> image{1.0F, 0.0F, 1.0F, 0.0F};
    const ImageError error = image_error(image, truth);
    CHECK(error.relative_l1 == doctest::Approx(1.0));
    CHECK(error.relative_l2 == doctest::Approx(1.0));
    CHECK(error.miss_rate == doctest::Approx(0.5));
    CHECK(error.false_rate == doctest::Approx(0.5));
    const std::vector<float> dark(4, 0.0F);
    CHECK(image_error(dark, dark).relative_l1 == 0.0);
    CHECK(image_error(image, dark).relative_l1 == 1.0);
}

TEST_SUITE_END();
