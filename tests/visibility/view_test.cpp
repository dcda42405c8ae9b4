#include "visibility/view.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/units.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

TEST_CASE("the field of view in float agrees with beam_of") {
    for (const ViewShape shape : {ViewShape::fan, ViewShape::port_starboard, ViewShape::cone}) {
        View view{radians(100.0), radians(40.0), 0.5, 10.0, 512, 128, 0.03};
        view.shape = shape;
        if (shape == ViewShape::port_starboard) view.beams = 2;
        if (shape == ViewShape::cone) view.beams = 1;
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

TEST_SUITE_END();
