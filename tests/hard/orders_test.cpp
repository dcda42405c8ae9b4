#include "validation/hard/orders.h"

#include <doctest/doctest.h>

#include "support/sanitized.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

TEST_CASE("the error of both engines falls with their resolution" *
          doctest::skip(test::sanitized)) {
    const std::vector<ConvergenceOrder> orders = convergence_orders();
    REQUIRE(orders.size() == 6);
    MESSAGE(orders_table(orders));
    for (const ConvergenceOrder& one : orders) {
        CAPTURE(one.scene);
        CAPTURE(one.engine);
        CAPTURE(one.order);
        // Silhouettes and bin edges limit the order to one; less than half of that would not be
        // convergence.
        CHECK(one.order > 0.4);
        CHECK(one.errors.back() < 0.5 * one.errors.front());
        if (one.engine != "rays") continue;
        // The steps of the rays are their error goals; a single pose may miss its goal.
        for (std::size_t i = 0; i < one.steps.size(); ++i)
            CHECK(one.errors[i] < 1.2 * one.steps[i]);
    }
}

TEST_SUITE_END();
