#include "simulate/visibility/caster.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("visibility") {
    // Embree took the sign of such a component for its octant, but divided by +1e-18: rays of its
    // packet passed through the scene.
    TEST_CASE("caster: a ray with a component near zero does not disturb its neighbours") {
        Scene scene = empty_scene();
        add_sphere(scene, {0, 0, -8}, 1.0F, add_material(scene, 1.0F), 256);
        const Caster caster(scene);
        for (const float tiny : {-4.84e-19F, -1e-30F, -0.0F, 4.84e-19F, -1e-17F}) {
            std::vector<Eigen::Vector3f> directions{{tiny, -0.002F, -1}};
            for (int k = 1; k < 8; ++k)
                directions.emplace_back(-0.01F * static_cast<float>(k), -0.002F, -1);
            for (Eigen::Vector3f& direction : directions)
                direction.normalize();
            std::vector<std::uint32_t> facets(directions.size());
            caster.cast(Eigen::Vector3f::Zero(), directions, 100.0F, facets);
            CAPTURE(tiny);
            for (const std::uint32_t facet : facets)
                CHECK(facet != Caster::nothing);
        }
    }
}
