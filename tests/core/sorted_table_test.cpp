#include "simulate/trace/cone_beams.h"
#include "support/test.h"

TEST_CASE("sorted table: a place is that of a binary search") {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> step(0.1F, 2.0F);
    std::vector<float> numbers{-40.0F};
    while (numbers.size() < 100)
        numbers.push_back(numbers.back() + step(random));
    const SortedTable table(numbers);
    std::vector<float> asked = numbers;
    std::uniform_real_distribution<float> anywhere(-50.0F, 200.0F);
    for (int k = 0; k < 1000; ++k)
        asked.push_back(anywhere(random));
    for (const float x : asked) {
        CAPTURE(x);
        CHECK(table(x) == std::ranges::lower_bound(numbers, x) - numbers.begin());
    }
}
