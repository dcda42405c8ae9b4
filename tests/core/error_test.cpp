#include "core/error.h"

#include "support/test.h"

TEST_CASE("error: errors are collected, each once, and thrown together") {
    ErrorList errors;
    CHECK_NOTHROW(errors.raise());
    CHECK(errors.attempt([] {}));
    for (const char* fault : {"one", "two", "one"})
        CHECK_FALSE(errors.attempt([&] { throw InputError({"a.yaml", 3, 7}, fault); }));
    CHECK(errors.count() == 2);
    CHECK_THROWS_WITH_AS(errors.raise(), "a.yaml:3:7: one\na.yaml:3:7: two", InputError);
    // Other exceptions pass through.
    CHECK_THROWS_AS(errors.attempt([] { throw std::runtime_error("disk"); }), std::runtime_error);
    for (int i = 0; i < 100; ++i)
        errors.add(InputError(std::to_string(i)));
    CHECK(errors.count() == 102);
    CHECK_THROWS_WITH_AS(errors.raise(), doctest::Contains("47\nand 52 more errors like these"),
                         InputError);
}
