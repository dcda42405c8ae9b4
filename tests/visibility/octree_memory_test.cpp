#include <doctest/doctest.h>

#include <regex>
#include <string>

#include "core/units.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "visibility/octree/octree_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

namespace {

const View view{radians(60.0), radians(12.0), 0.5, 10.0, 512, 256, 0.03};

Pose pose(int k) {
    return {rotation_from_rpy(0.0, 0.4, 0.3 * k), {0.3, 0.2, 2.5}};
}

}  // namespace

TEST_CASE(
    "octree memory: less than a ping needs gives the same image and the figure that would do" *
    doctest::skip(test::sanitized)) {
    const Scene scene = test::rough_floor();
    const auto roomy = make_octree_engine(scene, {.memory_mb = 4096});
    const auto tight = make_octree_engine(scene, {.memory_mb = 2});
    for (int k = 0; k < 3; ++k) {
        const Samples expected = roomy->visible_surface(view, pose(k));
        const Samples found = tight->visible_surface(view, pose(k));
        REQUIRE(found.items.size() == expected.items.size());
        bool same = true;
        for (std::size_t i = 0; i < found.items.size(); ++i)
            same = same && found.items[i].position == expected.items[i].position;
        CHECK(same);
    }
    CHECK(roomy->warnings().empty());
    REQUIRE(tight->warnings().size() == 1);
    const std::string warning = tight->warnings()[0];
    CHECK(warning.starts_with("octree.memory_mb: 2 is too little: one ping needs "));
    std::smatch figure;
    REQUIRE(std::regex_search(warning, figure, std::regex("set it to ([0-9]+) or more")));
    const auto enough = make_octree_engine(scene, {.memory_mb = std::stoul(figure[1])});
    for (int k = 0; k < 3; ++k)
        enough->visible_surface(view, pose(0));
    CHECK(enough->warnings().empty());
    CHECK(enough->statistics().evictions == 0);
}

TEST_CASE("octree memory: a large top does not evict the tiles" * doctest::skip(test::sanitized)) {
    // The top of this tree alone exceeds 1 MB. It once made every tile that grew evict all others.
    const Scene scene = test::rough_floor();
    const auto tight = make_octree_engine(scene, {.memory_mb = 1});
    tight->visible_surface(view, pose(0));
    const OctreeStatistics after = tight->statistics();
    CHECK(after.bytes > 1U << 20U);
    CHECK(after.leaves > 0);
    const View narrow{radians(2.0), radians(2.0), 0.5, 4.0, 64, 8, 0.03};
    tight->visible_surface(narrow, pose(0));
    const std::uint64_t evictions = tight->statistics().evictions;
    for (int k = 0; k < 3; ++k)
        tight->visible_surface(narrow, pose(0));
    CHECK(tight->statistics().evictions == evictions);
}

TEST_SUITE_END();
