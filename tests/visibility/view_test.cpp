#include "simulate/visibility/view.h"

#include "support/test.h"

TEST_CASE("the field of view in float agrees with beam_of") {
    for (const ViewShape shape : {ViewShape::fan, ViewShape::port_starboard, ViewShape::cone}) {
        View view = with_shape({radians(100.0), 0.0, 0.5, 10.0, 512, 128, 0.03}, shape);
        view.elevation_rad = radians(40.0);
        const BeamLocator field(view);
        int differ = 0;
        for (int i = 0; i < 20000; ++i) {
            const Eigen::Vector3f p(static_cast<float>(std::sin(1.1 * i)),
                                    static_cast<float>(std::sin(1.7 * i + 1.0)),
                                    static_cast<float>(0.6 * std::sin(2.3 * i + 2.0)));
            const float beam = field.beam(p, p.norm());
            differ += (beam < 0.0F ? -1 : static_cast<int>(beam)) != beam_of(view, p);
        }
        CHECK(differ < 10);
    }
}

TEST_CASE("fields of view are half-open: the last edge belongs to no beam") {
    View view{radians(90.0), radians(90.0), 0.0, 10.0, 10, 3, 0.03, ViewShape::fan};
    const BeamLocator field(view);
    const auto both = [&](const Eigen::Vector3f& p) {
        const float beam = field.beam(p, p.norm());
        const int fast = beam < 0.0F ? -1 : static_cast<int>(beam);
        CHECK(fast == beam_of(view, p));
        return fast;
    };
    // 2e-5 rad to either side of the edges at 45 degrees.
    CHECK(both({1.0F, -0.99998F, 0.0F}) == 0);
    CHECK(both({1.0F, -1.00002F, 0.0F}) == -1);
    CHECK(both({1.0F, 0.99998F, 0.0F}) == 2);
    CHECK(both({1.0F, 1.00002F, 0.0F}) == -1);
    CHECK(both({1.0F, 0.0F, 0.99998F}) == 1);
    CHECK(both({1.0F, 0.0F, 1.00002F}) == -1);
    CHECK(both({-1.0F, 0.0F, 0.0F}) == -1);
    view.azimuth_rad = 2.0 * pi;
    // Straight behind is exactly the seam of a full turn: in the first beam or in none.
    CHECK(beam_of(view, {-1.0F, -1e-3F, 0.0F}) == 0);
    CHECK(beam_of(view, {-1.0F, 1e-3F, 0.0F}) == 2);
}
