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
        // First order is what silhouettes and bin edges allow; less than half of it would be no
        // convergence worth the name.
        CHECK(one.order > 0.4);
        CHECK(one.errors.back() < 0.5 * one.errors.front());
        if (one.engine != "rays") continue;
        // The steps of the rays are what the errors are meant to be; a single pose may miss one.
        for (std::size_t i = 0; i < one.steps.size(); ++i)
            CHECK(one.errors[i] < 1.2 * one.steps[i]);
    }
}

TEST_SUITE_END();
