#include "product/object_masks.h"

#include <doctest/doctest.h>

#include <random>

using namespace sonarsim;

namespace {

using Ids = std::vector<std::uint16_t>;

/// The ids that masks stand for.
Ids ids_of(const std::vector<ObjectMask>& masks, std::size_t pixels) {
    Ids ids(pixels, 0);
    for (const ObjectMask& mask : masks) {
        std::size_t at = 0;
        for (std::size_t k = 0; k < mask.runs.size(); ++k) {
            for (std::size_t n = at; n < at + mask.runs[k] && k % 2 == 1; ++n)
                ids[n] = static_cast<std::uint16_t>(mask.id);
            at += mask.runs[k];
        }
        CHECK(at == pixels);
    }
    return ids;
}

}  // namespace

TEST_SUITE("product") {
    TEST_CASE("masks: runs, boxes and areas, column by column") {
        // Three columns of four pixels: 2 fills the last two pixels of the first column and the
        // first of the second, 5 the rest of that column, which begins the third.
        const Ids ids{0, 0, 2, 2, 2, 5, 5, 5, 5, 0, 0, 0};
        const auto masks = object_masks(ids, 4);
        REQUIRE(masks.size() == 2);
        CHECK(masks[0].id == 2);
        CHECK(masks[0].runs == std::vector<std::uint32_t>{2, 3, 7});
        CHECK(masks[0].area == 3);
        CHECK(masks[0].left == 0);
        CHECK(masks[0].right == 2);
        CHECK(masks[0].top == 0);
        CHECK(masks[0].bottom == 4);
        CHECK(masks[1].id == 5);
        CHECK(masks[1].runs == std::vector<std::uint32_t>{5, 4, 3});
        CHECK(masks[1].left == 1);
        CHECK(masks[1].right == 3);
        CHECK(object_masks(Ids(12, 0), 4).empty());
        CHECK(object_masks(Ids(12, 7), 4)[0].runs == std::vector<std::uint32_t>{0, 12});
    }

    TEST_CASE("masks: random pictures come back") {
        std::mt19937 random(3);
        for (int trial = 0; trial < 50; ++trial) {
            const int height = 1 + static_cast<int>(random() % 9);
            Ids ids(static_cast<std::size_t>(height) * (1 + random() % 9));
            for (std::uint16_t& id : ids)
                id = static_cast<std::uint16_t>(random() % 4);
            const auto masks = object_masks(ids, height);
            CHECK(ids_of(masks, ids.size()) == ids);
            for (const ObjectMask& mask : masks) {
                int left = 1000, right = 0, top = 1000, bottom = 0;
                std::uint64_t area = 0;
                for (std::size_t n = 0; n < ids.size(); ++n) {
                    if (ids[n] != mask.id) continue;
                    const int x = static_cast<int>(n) / height;
                    const int y = static_cast<int>(n) % height;
                    left = std::min(left, x);
                    right = std::max(right, x + 1);
                    top = std::min(top, y);
                    bottom = std::max(bottom, y + 1);
                    ++area;
                }
                CHECK(mask.left == left);
                CHECK(mask.right == right);
                CHECK(mask.top == top);
                CHECK(mask.bottom == bottom);
                CHECK(mask.area == area);
            }
        }
    }
}
