#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "core/units.h"
#include "support/approx.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "visibility/slices/fixtures.h"
#include "visibility/slices/slice_frames.h"

using namespace sonarsim;
using test::fan_view;
using test::seen;

TEST_SUITE_BEGIN("slices");

// A frame has at most 120 degrees. Slices are checked by beam.
TEST_CASE("slices: a sector has whole beams, or lies in one beam") {
    View view = fan_view();
    for (const int beams : {1, 2, 3, 4, 5, 16}) {
        for (const double azimuth_deg : {60.0, 130.0, 250.0, 350.0}) {
            CAPTURE(beams);
            CAPTURE(azimuth_deg);
            view.beams = beams;
            view.azimuth_rad = radians(azimuth_deg);
            std::uint32_t strips = 0;
            int per_beam = 0;
            for (const SliceFrame& frame : slice_frames(view, 1)) {
                const auto of_frame = static_cast<std::uint32_t>(frame.beam_u.size() - 1);
                per_beam = frame.slices_per_beam;
                CHECK((of_frame == 1 || frame.gaps() == of_frame * per_beam));
                strips += frame.gaps();
            }
            CHECK(strips == static_cast<std::uint32_t>(beams * per_beam));
        }
    }
}

TEST_CASE("slices: two wide beams have the surface of rods that stand in each of them") {
    // Beams of 150 degrees with two slices each and those that are added. The reference has 64 beams
    // in place of each.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(0.0F, 1.0F);
    View view = fan_view();
    view.beams = 2;
    view.azimuth_rad = radians(300.0);
    View narrow = view;
    narrow.beams = 128;
    for (int k = 0; k < (test::sanitized ? 2 : 8); ++k) {
        Scene scene = test::empty_scene();
        const std::uint32_t rock = test::add_material(scene, 0.5F);
        for (int rod = 0; rod < 60; ++rod) {
            const float turn = 6.2F * any(random) - 3.1F;
            const float range = 3.0F + 6.0F * any(random);
            test::add_pole(scene, {range * std::cos(turn), range * std::sin(turn), -0.3F}, 0.05F,
                           0.6F, rock, 6);
        }
        const Samples image = seen(scene, view, Pose{}, 0);
        const Samples reference = seen(scene, narrow, Pose{}, 2);
        for (const int beam : {0, 1}) {
            CAPTURE(beam);
            const auto area = [](const Samples& samples, int begin, int end) {
                double sum = 0.0;
                for (int k = begin; k < end; ++k) {
                    for (const Sample& sample : samples.beam(k))
                        sum += static_cast<double>(sample.area_m2);
                }
                return sum;
            };
            CHECK(area(image, beam, beam + 1) ==
                  test::approx(area(reference, 64 * beam, 64 * beam + 64)).epsilon(0.07));
        }
    }
}

TEST_SUITE_END();
