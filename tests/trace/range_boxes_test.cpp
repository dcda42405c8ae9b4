#include "trace/range_boxes.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "paper/accumulate.h"

using namespace sonarsim;

namespace {

/// Boxes of random ranges, a few of them outside of the bins, about a random place.
RangeBoxes random_boxes(std::mt19937& random, int count) {
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    const float about_m = 12.0F * unit(random);
    RangeBoxes boxes;
    boxes.resize(count);
    for (int k = 0; k < count; ++k) {
        boxes.range_m[k] = about_m + 2.0F * unit(random) - 1.0F;
        boxes.half_m[k] = 0.2F * unit(random) * unit(random);
        boxes.weight[k] = unit(random);
        boxes.intensity[k] = unit(random);
    }
    return boxes;
}

}  // namespace

TEST_SUITE("ping") {
    TEST_CASE("sums that are cleared and used again are those of new ones, bin by bin") {
        std::mt19937 random(31);
        const RangeBins bins{.min_m = 1.0F, .bin_m = 0.05F, .count = 203};
        BinSums again;
        std::vector<float> means_again(bins.count, 9.0F), means(bins.count, 9.0F);
        for (const int count : {1, 7, 64, 65, 300, 3, 130}) {
            CAPTURE(count);
            const RangeBoxes boxes = random_boxes(random, count);
            again.clear(bins.count);
            BinSums fresh;
            fresh.clear(bins.count);
            CHECK(accumulate(boxes, bins, again) == accumulate(boxes, bins, fresh));
            CHECK(mean_of_bins(again, means_again) == mean_of_bins(fresh, means));
            CHECK(means_again == means);
            int different = 0;
            for (int i = 0; i < bins.count; ++i) {
                different += again.weight(i) != fresh.weight(i) ? 1 : 0;
                different += again.echo(i) != fresh.echo(i) ? 1 : 0;
                // Every bin with weight has a mean.
                different += (fresh.weight(i) > 0.0F) != (means[i] > 0.0F) ? 1 : 0;
            }
            CHECK(different == 0);
        }
    }
}
